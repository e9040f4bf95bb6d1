use kin::prelude::*;

#[constraint]
fn level(theta: Coord, h: f64) -> f64 {
    sinus(theta) - h
}

fn main() {}
