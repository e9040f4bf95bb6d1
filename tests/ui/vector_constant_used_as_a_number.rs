use kin::prelude::*;

const UP: Vec2 = Vec2 { x: 0.0, y: 1.0 };

#[constraint]
fn level(x: Coord) -> f64 {
    x - UP
}

fn main() {}
