//! Efforts of drivers: their peaks, names and units, and those that redundant drives share.

use kin::extend::by_dual;
use kin::forces::Drive;
use kin::prelude::*;
use kin::{Error, Mechanism};

use crate::both::Engines;

const O: Vec2 = Vec2::new(0.0, 0.0);

/// A plate without weight, mass 2, that is moved by two laws and does not turn.
fn plate(x: Law, y: Law) -> Drive {
    let mut m = Mechanism::new("table");
    let plate = m.planar("plate", pose(0.0, 0.0, 0.0)).expect("a body");
    m.mass(plate, 2.0, O, 0.1).expect("a mass");
    m.add("hand", drive_point(plate, O, x, y)).expect("a driver");
    m.add("level", drive_angle(plate, Law::constant(0.0))).expect("a driver");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 0.25, 0.5, 0.75, 1.0]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    forces.drive("hand").expect("a driver")
}

/// The law whose acceleration is a + b t, so that its effort is 2 (a + b t).
fn accelerated(a: f64, b: f64) -> Law {
    Law::polynomial(&[0.0, 0.0, 0.5 * a, b / 6.0])
}

#[test]
fn a_peak_is_the_largest_magnitude_with_its_sign_and_its_first_time() {
    let none = || Law::constant(0.0);
    for (a, b, value, t) in [
        (1.0, 3.0, 8.0, 1.0),
        (5.0, -4.0, 10.0, 0.0),
        (1.0, -6.0, -10.0, 1.0),
        (-5.0, 6.0, -10.0, 0.0),
        (-1.0, -1.0, -4.0, 1.0),
        (-4.0, 1.0, -8.0, 0.0),
        // As large at both ends: the first one.
        (-4.0, 8.0, -8.0, 0.0),
        (4.0, -8.0, 8.0, 0.0),
        (2.0, 0.0, 4.0, 0.0),
    ] {
        let peak = plate(accelerated(a, b), none()).effort().peak();
        let found = (peak.value, peak.t, peak.unit.as_str());
        assert!(
            (peak.value - value).abs() < 1e-14 && peak.t == t && found.2 == "N",
            "{a} {b}: {found:?}"
        );
    }
    let peak = plate(accelerated(1.0, -6.0), none()).peak();
    assert_eq!(peak.to_string(), "-10 N at 1 s");
}

#[test]
fn the_peak_of_a_driver_is_that_of_its_largest_effort() {
    for (x, y, value, t) in [
        ([1.0, 3.0], [1.0, 1.0], 8.0, 1.0),
        ([1.0, 1.0], [1.0, 3.0], 8.0, 1.0),
        ([1.0, -6.0], [4.0, 0.0], -10.0, 1.0),
        ([4.0, 0.0], [1.0, -6.0], -10.0, 1.0),
        ([-5.0, 2.0], [-4.0, 0.0], -10.0, 0.0),
        ([-4.0, 0.0], [-5.0, 2.0], -10.0, 0.0),
        // As large: that of the first law.
        ([4.0, 0.0], [-4.0, 0.0], 8.0, 0.0),
        ([-4.0, 0.0], [4.0, 0.0], -8.0, 0.0),
    ] {
        let drive = plate(accelerated(x[0], x[1]), accelerated(y[0], y[1]));
        let peak = drive.peak();
        assert!((peak.value - value).abs() < 1e-14 && peak.t == t, "{x:?} {y:?}: {peak}");
        let named: Vec<(&str, &str)> =
            drive.efforts().iter().map(|one| (one.name(), one.unit())).collect();
        assert_eq!(named, [("hand.x", "N"), ("hand.y", "N")]);
    }
}

