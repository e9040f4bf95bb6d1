use kin::prelude::*;

#[constraint]
fn distance(i: Planar, j: Planar, length: f64) -> f64 {
    (i.r - j.r).norm() - lenght
}

fn main() {}
