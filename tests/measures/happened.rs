//! Events on the way, extremes and crossings, and quantities that are asked by name.

use kin::SolverOptions;
use kin::prelude::*;
use kin::results::{Event, EventKind};

use crate::engines::Engines;

use crate::{FourBar, crank_rocker, near};

/// x = 0.3 sin t in a slot from 0.1 left of the origin to 0.2 right of it.
fn short_slot(scale: f64) -> Mechanism {
    let mut m = Mechanism::new("pin in a slot");
    let pin = m.planar("pin", pose(0.0, 0.0, 0.0)).unwrap();
    m.add(
        "slot",
        pin_in_slot(
            pin,
            m.ground(),
            vec2(0.0, 0.0),
            vec2(-0.1 * scale, 0.0),
            vec2(0.2 * scale, 0.0),
        ),
    )
    .unwrap();
    m.add("upright", drive_angle(pin, Law::constant(0.0))).unwrap();
    m.add("motor", drive(pin.x(), Law::sine(0.3 * scale, 1.0, 0.0))).unwrap();
    m
}

#[test]
fn a_run_tells_when_a_pin_passes_the_end_of_its_slot() {
    for (scale, steps) in [(1.0, 200), (1e3, 23), (1e-3, 9)] {
        let system = short_slot(scale).build().unwrap();
        let motion = system.run_both(linspace(0.0, TAU, steps)).unwrap();
        let upper = (2.0_f64 / 3.0).asin();
        let lower = (1.0_f64 / 3.0).asin();
        let exact = [upper, PI - upper, PI + lower, TAU - lower];
        let events: &[Event] = motion.events();
        assert_eq!(events.len(), 4, "{steps} times: {events:?}");
        for (event, exact) in events.iter().zip(exact) {
            near(event.t, exact, 1e-12);
            assert!(event.kind == EventKind::Limit && event.name == "slot.slide");
        }
        if scale == 1.0 {
            let texts: Vec<&str> = events.iter().map(|event| event.text.as_str()).collect();
            assert_eq!(texts[0], "`slot.slide` passes the upper limit, 0.3 m");
            assert_eq!(texts[1], "`slot.slide` returns from beyond the upper limit, 0.3 m");
            assert_eq!(texts[2], "`slot.slide` passes the lower limit, 0 m");
            let text = serde_json::to_string(&motion.data()).unwrap();
            assert_eq!(
                Motion::from_data(&serde_json::from_str(&text).unwrap()).unwrap().events(),
                events
            );
        }
        // backwards the same four, in the order of the run
        let back = system.run_both(linspace(TAU, 0.0, steps)).unwrap();
        let times: Vec<f64> = back.events().iter().map(|event| event.t).collect();
        times.iter().zip(exact.iter().rev()).for_each(|(found, exact)| near(*found, *exact, 1e-12));
        assert!(
            back.events()[0].text.contains("passes the lower limit")
                && back.events()[3].text.contains("returns")
        );
    }
}

#[test]
fn the_motion_before_a_toggle_has_its_events() {
    let mut m = Mechanism::new("two links on a slide");
    let ground = m.ground();
    let crank = m.link("crank", 1.0).unwrap();
    let rod = m.link("rod", 2.0).unwrap();
    let slider = m.planar("slider", pose(2.5, 0.0, 0.0)).unwrap();
    m.add("O", revolute(crank, ground, crank.start(), vec2(0.0, 0.0))).unwrap();
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).unwrap();
    m.add("B", revolute(rod, slider, rod.end(), vec2(0.0, 0.0))).unwrap();
    m.add("guide", prismatic(slider, ground, vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(0.0, 1.0), 0.0))
        .unwrap();
    m.add("motor", drive(slider.x(), Law::linear(2.5, 0.3))).unwrap();
    m.limit("guide.slide", 0.0, 2.8).unwrap();
    m.prefer(crank, 0.7);
    // the links are in line at x = 3, after the limit
    let error = m.build().unwrap().run_both(linspace(0.0, 3.0, 31)).unwrap_err();
    let [limit, toggle] = error.motion().unwrap().events() else {
        panic!("{:?}", error.motion().unwrap().events())
    };
    near(limit.t, 1.0, 1e-12);
    assert!(limit.kind == EventKind::Limit && toggle.kind == EventKind::TurningPoint);
    near(toggle.t, 0.5 / 0.3, 1e-9);
}

