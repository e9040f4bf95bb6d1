use kin::prelude::*;

#[constraint]
fn gear(i: Planar, j: Planar) -> f64 {
    i.theta + 2 * j.theta
}

fn main() {}
