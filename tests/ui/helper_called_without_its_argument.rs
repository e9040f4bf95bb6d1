use kin::prelude::*;

fn square(x: f64) -> f64 {
    x * x
}

#[constraint]
fn squared(a: Coord, k: f64) -> f64 {
    a - k * square()
}

fn main() {}
