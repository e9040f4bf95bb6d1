//! Mechanisms that several tests use.

use std::f64::consts::{FRAC_PI_6, TAU};

use super::*;
use crate::coordinates::Link;
use crate::model::mechanism::{Mechanism, deg, pose};
use crate::numbers::algebra::Vec2;
use crate::system::System;

pub fn v(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

/// The lecture's two-link manipulator, lengths in units of `u` metres, from a rough guess.
pub fn two_link(u: f64) -> System {
    let l2 = 0.2 / u;
    let l3 = 0.35 / u;
    let mut m = Mechanism::new("two-link manipulator");
    let body1 = m.planar("body1", pose(0.0168 / u, -0.00559 / u, -0.02)).unwrap();
    let body2 = m.planar("body2", pose(0.0808 / u, 0.0667 / u, 0.539)).unwrap();
    let body3 = m.planar("body3", pose(0.334 / u, 0.125 / u, 0.259)).unwrap();
    m.add("ground", Fixed { b: body1, pose: pose(0.0, 0.0, 0.0) }).unwrap();
    m.add("O", revolute(body1, body2, v(0.0, 0.0), v(-0.5 * l2, 0.0))).unwrap();
    m.add("A", revolute(body2, body3, v(0.5 * l2, 0.0), v(-0.5 * l3, 0.0))).unwrap();
    m.add("link2", drive_angle(body2, Law::linear(FRAC_PI_6, 0.5))).unwrap();
    m.add("link3", drive_angle(body3, Law::linear(0.5 * FRAC_PI_6, 0.75))).unwrap();
    m.build().unwrap()
}

pub fn slider_crank(l: [f64; 3], omega: f64, guess: [f64; 2]) -> System {
    let mut m = Mechanism::new("slider-crank");
    let theta3 = m.angle("theta3", guess[0]).unwrap();
    let x = m.length("x", guess[1]).unwrap();
    m.add("loop", SliderCrank { theta3, x, l, omega }).unwrap();
    m.build().unwrap()
}

/// The page's four-bar: everything from zero poses.
pub fn four_bar(preferred: f64) -> (System, Link, Link) {
    let mut m = Mechanism::new("four-bar");
    let ground = m.ground();
    let crank = m.link("crank", 1.0).unwrap();
    let coupler = m.link("coupler", 3.5).unwrap();
    let rocker = m.link("rocker", 3.0).unwrap();
    m.add("O", revolute(ground, crank, v(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(ground, rocker, v(4.0, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(TAU))).unwrap();
    m.prefer(rocker, deg(preferred));
    (m.build().unwrap(), coupler, rocker)
}
