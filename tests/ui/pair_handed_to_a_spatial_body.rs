use kin::prelude::*;

#[constraint]
fn on_axis(i: Spatial) -> f64 {
    i.point((0.0, 1.0)).x
}

fn main() {}
