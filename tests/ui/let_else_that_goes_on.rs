use kin::prelude::*;

#[constraint]
fn stop(x: Coord, limit: Option<f64>) -> f64 {
    let Some(limit) = limit else {
        0.0;
    };
    x - limit
}

fn main() {}
