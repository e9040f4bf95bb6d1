use kin::prelude::*;

#[force]
fn brake(x: Coord, speed: Coord, c: f64) -> f64 {
    -c * x * speed
}

fn main() {}