/// Two motors on one shaft and two jacks on one slide: neither has an effort, in whatever unit of
/// length.
#[test]
fn drives_that_share_their_load_have_no_effort() {
    for scale in [1.0, 1e9, 1e-9] {
        let mut m = Mechanism::new("twins");
        let ground = PlanarBody::from(m.ground());
        // An angle comes before all lengths.
        let dial = m.angle("dial", 0.0).expect("a coordinate");
        m.add("dial", drive(dial, Law::ramp(1.0))).expect("a driver");
        let slide = m.planar("slide", pose(0.0, 0.0, 0.0)).expect("a body");
        m.mass(slide, 2.0, O, 0.1 * scale * scale).expect("a mass");
        m.add("guide", prismatic(slide, ground, O, O, vec2(0.0, scale), 0.0)).expect("a joint");
        let law = || Law::ramp(scale);
        m.add("jack 1", drive(slide.x(), law())).expect("a driver");
        m.add("jack 2", drive_slide(slide, ground, O, O, vec2(1.0, 0.0), law())).expect("a driver");
        let shaft = m.planar("shaft", pose(3.0 * scale, 0.0, 0.0)).expect("a body");
        m.mass(shaft, 2.0, O, 0.1 * scale * scale).expect("a mass");
        m.add("bearing", revolute(shaft, ground, O, vec2(3.0 * scale, 0.0))).expect("a joint");
        m.add("motor 1", drive_angle(shaft, Law::ramp(1.0))).expect("a driver");
        m.add("motor 2", drive_relative_angle(shaft, ground, Law::ramp(1.0))).expect("a driver");
        let alone = m.planar("alone", pose(0.0, scale, 0.0)).expect("a body");
        m.mass(alone, 2.0, O, 0.1 * scale * scale).expect("a mass");
        m.add("hand", drive_point(alone, O, law(), Law::constant(scale))).expect("a driver");
        m.add("level", drive_angle(alone, Law::ramp(1.0))).expect("a driver");
        m.gravity(vec2(-scale, -9.81 * scale));
        let system = m.build().expect("a system");
        let motion = system.run_both([0.0, 0.5]).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        for (name, other) in [
            ("jack 1", "jack 2"),
            ("jack 2", "jack 1"),
            ("motor 1", "motor 2"),
            ("motor 2", "motor 1"),
        ] {
            match forces.drive(name) {
                Err(error @ Error::NotUnique(_)) => {
                    let told = error.to_string();
                    assert!(told.contains(&format!("`{name}`")) && told.contains(other), "{told}");
                    assert!(told.contains("its effort") && !told.contains("hand"), "{told}");
                    let others = if name.starts_with("jack") { "motor" } else { "jack" };
                    assert!(!told.contains(others), "{told}");
                }
                other => panic!("{scale}, {name}: {other:?}"),
            }
        }
        assert!(forces.drive("hand").is_ok() && forces.drive("level").is_ok(), "{scale}");
    }
}

/// A body that moves by time alone: x − 0.3 sin 2t = 0.      [m]
#[constraint]
fn swing(i: Planar, u: Vec2, t: Time) -> f64 {
    i.point(u).x - 0.3 * (2.0 * t).sin()
}

/// Rows that are c times those of a driver.      [m, rad]
#[constraint]
fn twice(i: Planar, u: Vec2, c: f64, along: Law, turn: Law, t: Time) -> (f64, f64) {
    (c * i.point(u).x - c * along.at(t), c * i.theta - c * turn.at(t))
}

/// A driver of two rows, each as it is.      [m, rad]
#[constraint]
fn plain(i: Planar, u: Vec2, along: Law, turn: Law, t: Time) -> (f64, f64) {
    (i.point(u).x - along.at(t), i.theta - turn.at(t))
}

/// One law and a line on which the point stays.      [m, m]
#[constraint]
fn along_line(i: Planar, u: Vec2, law: Law, t: Time) -> (f64, f64) {
    (i.point(u).x - law.at(t), i.point(u).y)
}

/// A reduction: c x − f = 0.      [m]
#[constraint]
fn ratio(i: Planar, c: f64, law: Law, t: Time) -> f64 {
    c * i.r.x - law.at(t)
}

/// A Scotch yoke: x − r sin f = 0.      [m]
#[constraint]
fn yoke(i: Planar, u: Vec2, law: Law, t: Time) -> f64 {
    i.point(u).x - law.at(t).sin()
}

/// A pair of gears: θ − 2 f = 0.      [rad]
#[constraint]
fn gears(i: Planar, law: Law, t: Time) -> f64 {
    i.theta - 2.0 * law.at(t)
}

/// A pulley: h · r − 2 f = 0.      [m]
#[constraint]
fn pulley(i: Planar, u: Vec2, h: Vec2, law: Law, t: Time) -> f64 {
    h.dot(i.point(u)) - 2.0 * law.at(t)
}

