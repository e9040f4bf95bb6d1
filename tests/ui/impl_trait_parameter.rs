use kin::prelude::*;

#[constraint]
fn level(i: Planar, h: impl Into<f64>) -> f64 {
    i.theta - h
}

fn main() {}
