use kin::prelude::*;

#[constraint]
fn level(theta: Coord) -> f64 {}

fn main() {}