/// Efforts of a driver of a body of mass 2 that is pulled by 3 N along x and turned by 5 N m, as
/// their names, units and values at the first time; effort · ḟ of all laws must be the power.
fn efforts<C: Constraint + 'static>(
    laws: &[Law],
    make: impl FnOnce(PlanarBody) -> C,
    rest: impl FnOnce(&mut Mechanism, PlanarBody),
) -> Vec<(String, String, f64)> {
    let mut m = Mechanism::new("body");
    let body = m.planar("body", pose(0.0, 0.0, 0.0)).expect("a body");
    m.mass(body, 2.0, O, 0.1).expect("a mass");
    m.load("pull", kin::Load::force(body, O, vec2(3.0, 0.0)).and(kin::Load::torque(body, 5.0)))
        .expect("a load");
    m.add("driver", make(body)).expect("a driver");
    rest(&mut m, body);
    let system = m.build().expect("a system");
    let motion = system.run(linspace(0.0, 1.0, 5)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let drive = forces.drive("driver").expect("a driver");
    for (k, t) in motion.times().iter().enumerate().filter(|_| !laws.is_empty()) {
        let each = drive
            .efforts()
            .iter()
            .zip(laws)
            .map(|(effort, law)| effort.values()[k] * law.jet(*t)[1]);
        assert!((each.sum::<f64>() - drive.power().values()[k]).abs() < 1e-12, "{t}");
    }
    let told = |one: &kin::results::Series| {
        (one.name().to_string(), one.unit().to_string(), one.values()[0])
    };
    drive.efforts().iter().map(told).collect()
}

fn is(found: Vec<(String, String, f64)>, due: &[(&str, &str, f64)]) {
    let named: Vec<(&str, &str)> =
        found.iter().map(|one| (one.0.as_str(), one.1.as_str())).collect();
    assert_eq!(named, due.iter().map(|one| (one.0, one.1)).collect::<Vec<_>>());
    for (found, due) in found.iter().zip(due) {
        assert!((found.2 - due.2).abs() < 1e-12, "{found:?} {due:?}");
    }
}

fn held(m: &mut Mechanism, body: PlanarBody, which: &[&str]) {
    for name in which {
        let coordinate = match *name {
            "x" => body.x(),
            "y" => body.y(),
            _ => body.theta(),
        };
        m.add(name, drive(coordinate, Law::constant(0.0))).expect("a driver");
    }
}

#[test]
fn drivers_of_ones_own_have_an_effort_for_each_law() {
    let line = Law::linear(0.0, 0.5);
    let turn = Law::linear(0.0, -0.7);
    // No law at all: its row has the effort.
    let found = efforts(&[], |body| swing(body, O), |m, body| held(m, body, &["y", "theta"]));
    is(found, &[("driver", "N", -3.0)]);
    let laws = [line.clone(), turn.clone()];
    let both = [("N", -3.0), ("N m", -5.0)];
    let named = |names: [&'static str; 2]| [0, 1].map(|k| (names[k], both[k].0, both[k].1));
    for (c, names) in [(1.0, ["driver.1", "driver.2"]), (2.0, ["driver.along", "driver.turn"])] {
        let found = efforts(
            &laws,
            |body| twice(body, O, c, line.clone(), turn.clone()),
            |m, body| held(m, body, &["y"]),
        );
        is(found, &named(names));
    }
    let found = efforts(
        &laws,
        |body| plain(body, O, line.clone(), turn.clone()),
        |m, body| held(m, body, &["y"]),
    );
    is(found, &named(["driver.1", "driver.2"]));
    let dual = |body| by_dual(plain(body, O, line.clone(), turn.clone()));
    let found = efforts(&laws, dual, |m, body| held(m, body, &["y"]));
    is(found, &named(["driver.1", "driver.2"]));
    let one = [line.clone()];
    let found = efforts(
        &one,
        |body| along_line(body, O, line.clone()),
        |m, body| held(m, body, &["theta"]),
    );
    is(found, &[("driver", "N", -3.0)]);
    let rest = |m: &mut Mechanism, body| held(m, body, &["y", "theta"]);
    // x = sin f begins like x = f.
    is(efforts(&one, |body| yoke(body, O, line.clone()), rest), &[("driver", "N m", -3.0)]);
    let found =
        efforts(&one, |body| gears(body, line.clone()), |m, body| held(m, body, &["x", "y"]));
    is(found, &[("driver", "N m", -10.0)]);
    let found = efforts(&one, |body| pulley(body, O, vec2(1.0, 0.0), line.clone()), rest);
    is(found, &[("driver", "N", -6.0)]);
}

/// A factor of a row is a constant of the Jacobian: once it is set, forces follow it.
#[test]
fn efforts_follow_a_factor_that_is_set() {
    let mut m = Mechanism::new("body");
    let body = m.planar("body", pose(0.0, 0.0, 0.0)).expect("a body");
    m.load("pull", kin::Load::force(body, O, vec2(3.0, 0.0))).expect("a load");
    m.add("driver", ratio(body, 1.0, Law::ramp(1.0))).expect("a driver");
    held(&mut m, body, &["y", "theta"]);
    let mut system = m.build().expect("a system");
    for c in [1.0, 4.0, 0.5] {
        system.set("driver.c", c).expect("a parameter");
        let motion = system.run_both([0.0, 0.5]).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        let effort = forces.drive("driver").expect("a driver").effort().values()[1];
        assert!((effort + 3.0 / c).abs() < 1e-12, "{c}: {effort}");
    }
}

/// One law for both coordinates keeps the name of each.
#[test]
fn a_law_that_is_given_twice_has_two_names() {
    let law = Law::linear(0.2, 0.5);
    let place = |ground: Ground, body, x, y| moving_point(ground, body, x, y, O);
    let mut m = Mechanism::new("table");
    let body = m.planar("body", pose(0.2, 0.2, 0.0)).expect("a body");
    m.mass(body, 2.0, O, 0.1).expect("a mass");
    m.load("pull", kin::Load::force(body, O, vec2(3.0, 7.0))).expect("a load");
    let driver = place(m.ground(), body, law.clone(), law);
    m.add("tip", driver).expect("a driver");
    m.add("level", drive_angle(body, Law::constant(0.0))).expect("a driver");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 0.5]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let drive = forces.drive("tip").expect("a driver");
    let told: Vec<(&str, &str)> =
        drive.efforts().iter().map(|one| (one.name(), one.unit())).collect();
    assert_eq!(told, [("tip.x_i", "N"), ("tip.y_i", "N")]);
    assert!((drive.efforts()[0].values()[0] + 3.0).abs() < 1e-12);
    assert!((drive.efforts()[1].values()[0] + 7.0).abs() < 1e-12);
}

/// Half of a way between two points.
#[constraint]
fn half_way(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, x: Law, y: Law, t: Time) -> (f64, f64) {
    let way = i.point(u_i) - j.point(u_j);
    (way.x - 2.0 * x.at(t), way.y - 2.0 * y.at(t))
}

/// Half of a way between two points in space.
#[constraint]
fn half_way_in_space(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    x: Law,
    y: Law,
    z: Law,
    t: Time,
) -> Vec3 {
    let way = i.point(u_i) - j.point(u_j);
    Vec3::new(way.x - 2.0 * x.at(t), way.y - 2.0 * y.at(t), way.z - 2.0 * z.at(t))
}

/// Half of the difference of two coordinates.
#[constraint]
fn half_between(i: Coord, j: Coord, law: Law, t: Time) -> f64 {
    i - j - 2.0 * law.at(t)
}

/// Where the documentation of a driver says no unit, its coordinates do, those of the ground too.
#[test]
fn units_of_laws_follow_from_coordinates_of_the_ground() {
    let mut m = Mechanism::new("bodies");
    let ground = PlanarBody::from(m.ground());
    let law = || Law::ramp(0.3);
    let flat = m.planar("flat", pose(0.0, 0.0, 0.0)).expect("a body");
    m.add("flat", half_way(flat, ground, O, O, law(), law())).expect("a driver");
    m.add("turn", half_between(flat.theta(), ground.theta(), law())).expect("a driver");
    let line = m.planar("line", pose(0.0, 0.0, 0.0)).expect("a body");
    m.add("x", half_between(line.x(), ground.x(), law())).expect("a driver");
    m.add("y", half_between(line.y(), ground.y(), law())).expect("a driver");
    m.add("theta", drive(line.theta(), law())).expect("a driver");
    let zero = vec3(0.0, 0.0, 0.0);
    let space = SpatialBody::from(m.ground());
    let body = m.spatial("body", SpatialPose::at(zero)).expect("a body");
    let driver = half_way_in_space(body, space, zero, zero, law(), law(), law());
    m.add("space", driver).expect("a driver");
    let zero = || Law::constant(0.0);
    m.add("upright", spatial::drive_orientation(body, space, zero(), zero(), zero()))
        .expect("a driver");
    m.load("pull", kin::Load::force(flat, O, vec2(3.0, 7.0))).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 0.5]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let units = |name: &str| {
        let drive = forces.drive(name).expect("a driver");
        drive.efforts().iter().map(|one| one.unit().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(
        (units("flat"), units("space")),
        (vec!["N".to_string(); 2], vec!["N".to_string(); 3])
    );
    assert_eq!([units("x"), units("y"), units("turn")].concat(), ["N", "N", "N m"]);
}
