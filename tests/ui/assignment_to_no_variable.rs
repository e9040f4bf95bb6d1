use kin::prelude::*;

#[constraint]
fn level(theta: Coord, h: f64) -> f64 {
    sum += theta;
    theta - h
}

fn main() {}
