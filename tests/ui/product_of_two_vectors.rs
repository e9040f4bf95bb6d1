use kin::prelude::*;

#[constraint]
fn perpendicular(i: Planar, j: Planar, h_i: Vec2, h_j: Vec2) -> f64 {
    i.direction(h_i) * j.direction(h_j)
}

fn main() {}
