use kin::prelude::*;

#[derive(Clone)]
struct Gains {
    k: f64,
}

#[constraint]
fn spring(x: Coord, gains: Gains) -> f64 {
    gains.stiffness * x
}

fn main() {}
