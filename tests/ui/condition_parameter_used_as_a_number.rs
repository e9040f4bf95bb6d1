use kin::prelude::*;

#[constraint]
fn mirrored(i: Planar, left: bool, k: f64) -> f64 {
    i.theta * left - k
}

fn main() {}
