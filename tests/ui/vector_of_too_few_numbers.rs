use kin::prelude::*;

#[constraint]
fn pin(i: Planar, x: f64) -> Vec2 {
    i.r - vec2(x)
}

fn main() {}
