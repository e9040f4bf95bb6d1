use kin::prelude::*;

type Angle = Coord;

#[constraint]
fn level(a: Angle) -> f64 {
    a.sin()
}

fn main() {}
