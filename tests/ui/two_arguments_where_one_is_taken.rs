use kin::prelude::*;

#[constraint]
fn pin(i: Planar, j: Planar, u: Vec2) -> Vec2 {
    i.point(u.x, u.y) - j.r
}

fn main() {}
