use kin::prelude::*;

/// Knife-edge follower: the tip stays on the cam profile ρ(φ), φ measured from the cam's x-axis.
/// [m]
#[constraint]
fn on_cam(cam: Planar, follower: Planar, tip: Vec2, profile: Law) -> f64 {
    let p = cam.local(follower.point(tip));
    p.norm() - profile
}

fn main() {}
