use kin::prelude::*;

#[constraint]
fn stop(x: Coord, limit: f64) -> f64 {
    let gap = if x > limit { x - limit };
    gap + x
}

fn main() {}
