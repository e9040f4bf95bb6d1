use kin::prelude::*;

fn lift<D: Dual>(x: Real<D>) -> Real<D> {
    0.3 * x.sin()
}

#[constraint]
fn on_cam(cam: Planar, follower: Planar) -> f64 {
    follower.r.y - lift(cam.theta, 2.0)
}

fn main() {}
