use kin::prelude::*;

#[constraint]
fn distance(i: Planar, j: Planar, l: f64) -> f64 {
    (i.r - j.r).length() - l
}

fn main() {}
