use kin::prelude::*;

#[constraint]
fn slide(i: Planar, j: Planar, h: Vec2) -> (f64, f64) {
    let offset = i.direction(h).dot(i.r - j.r);
    (i.theta - j.theta, offset, 0.0)
}

fn main() {}
