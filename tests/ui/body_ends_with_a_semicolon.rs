use kin::prelude::*;

#[constraint]
fn level(theta: Coord, h: f64) -> f64 {
    let y = theta.sin();
    y - h;
}

fn main() {}
