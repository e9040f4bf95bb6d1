//! Coulomb's law at the contacts of a joint: its friction by its reaction.

use kin::forces::Forces;
use kin::loads::Friction;
use kin::prelude::*;
use kin::{Error, Load, Mechanism};

use crate::both::Engines;

const ZERO: Vec3 = Vec3::new(0.0, 0.0, 0.0);

/// A guide or a pin, with the bodies the one way or the other round.
#[derive(Clone, Copy, Debug)]
struct Case {
    axis: Vec3,
    mu: f64,
    length: f64,
    width: f64,
    /// The rate along it.
    rate: f64,
    /// True if the ground is body i.
    swapped: bool,
}

/// The rate at which friction sets in.
const ONSET: f64 = 0.05;

/// Force and torque of a slide's friction on the body that moves, by the reaction on it: the normal
/// forces at both ends of the guide, F/2 ± T × h/L, those across its width, 2 T · h/b, and each of
/// them μ tanh(v/v₀) times against the motion, off the line by half of the width.
fn slide(case: Case, force: Vec3, torque: Vec3) -> [Vec3; 2] {
    let h = case.axis;
    let across = |v: Vec3| v - h * h.dot(v);
    let force = across(force);
    let bend = across(torque).cross(h) * (1.0 / case.length);
    let held = h.dot(torque);
    let turn = if held == 0.0 { 0.0 } else { (2.0 * held / case.width).abs() };
    let sum = (force * 0.5 + bend).norm() + (force * 0.5 - bend).norm() + turn;
    let share = case.mu * (case.rate / ONSET).tanh();
    // Body i slides inside of body j: it touches on the side away from its reaction.
    let side = if case.swapped { -1.0 } else { 1.0 };
    [h * (-share * sum), force.cross(h) * (side * 0.5 * share * case.width)]
}

fn near(found: Vec3, due: Vec3, what: &str) {
    assert!(
        (found - due).norm() < 1e-9 * (1.0 + due.norm()),
        "{what}: {found:?} instead of {due:?}"
    );
}

/// A carriage with a load, led beside the line of its rail, so that friction makes friction.
fn carriage(case: Case) -> (System, SpatialBody) {
    let mut m = Mechanism::new("carriage");
    let ground = SpatialBody::from(m.ground());
    let h = case.axis;
    let start = case.axis * 0.1;
    let body = m.spatial("carriage", SpatialPose::at(start)).expect("a body");
    let same = EulerParameters::identity();
    let [i, j] = if case.swapped { [ground, body] } else { [body, ground] };
    m.add("rail", spatial::prismatic(i, j, ZERO, ZERO, h, same)).expect("a joint");
    m.friction("rail", Friction::slide(case.mu, [case.length, case.width], ONSET))
        .expect("friction");
    let beside = vec3(0.1, -0.05, 0.12);
    let law = Law::linear(0.1 + h.dot(beside), case.rate);
    m.add("winch", spatial::drive_slide(body, ground, beside, ZERO, h, law)).expect("a driver");
    let inertia = [[0.2, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 0.4]];
    m.mass(body, 2.0, vec3(0.05, 0.02, -0.03), inertia).expect("a mass");
    m.gravity(vec3(0.5, 1.2, -9.81));
    let work = Load::force(body, vec3(0.2, 0.1, 0.0), vec3(8.0, -5.0, 13.0));
    m.load("work", work.and(Load::torque(body, vec3(0.4, -0.3, 0.7)))).expect("a load");
    (m.build().expect("a system"), body)
}

#[test]
fn friction_of_a_rail_is_that_of_its_contacts() {
    let leaning = vec3(0.48, -0.6, 0.64);
    let x = vec3(1.0, 0.0, 0.0);
    let z = vec3(0.0, 0.0, 1.0);
    for (mu, length, width) in [(0.2, 0.4, 0.1), (0.7, 0.5, 0.15), (0.5, 0.3, 0.6)] {
        for axis in [x, x * -1.0, z, z * -1.0, leaning, vec3(0.36, 0.48, -0.8)] {
            for (rate, swapped) in
                [(0.3, false), (-0.3, false), (0.02, true), (-0.02, true), (-0.2, true)]
            {
                let case = Case { axis, mu, length, width, rate, swapped };
                let (system, body) = carriage(case);
                let motion = system.run([0.0, 0.5]).expect("a motion");
                let forces =
                    system.forces(&motion).unwrap_or_else(|error| panic!("{case:?}: {error}"));
                let held = forces.reaction("rail").expect("a joint").on(body).expect("its body");
                let friction =
                    forces.friction("rail").expect("friction").on(body).expect("its body");
                for k in 0..2 {
                    // Contacts are about the point of body i.
                    let middle = friction.points()[k];
                    let force = held.force().expect("unique")[k];
                    let torque = held.torque().expect("unique")[k]
                        + (held.points()[k] - middle).cross(force);
                    let [due, twist] = slide(case, force, torque);
                    near(friction.force().expect("unique")[k], due, &format!("force, {case:?}"));
                    near(
                        friction.torque().expect("unique")[k],
                        twist,
                        &format!("torque, {case:?}"),
                    );
                    let start =
                        if swapped { ZERO } else { axis * (0.1 + rate * motion.times()[k]) };
                    near(middle, start, "the middle of the guide");
                }
                assert!(forces.balance().worst() < 1e-12, "{case:?}: {}", forces.balance());
                let lost = forces.friction("rail").expect("friction").power();
                assert!(lost.max() < 0.0, "{case:?}");
            }
        }
    }
}

