use kin::prelude::*;

#[constraint(lanes)]
fn level(i: Planar, h: f64) -> f64 {
    i.theta - h
}

fn main() {}
