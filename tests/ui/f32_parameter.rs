use kin::prelude::*;

#[constraint]
fn level(i: Planar, h: f32) -> f64 {
    i.theta - h
}

fn main() {}