/// A flat slide, led beside its line.
#[test]
fn friction_of_a_flat_slide_is_that_of_its_contacts() {
    for (mu, length, width) in [(0.2, 0.4, 0.0), (0.9, 0.5, 0.2), (0.5, 0.3, 0.5)] {
        for (rate, swapped) in [(0.3, false), (-0.3, false), (0.02, true), (-0.2, true)] {
            let angle = 0.4_f64;
            let beside = vec2(0.05, -0.15);
            let h = vec2(angle.cos(), angle.sin());
            let case = Case { axis: vec3(h.x, h.y, 0.0), mu, length, width, rate, swapped };
            let mut m = Mechanism::new("slide");
            let ground = PlanarBody::from(m.ground());
            let body = m.planar("body", pose(0.0, 0.0, angle)).expect("a body");
            let o = vec2(0.0, 0.0);
            let joint = match swapped {
                true => prismatic(ground, body, o, o, vec2(-h.y, h.x), -angle),
                false => prismatic(body, ground, o, o, vec2(0.0, 1.0), angle),
            };
            m.add("guide", joint).expect("a joint");
            m.friction("guide", Friction::slide(mu, [length, width], ONSET)).expect("friction");
            let turned = vec2(h.x * beside.x - h.y * beside.y, h.y * beside.x + h.x * beside.y);
            let law = Law::linear(h.dot(turned), rate);
            m.add("winch", drive_point_along(body, beside, h, law)).expect("a driver");
            m.mass(body, 2.0, vec2(0.05, 0.02), 0.3).expect("a mass");
            m.gravity(vec2(0.5, -9.81));
            let work =
                Load::force(body, vec2(0.2, 0.1), vec2(8.0, -5.0)).and(Load::torque(body, 0.7));
            m.load("work", work).expect("a load");
            let system = m.build().expect("a system");
            let motion = system.run([0.0, 0.5]).expect("a motion");
            let forces = system.forces(&motion).unwrap_or_else(|error| panic!("{case:?}: {error}"));
            let held = forces.reaction("guide").expect("a joint").on(body).expect("its body");
            let friction = forces.friction("guide").expect("friction").on(body).expect("its body");
            let lifted = |v: Vec2| vec3(v.x, v.y, 0.0);
            for k in 0..2 {
                let force = held.force().expect("unique")[k];
                let middle = friction.points()[k];
                let torque =
                    held.torque().expect("unique")[k] + (held.points()[k] - middle).cross(force);
                let bent = vec3(0.0, 0.0, torque);
                let [due, twist] = slide(case, lifted(force), bent);
                near(
                    lifted(friction.force().expect("unique")[k]),
                    due,
                    &format!("force, {case:?}"),
                );
                let found = friction.torque().expect("unique")[k];
                assert!((found - twist.z).abs() < 1e-9, "torque, {case:?}: {found} {twist:?}");
            }
            assert!(forces.balance().worst() < 1e-12, "{case:?}: {}", forces.balance());
        }
    }
}

/// A pin in space rubs by what is across it: neither a thrust along it nor the order of its bodies
/// counts.
#[test]
fn a_thrust_along_a_pin_makes_no_friction() {
    let h = vec3(0.0, 0.6, 0.8);
    let mu = 0.3;
    let r = 0.02;
    let push = vec3(0.0, 8.0, -6.0);
    for (swapped, rate, thrust) in [(false, 2.0, 0.0), (false, -2.0, 70.0), (true, 2.0, -90.0)] {
        let mut m = Mechanism::new("shaft");
        let ground = SpatialBody::from(m.ground());
        let shaft = m.spatial("shaft", SpatialPose::at(ZERO)).expect("a body");
        let [i, j] = if swapped { [ground, shaft] } else { [shaft, ground] };
        m.add("pin", spatial::revolute(i, j, ZERO, ZERO, h, h)).expect("a joint");
        m.friction("pin", Friction::pin(mu, r, 1e-3)).expect("friction");
        m.add("motor", spatial::drive_turn(shaft, ground, h, h, Law::ramp(rate)))
            .expect("a driver");
        m.load("push", Load::force(shaft, ZERO, push + h * thrust)).expect("a load");
        let system = m.build().expect("a system");
        let motion = system.run_both([0.0, 0.5]).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        let due = mu * r * push.norm() * rate.signum();
        let effort = forces.drive("motor").expect("a driver").effort().values()[1];
        assert!((effort - due).abs() < 1e-12, "{swapped} {rate} {thrust}: {effort} {due}");
    }
}

