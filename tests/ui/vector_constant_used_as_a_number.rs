use kin::prelude::*;

const UP: Vec2 = vec2(0.0, 1.0);

#[constraint]
fn level(x: Coord) -> f64 {
    x - UP
}

fn main() {}
