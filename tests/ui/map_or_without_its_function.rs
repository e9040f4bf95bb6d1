use kin::prelude::*;

#[constraint]
fn stop(x: Coord, limit: Option<f64>) -> f64 {
    x - limit.map_or(0.0)
}

fn main() {}
