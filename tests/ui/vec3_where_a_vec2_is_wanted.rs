use kin::prelude::*;

#[constraint]
fn pin(i: Planar, j: Planar, u: Vec3) -> Vec2 {
    i.point(u) - j.r
}

fn main() {}
