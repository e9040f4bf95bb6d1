use kin::prelude::*;

#[constraint]
fn truncated(a: Coord, k: f64) -> f64 {
    let mut sum = a;
    while sum > 1.0 {
        sum -= 1.0;
    }
    k - f64::from_bits(f64::to_bits(sum))
}

fn main() {}
