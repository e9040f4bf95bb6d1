use kin::prelude::*;

type Body = Planar;

#[constraint]
fn pin(i: Body, j: Planar, u: Vec2) -> Vec2 {
    i.point(u) - j.point(u)
}

fn main() {}
