use kin::prelude::*;

type Angle = Coord;

#[constraint]
fn gear(a: Angle, b: Coord) -> f64 {
    a - b
}

fn main() {}
