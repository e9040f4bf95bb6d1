use kin::prelude::*;

#[constraint]
fn truncated(a: Coord, k: f64) -> f64 {
    k - f64::from_bits(a.to_bits() & !1)
}

fn main() {}
