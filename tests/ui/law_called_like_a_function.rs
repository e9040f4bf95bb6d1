use kin::prelude::*;

#[constraint]
fn on_cam(cam: Planar, follower: Planar, tip: Vec2, profile: Law) -> f64 {
    let p = cam.local(follower.point(tip));
    p.norm() - profile(p.y.atan2(p.x))
}

fn main() {}
