//! The examples' own constraints.

use kin::prelude::*;

/// Loop closure of the offset slider-crank.      [m]
#[constraint]
pub fn slider_crank(theta3: Coord, x: Coord, t: Time, l2: f64, l3: f64, h: f64, omega: f64) -> [f64; 2] {
    let theta2 = omega * t;
    [l2 * theta2.cos() + l3 * theta3.cos() - x, l2 * theta2.sin() + l3 * theta3.sin() - h]
}

/// Pin in a parabolic slot.      [m]
#[constraint]
pub fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - k * s.x * s.x
}
