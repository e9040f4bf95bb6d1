use kin::prelude::*;

#[constraint]
fn level(i: Planar, (a, b): (f64, f64)) -> f64 {
    a * i.theta - b
}

fn main() {}
