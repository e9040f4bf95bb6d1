use kin::prelude::*;

struct Gains {
    k: f64,
}

#[constraint]
fn spring(x: Coord, gains: Gains) -> f64 {
    gains.k * x
}

fn main() {}