#[test]
fn limits_can_be_asked_for_by_name() {
    let mut m = short_slot(1.0);
    m.limit("slot.slide", f64::NEG_INFINITY, 0.25).unwrap();
    m.limit("pin.R_x", -0.35, 0.35).unwrap();
    let text = serde_json::to_string(&m.data().unwrap()).unwrap();
    let again =
        Mechanism::from_data(&serde_json::from_str(&text).unwrap(), &kin::data::Registry::new())
            .unwrap();
    for m in [m, again] {
        let motion = m.build().unwrap().run_both(linspace(0.0, TAU, 50)).unwrap();
        let times: Vec<f64> = motion.events().iter().map(|event| event.t).collect();
        assert_eq!(times.len(), 2);
        near(times[0], 0.5_f64.asin(), 1e-12);
    }
    // a run that begins outside says so
    let motion = short_slot(1.0).build().unwrap().run_both(linspace(1.0, 1.1, 3)).unwrap();
    assert_eq!(
        motion.events()[0].to_string(),
        "t = 1 s: `slot.slide` starts at 0.352441295 m, beyond the upper limit, 0.3 m"
    );
    let mut m = short_slot(1.0);
    let error = m.limit("slot.slide", 1.0, 0.0).unwrap_err().to_string();
    assert_eq!(
        error,
        "`slot.slide` (limit): the limits are 1 and 0. Give the lower limit first and the higher limit second"
    );
    m.limit("slot.turn", 0.0, 1.0).unwrap();
    let error = m.build().unwrap_err().to_string();
    assert_eq!(
        error,
        "`slot` (pin_in_slot): `slot.turn` does not exist. This joint has the measures `slot.slide` and `slot.angle`"
    );
}

#[test]
fn two_extremes_within_one_step_are_found() {
    let mut m = Mechanism::new("slider");
    let x = m.length("x", 0.0).unwrap();
    // x = t³ − 0.12 t: extremes at ± 0.2
    m.add("motor", drive(x, Law::polynomial(&[0.0, -0.12, 0.0, 1.0]))).unwrap();
    let system = m.build().unwrap();
    let motion = system.run_both([-1.0, -0.5, 0.5, 1.0]).unwrap();
    let found = system.extremes(&motion, x).unwrap();
    let [first, second] = found.all() else { panic!("{found:?}") };
    near(first.t, -0.2, 1e-13);
    near(second.t, 0.2, 1e-13);
    near(first.value, 0.016, 1e-15);
    assert!(first.is_max && !second.is_max && found.time_ratio().is_none());
    near(found.max().value, 0.88, 1e-15);
}

#[test]
fn a_rest_is_one_extreme() {
    let mut m = Mechanism::new("dwell");
    let x = m.length("x", 0.0).unwrap();
    let rise = Law::polynomial(&[0.0, 0.0, 0.0, 10.0, -15.0, 6.0]);
    let law = Law::sequence(
        0.0,
        [(1.0, rise.clone()), (1.0, Law::constant(1.0)), (1.0, Law::constant(1.0) - rise)],
    );
    m.add("motor", drive(x, law)).unwrap();
    let system = m.build().unwrap();
    let motion = system.run_both(linspace(0.05, 2.95, 59)).unwrap();
    let found = system.extremes(&motion, "x").unwrap();
    let [top] = found.all() else { panic!("{found:?}") };
    assert!(top.is_max && (top.t - 1.0).abs() < 0.051 && (top.value - 1.0).abs() < 1e-9, "{top:?}");
}

#[test]
fn one_pose_at_one_time() {
    let FourBar { system, crank, rocker, .. } = crank_rocker();
    let motion = system.run_both(linspace(0.0, 1.0, 21)).unwrap();
    let pose = system.at(&motion, 0.3217).unwrap();
    assert_eq!(pose.times(), [0.3217]);
    near(pose.coordinate(crank.theta()).unwrap().value.values()[0], 0.3217 * TAU, 1e-13);
    let alone = system.run_both([0.3217]).unwrap();
    near(
        pose.coordinate(rocker.theta()).unwrap().value.values()[0],
        alone.coordinate(rocker.theta()).unwrap().value.values()[0],
        1e-12,
    );
    near(
        pose.coordinate(rocker.theta()).unwrap().second_rate.values()[0],
        alone.coordinate(rocker.theta()).unwrap().second_rate.values()[0],
        1e-9,
    );
    let outside = system.at(&motion, 1.5).unwrap_err().to_string();
    assert_eq!(outside, "times: t = 1.5 s is outside of the motion, which goes from 0 s to 1 s");
    let other = short_slot(1.0).build().unwrap().run_both([0.0, 1.0]).unwrap();
    assert!(
        system
            .at(&other, 0.5)
            .unwrap_err()
            .to_string()
            .contains("the motion of \"pin in a slot\", which does not belong to \"four-bar\",")
    );
}

