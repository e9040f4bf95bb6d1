use kin::prelude::*;

#[constraint]
fn profile(x: Coord, limit: f64) -> f64 {
    let height;
    if x > limit {
        height = x - limit;
    }
    height - x
}

fn main() {}
