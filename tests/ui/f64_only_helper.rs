use kin::prelude::*;

fn lift(x: f64) -> f64 {
    0.3 * x.sin()
}

#[constraint]
fn on_cam(cam: Planar, follower: Planar) -> f64 {
    follower.r.y - lift(cam.theta)
}

fn main() {}
