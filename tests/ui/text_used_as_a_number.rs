use kin::prelude::*;

const NAME: &str = "slot";

#[constraint]
fn level(x: Coord) -> f64 {
    x - NAME
}

fn main() {}
