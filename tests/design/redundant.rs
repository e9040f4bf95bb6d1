//! Derivatives of redundant mechanisms: they exist where the parameter leaves the mechanism closed,
//! and are refused where it does not, at rest and in motion, whatever the sizes.

use kin::Mechanism;
use kin::design::Sampling;
use kin::prelude::*;

use crate::engines::Engines;

/// A bar on three rods of one length; `d` moves the second rod, `own` the third rod's length,
/// `lost` one end of it.
struct Rods {
    system: System,
    length: f64,
    /// The bar's place x and speed at t = 0.
    from: f64,
    speed: f64,
}

/// The mechanism with all lengths `scale` times as large; `places` are those of rods along the bar.
fn rods(scale: f64, places: [f64; 3], length: f64, (from, speed): (f64, f64)) -> Rods {
    let mut m = Mechanism::new("three equal rods");
    let length = scale * length;
    let from = scale * from;
    let speed = scale * speed;
    let y = (length * length - from * from).sqrt();
    let d = m.dimension("d", scale * places[1]).unwrap().tolerance(0.01 * scale);
    let lost = m.dimension("lost", scale * places[2]).unwrap();
    let own = m.dimension("own", length).unwrap();
    let all = m.dimension("all", 1.0).unwrap();
    let bar = m.planar("bar", pose(from, y, 0.0)).unwrap();
    let [a, c] = [scale * places[0], scale * places[2]];
    m.add("r1", distance(bar, Ground, (a, 0.0), (a, 0.0), all * length)).unwrap();
    m.add("r2", distance(bar, Ground, (d, 0.0), (d, 0.0), all * length)).unwrap();
    m.add("r3", distance(bar, Ground, (lost, 0.0), (c, 0.0), all * own)).unwrap();
    m.add("drive", drive(bar.x(), Law::linear(from, speed))).unwrap();
    Rods { system: m.build().unwrap(), length, from, speed }
}

fn refused(system: &System, motion: &Motion, name: &str) {
    let said = system.sensitivities(motion, [name]).err().expect("an error").to_string();
    let start = format!(
        "Kin cannot compute a derivative by `{name}`: the redundant mechanism closes at this value"
    );
    assert!(said.starts_with(&start), "{said}");
    let what = system.coordinate_names()[1].clone();
    let backward = system.gradient(motion, [name], &what, |_| [1.0; 3]).expect_err("an error");
    assert_eq!(said, backward.to_string());
}

#[test]
fn a_redundant_mechanism_in_motion_has_its_derivatives() {
    let Rods { system, .. } = rods(1.0, [0.0, 0.55, 0.2], 0.2, (0.12, 0.1));
    for times in [vec![0.0], vec![0.0, 0.1], linspace(0.0, 0.5, 80)] {
        let motion = system.run_both(&times).unwrap();
        let found = system.sensitivities(&motion, ["d"]).unwrap();
        for k in 0..motion.len() {
            let by = &found.all()[0];
            assert!([by.q(k), by.qd(k), by.qdd(k)].concat().iter().all(|x| x.abs() < 1e-13));
        }
        assert!(system.gradient(&motion, ["d"], "bar.R_y", |_| [1.0; 3]).unwrap()[0].abs() < 1e-10);
        ["own", "lost"].iter().for_each(|name| refused(&system, &motion, name));
    }
    let motion = system.run_both([0.0, 0.1]).unwrap();
    assert!(system.tolerance_of(&motion, "bar.R_y", 0.1).unwrap().worst_case() < 1e-14);
    let samples = Sampling { count: 20, ..Sampling::default() };
    assert_eq!(system.samples(&motion, "bar.R_y", 0.1, &samples).unwrap().missing(), 0);
}

#[test]
fn redundant_mechanisms_at_random_close_or_are_refused_whatever_their_size() {
    let mut random = fastrand::Rng::with_seed(11);
    for k in 0..60 {
        let scale = 10_f64.powi(3 * (k % 5) - 6);
        let mut number = |from: f64, to: f64| from + (to - from) * random.f64();
        let places = [number(-0.5, 0.0), number(0.2, 0.6), number(0.8, 1.5)];
        let length = number(0.3, 2.0);
        let from = number(-0.25, 0.2);
        let speed = if k % 7 == 0 { 0.0 } else { number(-0.06, 0.06) };
        let Rods { system, length, from, speed } = rods(scale, places, length, (from, speed));
        let motion = system.run(linspace(0.0, 0.7, 5)).unwrap();
        let by = system
            .sensitivities(&motion, ["d", "all"])
            .unwrap_or_else(|error| panic!("{k}: {error}"));
        for (i, t) in motion.times().iter().enumerate() {
            let still = by.all()[0].q(i).iter().chain(by.all()[0].qd(i)).chain(by.all()[0].qdd(i));
            assert!(
                still.fold(0.0_f64, |m, x| m.max(x.abs())) < 1e-12 * (1.0 + 1.0 / scale),
                "{k}"
            );
            // y = √(l² − x²), and l is `all` times the length.
            let x = from + speed * t;
            let l2 = length * length;
            let y = (l2 - x * x).sqrt();
            let exact = [l2 / y, l2 * x * speed / y.powi(3)];
            for (found, exact) in [by.all()[1].q(i)[1], by.all()[1].qd(i)[1]].into_iter().zip(exact)
            {
                assert!(
                    (found - exact).abs() < 1e-11 * scale * (1.0 + (exact / scale).abs()),
                    "{k}"
                );
            }
        }
        ["own", "lost"].iter().for_each(|name| refused(&system, &motion, name));
    }
}

/// A door on two hinges, one of which may move along their axis, and not across it.
#[test]
fn a_door_on_two_hinges() {
    for law in [Law::constant(0.3), Law::linear(0.3, 2.0), Law::sine(0.5, 1.0, 0.2)] {
        let mut m = Mechanism::new("door");
        let along = m.dimension("along", 1.3).unwrap();
        let across = m.dimension("across", 0.0).unwrap();
        let door = m.spatial("door", SpatialPose::at((0.0, 0.0, 0.0))).unwrap();
        let z = || Axis::along((0.0, 0.0, 1.0));
        m.add(
            "low",
            spatial::revolute(door, Ground, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), z(), (0.0, 0.0, 1.0)),
        )
        .unwrap();
        m.add(
            "high",
            spatial::revolute(
                door,
                Ground,
                (across, 0.0, along),
                (0.0, 0.0, along),
                z(),
                (0.0, 0.0, 1.0),
            ),
        )
        .unwrap();
        m.add("swing", spatial::drive_turn(door, Ground, z(), z(), law)).unwrap();
        let system = m.build().unwrap();
        for times in [linspace(0.0, 1.0, 4), linspace(0.0, 1.0, 60)] {
            let motion = system.run(times).unwrap();
            let by = system.sensitivities(&motion, ["along"]).unwrap();
            for k in 0..motion.len() {
                let all = [by.all()[0].q(k), by.all()[0].qd(k), by.all()[0].qdd(k)].concat();
                assert!(all.iter().all(|x| x.abs() < 1e-12), "{all:?}");
            }
            let said =
                system.sensitivities(&motion, ["across"]).err().expect("an error").to_string();
            assert!(said.contains("closes at this value only"), "{said}");
        }
    }
}
