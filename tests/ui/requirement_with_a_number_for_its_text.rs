use kin::prelude::*;

#[constraint]
#[require(k > 0.0, 3)]
fn f(a: Coord, k: f64) -> f64 {
    a - k
}

fn main() {}
