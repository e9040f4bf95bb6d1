use kin::prelude::*;

#[constraint]
fn slide(i: Planar, theta0: f64) -> f64 {
    let (sin, cos, tan) = (i.theta - theta0).sin_cos();
    sin + cos + tan
}

fn main() {}
