//! The constraints whose expansions are kept beside this file, one file each, to be read in review.

use kin::prelude::*;

/// Pin joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0.      [m]
#[constraint]
pub fn revolute(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> Vec2 {
    i.point(u_i) - j.point(u_j)
}

/// Loop closure of the slider-crank, crank driven at ω.      [m]
#[constraint]
fn slider_crank(theta3: Coord, x: Coord, t: Time, l2: f64, l3: f64, h: f64, omega: f64) -> [f64; 2] {
    let theta2 = omega * t;
    [l2 * theta2.cos() + l3 * theta3.cos() - x,
     l2 * theta2.sin() + l3 * theta3.sin() - h]
}

/// Knife-edge follower: the tip stays on the cam profile ρ(φ), worn off by `wear`; φ is measured
/// from the cam's x-axis.      [m]
#[constraint]
fn on_cam(cam: Planar, follower: Planar, tip: Vec2, profile: Law) -> f64 {
    let p = cam.local(follower.point(tip));
    let phi = p.y.atan2(p.x);
    p.norm() - profile.at(phi) + wear(phi, MOST_WEAR)
}

/// A cylindrical joint: the axes are parallel and the line between two of their points is along
/// them.      [–, –, m, m]
#[constraint]
pub fn cylindrical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, f_i: Vec3, g_i: Vec3, h_j: Vec3) -> (f64, f64, f64, f64) {
    let f = i.direction(f_i);
    let g = i.direction(g_i);
    let h = j.direction(h_j);
    let d = i.point(u_i) - j.point(u_j);
    (f.dot(h), g.dot(h), f.dot(d), g.dot(d))
}

const MOST_WEAR: f64 = 1e-3;

fn wear<D: Dual>(phi: Real<D>, most: f64) -> Real<D> {
    most * phi.sin().powi(2)
}
