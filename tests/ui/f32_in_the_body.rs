use kin::prelude::*;

#[constraint]
fn scaled(i: Planar, k: f64) -> f64 {
    let ratio: f32 = 0.5;
    i.theta * ratio - k
}

fn main() {}
