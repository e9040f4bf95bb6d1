use kin::prelude::*;

#[constraint]
fn stop(x: Coord, limit: f64) -> f64 {
    x - (x > limit).sin()
}

fn main() {}
