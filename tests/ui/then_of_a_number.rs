use kin::prelude::*;

#[constraint]
fn engaged(a: Coord, k: f64) -> f64 {
    a - k.then(|| a * a).unwrap_or(0.0)
}

fn main() {}
