use kin::prelude::*;

#[constraint]
fn level(theta: Coord, h: f64) {
    theta.sin() - h
}

fn main() {}
