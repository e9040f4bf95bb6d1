use kin::prelude::*;

#[constraint]
fn parabola(x: Coord, y: Coord, k: f64) -> f64 {
    y - k * x ^ 2
}

fn main() {}
