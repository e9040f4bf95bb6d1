use kin::prelude::*;

#[constraint]
fn level(i: Planar, angle: f64) -> f64 {
    i.theta() - angle
}

fn main() {}
