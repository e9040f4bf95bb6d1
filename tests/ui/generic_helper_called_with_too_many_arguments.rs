use kin::prelude::*;

fn square<D: Dual>(x: Real<D>) -> Real<D> {
    x * x
}

#[constraint]
fn squared(a: Coord, k: f64) -> f64 {
    square(a, k) - k
}

fn main() {}
