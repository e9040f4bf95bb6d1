use kin::prelude::*;

#[constraint]
fn circle(x: Coord, y: Coord, r: f64) -> f64 {
    x.square() + y * y - r * r
}

fn main() {}
