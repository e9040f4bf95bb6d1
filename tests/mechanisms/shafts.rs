//! Shafts at an angle: Hooke's joint, the double Cardan, a constant-velocity joint, bevel gears, a
//! screw. Several turns each: no angle is lost at a cut.

use kin::prelude::*;
use kin::{Coordinate, Motion, SpatialPose};

use crate::engines::Engines;
use crate::worst;

const O: Vec3 = Vec3::new(0.0, 0.0, 0.0);

/// A shaft along `h` with one fork along `f` at the angle zero, on a hinge at the origin; and its
/// angle, counted on.
fn shaft(m: &mut Mechanism, name: &str, h: Vec3, f: Vec3) -> (SpatialBody, Coordinate) {
    let body = m.spatial(name, SpatialPose::at(O)).unwrap();
    let axis = Axis::new(h, f);
    let phi = m.angle(&format!("{name} angle"), 0.0).unwrap();
    m.add(&format!("{name} bearing"), spatial::revolute(body, Ground, O, O, axis, h)).unwrap();
    m.add(&format!("{name} turn"), spatial::relative_angle(body, Ground, phi, axis, axis)).unwrap();
    (body, phi)
}

fn run(m: Mechanism) -> Motion {
    m.build().unwrap().run_both(linspace(0.0, 4.0, 801)).unwrap()
}

/// tan φ2 = tan φ1 / cos β and ω2/ω1 = cos β/(1 − sin² β sin² φ1'), the fork of the first shaft in
/// the plane of both at φ1 = 0.
#[test]
fn hookes_joint() {
    let beta = 0.6_f64;
    let omega = 5.0;
    let mut m = Mechanism::new("Hooke's joint");
    let second = vec3(beta.cos(), beta.sin(), 0.0);
    let (i, _) = shaft(&mut m, "driver", Vec3::x(), Vec3::y());
    let (j, phi) = shaft(&mut m, "driven", second, -Vec3::z());
    // the bearings hold both shafts at the centre of the cross: only its right angle is left
    m.add("cross", spatial::perpendicular(i, j, Vec3::y(), -Vec3::z())).unwrap();
    m.add("motor", spatial::drive_turn(i, Ground, Vec3::x(), Vec3::x(), Law::ramp(omega))).unwrap();
    let motion = run(m);
    let phi = motion.coordinate(phi).unwrap();
    let error = worst(&motion, |k, t| {
        let (s1, c1) = (omega * t).sin_cos();
        let (s2, c2) = phi.value.values()[k].sin_cos();
        s2 * c1 * beta.cos() - c2 * s1
    });
    assert!(error < 1e-13, "{error:e}");
    // three turns and more, unwrapped
    assert!((phi.value.values()[800] - omega * 4.0).abs() < 0.3, "{}", phi.value.values()[800]);
    let error = worst(&motion, |k, t| {
        let c = (omega * t).cos();
        phi.rate.values()[k] - omega * beta.cos() / (1.0 - (beta.sin() * c).powi(2))
    });
    assert!(error < 1e-11, "{error:e}");
}

/// Two Hooke's joints with equal angles and the middle shaft's forks in one plane: the output turns
/// as the input.
#[test]
fn double_cardan_turns_evenly() {
    let beta = 0.5_f64;
    let omega = 5.0;
    let mut m = Mechanism::new("double Cardan");
    let middle = vec3(beta.cos(), beta.sin(), 0.0);
    let last = vec3((2.0 * beta).cos(), (2.0 * beta).sin(), 0.0);
    let (i, _) = shaft(&mut m, "input", Vec3::x(), Vec3::y());
    let (j, between) = shaft(&mut m, "middle", middle, -Vec3::z());
    let (k, phi) =
        shaft(&mut m, "output", last, vec3(-(2.0 * beta).sin(), (2.0 * beta).cos(), 0.0));
    m.add("cross 1", spatial::perpendicular(i, j, Vec3::y(), -Vec3::z())).unwrap();
    m.add(
        "cross 2",
        spatial::perpendicular(
            j,
            k,
            -Vec3::z(),
            vec3(-(2.0 * beta).sin(), (2.0 * beta).cos(), 0.0),
        ),
    )
    .unwrap();
    m.add("motor", spatial::drive_turn(i, Ground, Vec3::x(), Vec3::x(), Law::ramp(omega))).unwrap();
    let motion = run(m);
    let phi = motion.coordinate(phi).unwrap();
    let between = motion.coordinate(between).unwrap();
    assert!(worst(&motion, |k, t| phi.value.values()[k] - omega * t) < 1e-12);
    assert!(
        worst(&motion, |k, _| phi.rate.values()[k] - omega) < 1e-11
            && worst(&motion, |k, _| phi.second_rate.values()[k]) < 1e-9
    );
    assert!(
        between.rate.max() > 1.1 * omega,
        "the middle shaft does not turn evenly: {}",
        between.rate.max()
    );
}

