use kin::prelude::*;

#[constraint(dual, lanes)]
fn level(i: Planar, h: f64) -> f64 {
    i.theta - h
}

fn main() {}
