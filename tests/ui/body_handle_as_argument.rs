use kin::prelude::*;

#[constraint]
fn level(i: PlanarBody, h: f64) -> f64 {
    i.theta - h
}

fn main() {}
