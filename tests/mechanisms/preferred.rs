//! Which of several assemblies is meant: told by a coordinate, by the turn of a spatial body, by
//! the measure of a joint; each by closed form.

use kin::EulerParameters;
use kin::data::Registry;
use kin::prelude::*;

use crate::engines::Engines;

fn near(found: f64, exact: f64) {
    assert!((found - exact).abs() < 1e-9, "{found} instead of {exact}");
}

/// A rocker of length 1 on a hinge about z, and a rod from its end to a ball above the plane: where
/// the end is on two sides of the ball's shadow.
fn rocker(prefer: impl Fn(&mut Mechanism, SpatialBody)) -> Mechanism {
    let mut m = Mechanism::new("rocker and rod");
    let body = m.spatial("rocker", SpatialPose::at((0.0, 0.0, 0.0))).unwrap();
    m.add(
        "hinge",
        spatial::revolute(body, m.ground(), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), Vec3::z(), Vec3::z()),
    )
    .unwrap();
    m.add("rod", spatial::distance(body, m.ground(), (1.0, 0.0, 0.0), BALL, ROD)).unwrap();
    prefer(&mut m, body);
    m
}

const BALL: (f64, f64, f64) = (0.5, 0.9, 0.4);
const ROD: f64 = 1.1;

/// The two angles of the rocker: cos(φ − β) = (1 + |B|² − l²)/(2 b), b the ball's distance from the
/// hinge.
fn angles() -> [f64; 2] {
    let (x, y, z) = BALL;
    let b = x.hypot(y);
    let beta = y.atan2(x);
    let swing = ((1.0 + x * x + y * y + z * z - ROD * ROD) / (2.0 * b)).acos();
    [beta - swing, beta + swing]
}

fn angle(m: Mechanism) -> f64 {
    let system = m.build().unwrap();
    let motion = system.run_both([0.0]).unwrap();
    system.measure(&motion, "hinge.angle").unwrap().value.values()[0]
}

#[test]
fn a_spatial_body_is_preferred_by_its_turn() {
    for exact in angles() {
        for off in [0.0, 0.3, -0.3] {
            let p = EulerParameters::from_axis_angle(Vec3::z(), exact + off);
            let opposite = EulerParameters::new(-p.e0, -p.e1, -p.e2, -p.e3);
            near(angle(rocker(|m, body| m.prefer(body, p))), exact);
            near(angle(rocker(|m, body| m.prefer(body, opposite))), exact);
            near(
                angle(rocker(|m, body| m.prefer(body, SpatialPose::new((0.1, 0.0, 0.0), p)))),
                exact,
            );
        }
    }
}

#[test]
fn an_assembly_is_preferred_by_the_measure_of_a_joint() {
    for exact in angles() {
        near(angle(rocker(|m, _| m.prefer("hinge.angle", exact - 0.2))), exact);
        near(angle(rocker(|m, _| m.prefer("hinge.angle".to_string(), exact + 4.0 * TAU))), exact);
        // and what is written reads back
        let data = rocker(|m, _| m.prefer("hinge.angle", exact)).data().unwrap();
        near(angle(Mechanism::from_data(&data, &Registry::new()).unwrap()), exact);
        let system = rocker(|m, _| m.prefer("hinge.angle", exact)).build().unwrap();
        assert!(system.diagnose(0.0).unwrap().to_string().contains("rank 7"));
    }
}

/// Two slides that are so near to each other that a start near the one is near the other too.
#[test]
fn of_two_near_assemblies_the_nearer_is_taken() {
    let arm = 1.0_f64;
    let off = 0.999_f64;
    let half = (arm * arm - off * off).sqrt();
    for sign in [1.0, -1.0] {
        for guess in [3.0, -3.0] {
            let mut m = Mechanism::new("slider on an arm");
            let slider = m.planar("slider", pose(guess, 0.0, 0.0)).unwrap();
            m.add("guide", prismatic(slider, m.ground(), (0.0, 0.0), (0.0, 0.0), (0.0, 1.0), 0.0))
                .unwrap();
            m.add("arm", distance(slider, m.ground(), (0.0, 0.0), (2.0, off), arm)).unwrap();
            m.prefer("guide.slide", 2.0 + sign * half);
            let motion = m.build().unwrap().run_both([0.0]).unwrap();
            near(motion.q(0)[0], 2.0 + sign * half);
        }
    }
}