#[test]
fn a_constant_velocity_joint_turns_evenly() {
    let beta = 0.7_f64;
    let omega = 5.0;
    let mut m = Mechanism::new("constant velocity");
    let second = vec3(beta.cos(), beta.sin(), 0.0);
    let (i, _) = shaft(&mut m, "input", Vec3::x(), Vec3::z());
    let j = m.spatial("output", SpatialPose::turned(O, Vec3::z(), beta)).unwrap();
    let phi = m.angle("angle", 0.0).unwrap();
    // the output has its own frame along the shaft; the joint holds the point and the twist, the
    // bearing the two directions that are left
    m.add("bearing", spatial::parallel(j, Ground, Vec3::x(), second)).unwrap();
    m.add(
        "joint",
        spatial::constant_velocity(
            i,
            j,
            O,
            O,
            Axis::new(Vec3::x(), Vec3::z()),
            Axis::new(Vec3::x(), Vec3::z()),
        ),
    )
    .unwrap();
    m.add(
        "turn",
        spatial::relative_angle(
            j,
            Ground,
            phi,
            Axis::new(Vec3::x(), Vec3::z()),
            Axis::new(second, Vec3::z()),
        ),
    )
    .unwrap();
    m.add("motor", spatial::drive_turn(i, Ground, Vec3::x(), Vec3::x(), Law::ramp(omega))).unwrap();
    let motion = run(m);
    let phi = motion.coordinate(phi).unwrap();
    assert!(worst(&motion, |k, t| phi.value.values()[k] - omega * t) < 1e-12);
    assert!(worst(&motion, |k, _| phi.rate.values()[k] - omega) < 1e-12);
}

/// Bevel gears of 20 and 30 teeth: the second shaft turns at −2/3 of the first, for seven turns.
#[test]
fn bevel_gears_keep_their_ratio() {
    let mut m = Mechanism::new("bevel gears");
    let second = vec3(0.3, 1.0, 0.2).normalize();
    let (i, _) = shaft(&mut m, "pinion", Vec3::x(), Vec3::y());
    let (j, phi) = shaft(&mut m, "wheel", second, Vec3::z());
    let a = Axis::new(Vec3::x(), Vec3::y());
    let b = Axis::new(second, Vec3::z());
    m.add("mesh", spatial::gear(i, j, Ground, a, b, a, b, 20.0, 30.0, 0.0)).unwrap();
    m.add("motor", spatial::drive_turn(i, Ground, a, a, Law::polynomial(&[0.0, 1.0, 2.0])))
        .unwrap();
    let motion = run(m);
    let phi = motion.coordinate(phi).unwrap();
    assert!(worst(&motion, |k, t| phi.value.values()[k] + 2.0 / 3.0 * (t + 2.0 * t * t)) < 1e-11);
    assert!(worst(&motion, |k, _| phi.second_rate.values()[k] + 8.0 / 3.0) < 1e-9);
}

/// A screw driven along its axis turns by 2π a lead, right-handed; one driven in turn goes a lead a
/// turn.
#[test]
fn a_screw_goes_a_lead_a_turn() {
    let axis = vec3(1.0, 2.0, -0.5);
    let at = vec3(0.3, -0.2, 0.1);
    let mut m = Mechanism::new("screw");
    let nut = m.spatial("nut", SpatialPose::at(at)).unwrap();
    let phi = m.angle("phi", 0.0).unwrap();
    m.add("thread", spatial::screw(nut, Ground, O, at, axis, axis, 0.05)).unwrap();
    m.add("turn", spatial::relative_angle(nut, Ground, phi, axis, axis)).unwrap();
    m.add("feed", spatial::drive_slide(nut, Ground, O, at, axis, Law::cycloidal(0.4, 4.0)))
        .unwrap();
    let motion = run(m);
    let phi = motion.coordinate(phi).unwrap();
    assert!(
        worst(&motion, |k, t| phi.value.values()[k] - TAU / 0.05 * Law::cycloidal(0.4, 4.0).at(t))
            < 1e-10
    );
    assert!((phi.value.values()[800] - 8.0 * TAU).abs() < 1e-11, "eight turns");
}

/// A pinion on a moving rack and a rack on a pinion that turns: r φ either way.
#[test]
fn rack_and_pinion() {
    let r = 0.04;
    let z = Vec3::z();
    let mut m = Mechanism::new("rack and pinion");
    let pinion = m.spatial("pinion", SpatialPose::at(vec3(0.0, r, 0.0))).unwrap();
    let rack = m.spatial("rack", SpatialPose::at(O)).unwrap();
    m.add("bearing", spatial::revolute(pinion, Ground, O, vec3(0.0, r, 0.0), z, z)).unwrap();
    m.add("guide", spatial::prismatic(rack, Ground, O, O, Vec3::x(), EulerParameters::identity()))
        .unwrap();
    m.add("mesh", spatial::rack_and_pinion(pinion, rack, O, O, z, Axis::new(z, Vec3::x()), r, 0.0))
        .unwrap();
    m.add("motor", spatial::drive_turn(pinion, Ground, z, z, Law::ramp(3.0))).unwrap();
    let motion = run(m);
    let x = motion.coordinate(rack.x()).unwrap();
    // the rack under a pinion that turns counter-clockwise goes along +x
    assert!(worst(&motion, |k, t| x.value.values()[k] - r * 3.0 * t) < 1e-13);
}
