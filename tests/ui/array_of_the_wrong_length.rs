use kin::prelude::*;

#[constraint]
fn loop_closure(theta: Coord, x: Coord, l: f64) -> [f64; 2] {
    [l * theta.cos() - x, l * theta.sin(), theta - x]
}

fn main() {}
