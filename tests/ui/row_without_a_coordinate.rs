use kin::prelude::*;

#[constraint]
fn loop_closure(theta: Coord, l: f64, h: f64) -> [f64; 2] {
    [l * theta.sin() - h, l - h]
}

fn main() {}
