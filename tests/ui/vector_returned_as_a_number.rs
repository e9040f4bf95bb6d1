use kin::prelude::*;

#[constraint]
fn pin(i: Planar, j: Planar, u: Vec2) -> f64 {
    i.point(u) - j.point(u)
}

fn main() {}
