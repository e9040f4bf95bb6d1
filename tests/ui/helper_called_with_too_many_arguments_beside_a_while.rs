use kin::prelude::*;

fn square<D: Dual>(x: Real<D>) -> Real<D> {
    x * x
}

#[constraint]
fn squared(a: Coord, k: f64) -> f64 {
    let mut sum = a;
    while sum > 1.0 {
        sum -= 1.0;
    }
    square(sum, k) - k
}

fn main() {}
