use kin::prelude::*;

#[constraint]
fn chain(theta: [Coord; 3], x: f64) -> f64 {
    theta[0].cos() + theta[3].cos() - x
}

fn main() {}
