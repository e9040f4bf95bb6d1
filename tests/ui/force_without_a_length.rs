use kin::prelude::*;

#[force]
fn brake(c: f64, x: Coord, rate: Rate) -> f64 {
    -c * x * rate
}

fn main() {}
