use kin::prelude::*;

#[constraint]
fn polynomial(x: Coord, c: &[f64]) -> f64 {
    c[0] + c[1] * x
}

fn main() {}
