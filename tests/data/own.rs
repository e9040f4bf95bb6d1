//! The examples' own constraints.

use kin::prelude::*;

/// Loop closure of the offset slider-crank.      [m]
#[constraint]
pub fn slider_crank(
    theta3: Coord,
    x: Coord,
    t: Time,
    l2: f64,
    l3: f64,
    h: f64,
    omega: f64,
) -> [f64; 2] {
    let theta2 = omega * t;
    [l2 * theta2.cos() + l3 * theta3.cos() - x, l2 * theta2.sin() + l3 * theta3.sin() - h]
}

/// Pin in a parabolic slot.      [m]
#[constraint]
pub fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - k * s.x * s.x
}

/// Geneva drive: where the pin P of the driver is in a slot, s × e / |ū| = 0, s = P as the wheel
/// sees it and e the slot's direction; else the wheel stands at its station.      [–, rad]
///
/// `pin`: ū, P in the driver, on its x-axis; at the driver's angle 0 it is deepest in a slot.
/// `slots`: their number; the wheel's axle is to the right.
#[constraint]
#[require(slots >= 3.0 && slots.fract() == 0.0, "a Geneva wheel has three slots at least, and a whole number of them")]
pub fn geneva(driver: Planar, wheel: Planar, pin: Vec2, slots: f64) -> f64 {
    let step = TAU / slots;
    let turns = (driver.theta / TAU).round();
    let ahead = driver.theta - TAU * turns;
    let reach = 0.5 * PI - 0.5 * step; // of the driver, to either side of the line of axles
    if ahead.abs() < reach {
        let s = wheel.local(driver.point(pin));
        let slot = PI + step * turns; // against the driver's sense
        s.cross(vec2(slot.cos(), slot.sin())) / pin.norm()
    } else {
        let station = if ahead > 0.0 { turns + 0.5 } else { turns - 0.5 };
        wheel.theta + step * station
    }
}
