use kin::prelude::*;

#[constraint]
fn f(b: Spatial, axis: Axis) -> f64 {
    b.direction(axis.x).z
}

fn main() {}
