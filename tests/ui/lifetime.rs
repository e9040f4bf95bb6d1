use kin::prelude::*;

#[constraint]
fn level<'a>(i: Planar, h: f64) -> f64 {
    i.theta - h
}

fn main() {}
