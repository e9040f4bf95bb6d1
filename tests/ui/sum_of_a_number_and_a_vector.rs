use kin::prelude::*;

#[constraint]
fn distance(i: Planar, j: Planar, l: f64) -> f64 {
    let d = i.r - j.r;
    (d - l).norm()
}

fn main() {}
