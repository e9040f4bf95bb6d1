use kin::prelude::*;

#[constraint]
fn level(i: Link, j: Planar) -> f64 {
    j.theta
}

fn main() {}
