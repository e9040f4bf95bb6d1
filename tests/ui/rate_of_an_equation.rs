use kin::prelude::*;

#[constraint]
fn faster(x: Coord, v: Rate) -> f64 {
    x - v
}

fn main() {}