/// Without any force there is no friction, and nothing jams.
#[test]
fn a_joint_that_holds_nothing_does_not_rub() {
    let mut m = Mechanism::new("drum");
    let drum = m.planar("drum", pose(0.0, 0.0, 0.0)).expect("a body");
    let o = vec2(0.0, 0.0);
    m.add("shaft", revolute(drum, m.ground(), o, o)).expect("a joint");
    m.friction("shaft", Friction::pin(0.2, 0.02, 1e-3)).expect("friction");
    m.add("motor", drive_angle(drum, Law::ramp(3.0))).expect("a driver");
    m.mass(drum, 1.0, o, 0.1).expect("a mass");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 0.5]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    assert_eq!(forces.drive("motor").expect("a driver").effort().values(), [0.0, 0.0]);
    assert_eq!(forces.balance().friction.values(), [0.0, 0.0]);
}

/// Two slides, each led beside its line by a winch: the one jams, the other does not.
#[test]
fn the_joint_that_jams_and_its_drive_are_named_in_any_order() {
    for names in [["left", "right"], ["right", "left"]] {
        let mut m = Mechanism::new("slides");
        let o = vec2(0.0, 0.0);
        for name in names {
            let body = m.planar(name, pose(0.0, 0.0, 0.0)).expect("a body");
            let guide = format!("{name} guide");
            m.add(&guide, prismatic(body, m.ground(), o, o, vec2(0.0, 1.0), 0.0)).expect("a joint");
            m.friction(&guide, Friction::slide(0.5, [0.2, 0.0], 1e-6)).expect("friction");
            // It jams where 2 μ off / L is above 1.
            let off = if name == "left" { 0.25 } else { 0.1 };
            let winch = drive_point_along(body, vec2(0.0, off), vec2(1.0, 0.0), Law::ramp(0.3));
            m.add(&format!("{name} winch"), winch).expect("a driver");
            m.load(&format!("{name} work"), Load::force(body, o, vec2(-9.0, 0.0))).expect("a load");
        }
        let system = m.build().expect("a system");
        let motion = system.run_both([0.0, 0.5]).expect("a motion");
        let Err(Error::Jammed(jammed)) = system.forces(&motion).map(drop) else {
            panic!("it moves")
        };
        assert_eq!((jammed.constraint.as_str(), jammed.t), ("left guide", 0.0));
        assert_eq!(jammed.drives, ["left winch"]);
        assert!((jammed.share - 0.8).abs() < 1e-9, "{}", jammed.share);
    }
}

/// Redundant drives elsewhere do not touch a bearing's force; a torque that two guides share is
/// refused.
#[test]
fn friction_needs_a_unique_force_at_its_own_joint_alone() {
    for scale in [1.0, 1e9, 1e-9] {
        let twins = |shared: bool| {
            let mut m = Mechanism::new("twins");
            let ground = SpatialBody::from(m.ground());
            let x = vec3(1.0, 0.0, 0.0);
            let at = vec3(0.1, 0.2, -0.3) * scale;
            let body = m.spatial("body", SpatialPose::at(at)).expect("a body");
            let same = EulerParameters::identity();
            m.add("rail", spatial::prismatic(body, ground, ZERO, at, x, same)).expect("a joint");
            m.friction("rail", Friction::slide(0.2, [0.4 * scale, 0.1 * scale], 1e-6 * scale))
                .expect("friction");
            let winch = || spatial::drive_slide(body, ground, ZERO, at, x, Law::ramp(scale));
            m.add("winch", winch()).expect("a driver");
            if shared {
                m.add("level", spatial::drive_turn(body, ground, x, x, Law::constant(0.0)))
                    .expect("a driver");
            } else {
                m.add("winch 2", winch()).expect("a driver");
            }
            m.load("weight", Load::force(body, ZERO, vec3(0.0, 0.0, -50.0 * scale)))
                .expect("a load");
            let system = m.build().expect("a system");
            let motion = system.run([0.0, 0.5]).expect("a motion");
            // The loss, and what both winches give together.
            let found = |forces: Forces<'_>| {
                let names = if shared { vec!["winch"] } else { vec!["winch", "winch 2"] };
                let winches = forces.sum(names).expect("known").on(body).expect("its body");
                let push = winches.component("F_x").expect("unique").values()[1];
                [forces.balance().friction.values()[1] / scale, push]
            };
            system.forces(&motion).map(found).map_err(|error| error.to_string())
        };
        let found = twins(false).unwrap_or_else(|error| panic!("{scale}: {error}"));
        let shares = found.map(|force| force / (10.0 * scale));
        assert!((shares[0] + 1.0).abs() + (shares[1] - 1.0).abs() < 1e-9, "{scale}: {shares:?}");
        let told = twins(true).expect_err("not unique");
        assert!(
            told.starts_with("`rail`: the force that causes its friction is not unique"),
            "{told}"
        );
    }
}