/// Pin in a bent slot, which tells where in it the pin is.      [m]
#[constraint]
#[measure(along = j.local(i.point(u_i)).x, "m", ends = (-reach, reach))]
#[measure(steepness = (2.0 * k * j.local(i.point(u_i)).x).atan(), "rad")]
fn bent_slot(i: Planar, j: Planar, u_i: Vec2, k: f64, reach: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - k * s.x * s.x
}

#[test]
fn a_joint_of_ones_own_has_measures_too() {
    let mut m = Mechanism::new("bead");
    let bead = m.planar("bead", pose(0.0, 0.0, 0.0)).unwrap();
    m.add("slot", bent_slot(bead, m.ground(), vec2(0.0, 0.0), 2.0, 0.15)).unwrap();
    m.add("upright", drive_angle(bead, Law::constant(0.0))).unwrap();
    m.add("motor", drive(bead.x(), Law::sine(0.3, 1.0, 0.0))).unwrap();
    let mut system = m.build().unwrap();
    let motion = system.run_both(linspace(0.0, 3.0, 31)).unwrap();
    let steep = system.measure(&motion, "slot.steepness").unwrap();
    for (k, t) in motion.times().iter().enumerate() {
        let x = 0.3 * t.sin();
        let v = 0.3 * t.cos();
        near(steep.value.values()[k], (4.0 * x).atan(), 1e-13);
        near(steep.rate.values()[k], 4.0 * v / (1.0 + 16.0 * x * x), 1e-12);
    }
    near(motion.events()[0].t, 0.5_f64.asin(), 1e-12);
    // the end is a parameter like any other
    system.set("slot.reach", 1.0).unwrap();
    assert!(system.run_both(linspace(0.0, 3.0, 31)).unwrap().events().is_empty());
}

#[test]
fn what_cannot_be_asked_is_told_by_name() {
    let FourBar { system, .. } = crank_rocker();
    let motion = system.run_both([0.0, 0.1]).unwrap();
    let said = |name: &str| system.measure(&motion, name).unwrap_err().to_string();
    assert_eq!(
        said("A.slide"),
        "`A` (revolute): `A.slide` does not exist. This joint has the measures `A.angle`"
    );
    assert_eq!(
        said("A"),
        "`A` (revolute): `A` does not exist. This joint has the measures `A.angle`"
    );
    assert_eq!(
        said("motor.angle"),
        "`motor` (drive_angle): `motor.angle` does not exist, because this joint has no measure. Use a point, an angle between bodies or a coordinate instead"
    );
    assert!(
        said("D.angle").starts_with(
            "there is no measure or coordinate `D.angle`. Use one of `O.angle`, `A.angle`, "
        ),
        "{}",
        said("D.angle")
    );
}

