//! Torques of Hooke's joint and of a gyroscope against their closed forms.

use kin::prelude::*;
use kin::{Load, Mechanism};

use crate::both::Engines;

const X: Vec3 = Vec3::new(1.0, 0.0, 0.0);
const Z: Vec3 = Vec3::new(0.0, 0.0, 1.0);

/// Two shafts at an angle β by a Hooke's joint, the second one braked by a torque: at the turn φ of
/// the first one, counted from where its bar of the cross lies in the plane of the shafts, the
/// joint holds T / √D and the drive gives T cos β / D, D = 1 − sin² β cos² φ.
#[test]
fn hookes_joint() {
    for beta in [0.2_f64, 0.7, 1.2] {
        let brake = 13.0;
        let ground_point = vec3(0.0, 0.0, 0.0);
        let out = vec3(beta.cos(), beta.sin(), 0.0);
        let mut m = Mechanism::new("two shafts");
        let first = m.spatial("first", SpatialPose::at(vec3(-0.3, 0.0, 0.0))).expect("a body");
        let second = m.spatial("second", SpatialPose::turned(out * 0.4, Z, beta)).expect("a body");
        let ground = m.ground();
        m.add(
            "bearing",
            spatial::revolute(first, ground, ground_point, vec3(-0.3, 0.0, 0.0), X, X),
        )
        .expect("a joint");
        // The bars at the start: of the first along y, in the plane of the shafts; of the second
        // along z.
        let cross = spatial::universal(
            second,
            first,
            vec3(-0.4, 0.0, 0.0),
            vec3(0.3, 0.0, 0.0),
            Z,
            vec3(0.0, 1.0, 0.0),
        );
        m.add("cross", cross).expect("a joint");
        let held = spatial::point_on_line(second, ground, ground_point, out * 0.4, out);
        m.add("second bearing", held).expect("a joint");
        m.add("motor", spatial::drive_turn(first, ground, X, X, Law::ramp(3.0))).expect("a driver");
        m.load("brake", Load::torque(second, out * -brake)).expect("a load");
        let system = m.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 2.2, 45)).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        let effort = forces.drive("motor").expect("a driver").effort().values().to_vec();
        let torque = forces
            .reaction("cross")
            .expect("a joint")
            .on(second)
            .expect("on it")
            .torque()
            .expect("unique");
        let mut off = 0.0_f64;
        for (k, t) in motion.times().iter().enumerate() {
            let d = 1.0 - (beta.sin() * (3.0 * t).cos()).powi(2);
            off = off.max((effort[k] - brake * beta.cos() / d).abs());
            off = off.max((torque[k].norm() - brake / d.sqrt()).abs());
            off = off.max((torque[k].dot(out) - brake).abs());
        }
        println!("β = {beta}: off by {off:.1e}");
        assert!(off < 1e-11 * brake / beta.cos(), "β = {beta}: {off:e}");
        assert!(forces.balance().worst() < 1e-12);
    }
}

/// A heavy top that is turned at ω about the vertical, leaning by b and spinning at s: its bearing
/// holds I3 (s + ω cos b) ω sin b − (I1 + m h²) ω² sin b cos b − m g h sin b about the line across
/// both axes.
#[test]
fn a_top_that_is_led_round() {
    let mass = 2.3;
    let h = 0.45;
    let i1 = 0.05;
    let i3 = 0.08;
    let g = 9.81;
    let w = 2.1;
    let spin = 37.0;
    for b in [0.3_f64, 1.1, std::f64::consts::FRAC_PI_2, 2.4] {
        let mut m = Mechanism::new("top");
        let lean = vec3(b.sin(), 0.0, b.cos());
        let yoke = m.spatial("yoke", SpatialPose::at(vec3(0.0, 0.0, 0.0))).expect("a body");
        let top = m
            .spatial("top", SpatialPose::turned(vec3(0.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), b))
            .expect("a body");
        let o = vec3(0.0, 0.0, 0.0);
        let ground = m.ground();
        m.add("column", spatial::revolute(yoke, ground, o, o, Z, Z)).expect("a joint");
        m.add("turn", spatial::drive_turn(yoke, ground, Z, Z, Law::ramp(w))).expect("a driver");
        m.add("bearing", spatial::revolute(top, yoke, o, o, Z, lean)).expect("a joint");
        m.add("spin", spatial::drive_turn(top, yoke, Z, lean, Law::ramp(spin))).expect("a driver");
        let inertia = [[i1, 0.0, 0.0], [0.0, i1, 0.0], [0.0, 0.0, i3]];
        m.mass(top, mass, vec3(0.0, 0.0, h), inertia).expect("a mass");
        m.gravity(vec3(0.0, 0.0, -g));
        let system = m.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 3.0, 61)).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        // The yoke carries the opposite, in whose axes the line across is y.
        let on_yoke =
            forces.reaction("bearing").expect("a joint").on(yoke).expect("on it").in_body();
        let due = i3 * (spin + w * b.cos()) * w * b.sin()
            - (i1 + mass * h * h) * w * w * b.sin() * b.cos()
            - mass * g * h * b.sin();
        let off = on_yoke
            .torque()
            .expect("unique")
            .iter()
            .fold(0.0_f64, |off, t| off.max((*t + vec3(0.0, due, 0.0)).norm()));
        println!("b = {b}: off by {off:.1e} of {due:.3}");
        assert!(off < 1e-11 * (1.0 + due.abs()), "b = {b}: {off:e}");
        assert!(forces.drive("spin").expect("a driver").peak().value.abs() < 1e-11);
    }
}
