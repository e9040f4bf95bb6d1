use kin::prelude::*;

#[constraint]
fn pin(i: Planar, j: Planar, u: Vec2) -> Vec2 {
    i.r + i.a * u - j.r
}

fn main() {}