/// The distance of two points that move, planar and spatial, with three rates: against differences
/// and closed form; asked for its extremes.
#[test]
fn the_distance_of_two_points_is_a_measure() {
    let FourBar { system, crank, coupler, rocker, .. } = crank_rocker();
    let motion =
        system.run_both_with(linspace(0.0, 1.0, 1001), &SolverOptions::new().jerk(true)).unwrap();
    let p = vec2(0.3, 0.4);
    let q = (1.0, -0.7);
    let distance = motion.distance(coupler, p, rocker, q).unwrap();
    assert_eq!((distance.value.unit(), distance.third_rate.unit()), ("m", "m/s^3"));
    let r_p = motion.point(coupler, p).unwrap();
    let r_q = motion.point(rocker, q).unwrap();
    let orders = [&distance.value, &distance.rate, &distance.second_rate, &distance.third_rate]
        .map(Series::values);
    for k in 2..motion.len() - 2 {
        near(orders[0][k], (r_p.r()[k] - r_q.r()[k]).norm(), 1e-14);
        for order in 0..3 {
            let x = orders[order];
            let slope = (x[k - 2] - 8.0 * x[k - 1] + 8.0 * x[k + 1] - x[k + 2]) / (12.0 * 1e-3);
            near(orders[order + 1][k], slope, 1e-5);
        }
    }
    // Between the crank's pin and a point of the ground it is a circle's: extremes where the pin,
    // the axle and the point are in line.
    let point = (3.0, 4.0);
    let ground = PlanarBody::from(Ground);
    let found = system
        .extremes(&motion, |m: &Motion| m.distance(crank, crank.end(), ground, point))
        .unwrap();
    near(found.max().value, 6.0, 1e-12);
    near(found.min().value, 4.0, 1e-12);
    let met =
        motion.distance(crank, crank.end(), coupler, coupler.start()).unwrap_err().to_string();
    assert!(met.contains("distance of zero"), "{met}");
}

#[test]
fn a_name_may_be_a_string() {
    let FourBar { system, .. } = crank_rocker();
    let motion = system.run_both(linspace(0.0, 1.0, 11)).unwrap();
    let name = format!("{}.angle", "A");
    let by_text = system.measure(&motion, "A.angle").unwrap();
    assert_eq!(system.measure(&motion, &name).unwrap(), by_text);
    assert_eq!(
        system.extremes(&motion, &name).unwrap(),
        system.extremes(&motion, "A.angle").unwrap()
    );
    assert_eq!(system.measure(&motion, name).unwrap(), by_text);
}

/// A coordinate that follows a law.
fn followed(law: Law) -> (System, Coordinate) {
    let mut m = Mechanism::new("one");
    let x = m.length("x", law.at(0.0)).unwrap();
    m.add("motor", drive(x, law)).unwrap();
    (m.build().unwrap(), x)
}

/// Zeros that lie on times of the grid, with no sign to see between two of them.
#[test]
fn what_is_zero_at_a_time_of_the_grid_is_found_there_and_once() {
    let times = linspace(0.0, 4.0, 17);
    let crossed = |law: Law, value: f64| {
        let (system, x) = followed(law);
        let motion = system.run_both(&times).unwrap();
        let found = system.crossings(&motion, x, value).unwrap();
        found.into_iter().map(|crossing| (crossing.t, crossing.rises)).collect::<Vec<_>>()
    };
    // t − 2, 2 − t, and (t − 1)(t − 2)(t − 3), all exactly zero at times of the grid.
    assert_eq!(crossed(Law::linear(-2.0, 1.0), 0.0), [(2.0, true)]);
    assert_eq!(crossed(Law::linear(2.0, -1.0), 0.0), [(2.0, false)]);
    assert_eq!(
        crossed(Law::polynomial(&[-6.0, 11.0, -6.0, 1.0]), 0.0),
        [(1.0, true), (2.0, false), (3.0, true)]
    );
    // Zero but for rounding at the grid, and properly beside it: where it is, not where the grid
    // is.
    let beside = 1e-14;
    let found = crossed(Law::linear(-2.0 - beside, 1.0), 0.0);
    assert!(matches!(found[..], [(t, true)] if (t - 2.0 - beside).abs() < 4e-15), "{found:?}");
    // Touched at a time of the grid, and not crossed; at the first and at the last time nothing is
    // seen to be crossed.
    assert_eq!(crossed(Law::polynomial(&[4.0, -4.0, 1.0]), 0.0), []);
    assert_eq!(crossed(Law::linear(0.0, 1.0), 0.0), []);
    assert_eq!(crossed(Law::linear(-4.0, 1.0), 0.0), []);
    // A rest at zero on the way from below to above: the first time of it.
    let rest = |there: f64| {
        let up = |from: f64, by: f64| Law::constant(from) + Law::cycloidal(by, 1.0);
        Law::sequence(0.0, [(1.0, up(-1.0, 1.0)), (2.0, Law::constant(0.0)), (1.0, up(0.0, there))])
    };
    assert_eq!(crossed(rest(1.0), 0.0), [(1.0, true)]);
    assert_eq!(crossed(rest(-1.0), 0.0), []);
}
