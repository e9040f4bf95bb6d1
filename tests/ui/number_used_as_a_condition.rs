use kin::prelude::*;

#[constraint]
fn stop(x: Coord, limit: f64) -> f64 {
    if limit { x - limit } else { x }
}

fn main() {}
