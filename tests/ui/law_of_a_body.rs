use kin::prelude::*;

#[law]
fn profile(cam: Planar, h: f64) -> f64 {
    h * cam.theta.cos()
}

fn main() {}
