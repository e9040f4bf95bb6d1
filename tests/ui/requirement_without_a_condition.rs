use kin::prelude::*;

#[constraint]
#[require()]
fn f(a: Coord, k: f64) -> f64 {
    a - k
}

fn main() {}