/// The elbow of a planar arm with equations to spare: by the angle of its pin, from either guess.
#[test]
fn redundant_mechanisms_are_assembled_by_a_measure_too() {
    for (elbow, guess) in [(1.0, 2.0), (1.0, -2.0), (-1.0, 2.0), (-1.0, -2.0)] {
        let mut m = Mechanism::new("arm");
        let upper = m.link("upper", 1.0).unwrap();
        let fore = m.link("fore", 1.0).unwrap();
        m.add("shoulder", revolute(upper, m.ground(), upper.start(), (0.0, 0.0))).unwrap();
        m.add("elbow", revolute(fore, upper, fore.start(), upper.end())).unwrap();
        m.add("hand", revolute(fore, m.ground(), fore.end(), (1.2, 0.0))).unwrap();
        m.add("again", distance(upper, m.ground(), upper.end(), (1.2, 0.0), 1.0)).unwrap();
        m.guess(upper.theta(), guess).unwrap();
        let bend = 2.0 * 0.6_f64.acos();
        m.prefer("elbow.angle", elbow * (bend + 0.4));
        let system = m.build().unwrap();
        let motion = system.run_both([0.0]).unwrap();
        let found = system.measure(&motion, "elbow.angle").unwrap().value.values()[0];
        near((found - elbow * bend).sin(), 0.0);
        near((found - elbow * bend).cos(), 1.0);
    }
}

#[test]
fn the_assembly_with_a_measure_nearest_a_value() {
    let system = rocker(|_, _| {}).build().unwrap();
    let body = system.run_both([0.0]).unwrap().spatial_named("rocker").unwrap();
    let ground = SpatialBody::from(Ground);
    for exact in angles() {
        let found = system.assembly_near(0.0, "hinge.angle", exact + 0.1).unwrap();
        let mut chosen = system.clone();
        chosen.set_initial(&found.q).unwrap();
        let motion = chosen.run_both([0.0]).unwrap();
        near(chosen.measure(&motion, "hinge.angle").unwrap().value.values()[0], exact);
        // the end of the rocker from a point of the ground, by a function of a motion
        let reach = ((exact.cos() - 2.0).powi(2) + exact.sin().powi(2)).sqrt();
        let by_distance = system
            .assembly_near(
                0.0,
                |m: &Motion| m.distance(body, (1.0, 0.0, 0.0), ground, (2.0, 0.0, 0.0)),
                reach,
            )
            .unwrap();
        assert_eq!(by_distance.label, found.label);
    }
    let unknown = system.assembly_near(0.0, "hinge.angel", 0.0).unwrap_err().to_string();
    assert!(unknown.contains("hinge.angle"), "{unknown}");
}

#[test]
fn a_preference_for_nothing_is_told() {
    let unknown = rocker(|m, _| m.prefer("hinge.angel", 1.0)).build().unwrap_err().to_string();
    assert!(unknown.contains("`hinge.angel`") && unknown.contains("hinge.angle"), "{unknown}");
    for m in [
        rocker(|m, _| m.prefer("hinge.angle", f64::NAN)),
        rocker(|m, body| m.prefer(body, EulerParameters::new(0.0, 0.0, 0.0, 0.0))),
    ] {
        assert!(m.build().is_err());
    }
    // a coordinate by its name is a coordinate
    let mut m = rocker(|_, _| {});
    let exact = angles()[1];
    m.prefer("rocker.e3", (0.5 * exact).sin());
    near(angle(m), exact);
}
