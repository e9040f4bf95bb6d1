use kin::prelude::*;

#[constraint]
fn on_line(i: Planar, u: Vec2) -> f64 {
    i.point(u).z
}

fn main() {}
