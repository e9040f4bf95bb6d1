use kin::prelude::*;

#[constraint(dual, warn_dual)]
fn scaled(i: Planar, k: f64) -> f64 {
    i.theta - k
}

fn main() {}
