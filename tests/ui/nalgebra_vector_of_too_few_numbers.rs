use kin::prelude::*;

use kin::nalgebra::Vector3;

#[constraint]
fn plane(a: Coord, b: Coord) -> f64 {
    let p = Vector3::new(a, b);
    p.x + p.y
}

fn main() {}
