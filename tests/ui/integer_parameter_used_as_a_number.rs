use kin::prelude::*;

#[constraint]
fn scaled(i: Planar, teeth: usize, k: f64) -> f64 {
    i.theta * teeth - k
}

fn main() {}
