//! Positions by value: a follower moves along its branch, over any distance, and stops at toggles.

use kin::Error;
use kin::error::FailureKind;
use kin::prelude::*;
use kin::results::SingularKind;
use kin::solver::Follower;

use crate::models::FourBar;

/// A four-bar with links of random lengths that can be assembled at this angle of the driven one.
fn four_bar(random: &mut fastrand::Rng) -> (FourBar, f64, f64) {
    loop {
        let mut length = || 0.3 + 1.7 * random.f64();
        let [driven, next, last, ground] = [length(), length(), length(), length()];
        let bar = FourBar { driven, next, last, ground, by_coupler: random.bool() };
        let angle = TAU * random.f64() - PI;
        let side = if random.bool() { 1.0 } else { -1.0 };
        let clear = |angle: f64| bar.angles(angle, side).is_some();
        // Near a change point the other branch is near, and near a toggle the start is singular.
        if bar.clearance().abs() > 0.02 && [-0.05, 0.0, 0.05].iter().all(|d| clear(angle + d)) {
            return (bar, angle, side);
        }
    }
}

fn follower(bar: &FourBar, angle: f64, side: f64) -> Follower {
    let (system, _) = bar.system(Law::linear(angle, 1.0), angle, side).unwrap();
    let follower = system.follower(0.0).unwrap();
    assert!(bar.error(follower.here().q(), side) < 1e-9);
    follower
}

/// Moves of any size: each ends on its branch, or at the first toggle on the way, whose angle is
/// known in closed form. After a stop the follower goes back.
#[test]
fn random_moves_of_four_bars_stay_on_their_branch() {
    let cases: u64 = std::env::var("KIN_CAMPAIGN").map_or(60, |n| n.parse().unwrap());
    let mut stops = 0;
    for case in 0..cases {
        let mut random = fastrand::Rng::with_seed(case);
        let (bar, angle, side) = four_bar(&mut random);
        let mut follower = follower(&bar, angle, side);
        let mut from = angle;
        for _ in 0..8 {
            let size = 10_f64.powf(4.0 * random.f64() - 3.0);
            let to = from + if random.bool() { size } else { -size };
            let toggle = bar.toggle(from, (to - from).signum());
            let toggle = toggle.filter(|at| (at - from).abs() <= (to - from).abs());
            match (follower.to([("motor", to)]), toggle) {
                (Ok(here), None) => {
                    assert_eq!(here.drivers()[0].value, to);
                    let error = bar.error(here.q(), side);
                    assert!(error < 1e-8, "case {case}, {bar:?}: {from} → {to}: {error:e}");
                    from = to;
                }
                (Err(Error::CannotReach(stop)), Some(at)) => {
                    stops += 1;
                    assert_eq!(stop.singular, Some(SingularKind::TurningPoint));
                    let found = stop.reached[0].value;
                    let near = 1e-12 * (1.0 + at.abs());
                    assert!((found - at).abs() < near, "case {case}, {bar:?}: {found} {at}");
                    let back = follower.to([("motor", from)]).unwrap();
                    assert!(bar.error(back.q(), side) < 1e-9, "case {case}");
                }
                (found, toggle) => {
                    panic!("case {case}, {bar:?}: {from} → {to}: {found:?} {toggle:?}")
                }
            }
        }
    }
    assert!(stops > cases, "{stops} stops");
}

/// Out and back leads to the same position, and the way is that of a run.
#[test]
fn a_move_ends_where_a_run_along_its_path_ends() {
    for case in 0..20 {
        let mut random = fastrand::Rng::with_seed(1000 + case);
        let (bar, angle, side) = four_bar(&mut random);
        let mut follower = follower(&bar, angle, side);
        let start = follower.here().q().to_vec();
        let to = angle + 3.0 * random.f64();
        let (system, _) = bar.system(Law::linear(angle, 1.0), angle, side).unwrap();
        let run = system.run(linspace(0.0, to - angle, 501));
        let moved = follower.to([("motor", to)]).map(|here| here.q().to_vec());
        match (run, moved) {
            (Ok(motion), Ok(q)) => {
                let last = motion.q(500);
                assert!(last.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9), "case {case}");
                let back = follower.to([("motor", angle)]).unwrap();
                let same = back.q().iter().zip(&start).all(|(a, b)| (a - b).abs() < 1e-12);
                assert!(same, "case {case}: {:?} {start:?}", back.q());
            }
            (Err(Error::Run(failure)), Err(Error::CannotReach(stop)))
                if matches!(failure.kind, FailureKind::Toggle { .. }) =>
            {
                assert!((stop.reached[0].value - angle - failure.t).abs() < 1e-9);
            }
            (run, moved) => panic!("case {case}: {run:?} {moved:?}"),
        }
    }
}

/// A five-bar: two driven cranks and two links that meet at a pin.
fn five_bar(start: [f64; 2], side: f64) -> System {
    let mut m = Mechanism::new("five-bar");
    let a = m.link("left", 1.0).unwrap();
    let b = m.link("right", 1.0).unwrap();
    let c = m.link("left rod", 1.4).unwrap();
    let d = m.link("right rod", 1.3).unwrap();
    m.add("O", revolute(Ground, a, vec2(0.0, 0.0), a.start())).unwrap();
    m.add("Q", revolute(Ground, b, vec2(1.5, 0.0), b.start())).unwrap();
    m.add("A", revolute(a, c, a.end(), c.start())).unwrap();
    m.add("B", revolute(b, d, b.end(), d.start())).unwrap();
    m.add("P", revolute(c, d, c.end(), d.end())).unwrap();
    m.add("left motor", drive_angle(a, Law::constant(start[0]))).unwrap();
    m.add("right motor", drive_angle(b, Law::constant(start[1]))).unwrap();
    let [left, right] = rods(start, side).unwrap();
    let turned =
        [("left", start[0]), ("right", start[1]), ("left rod", left), ("right rod", right)];
    let mut system = m.build().unwrap();
    let names = system.coordinate_names().to_vec();
    let mut q = system.initial().to_vec();
    for (body, angle) in turned {
        q[names.iter().position(|name| *name == format!("{body}.theta")).unwrap()] = angle;
    }
    system.set_initial(&q).unwrap();
    system
}

/// The angles of the two rods where the cranks stand at these angles.
fn rods([left, right]: [f64; 2], side: f64) -> Option<[f64; 2]> {
    let a = vec2(left.cos(), left.sin());
    let b = vec2(1.5 + right.cos(), right.sin());
    let span = b - a;
    let length = span.norm();
    let cosine = (1.4 * 1.4 + length * length - 1.3 * 1.3) / (2.0 * 1.4 * length);
    (cosine.abs() <= 1.0).then(|| {
        let first = span.y.atan2(span.x) + side * cosine.acos();
        let p = a + 1.4 * vec2(first.cos(), first.sin()) - b;
        [first, p.y.atan2(p.x)]
    })
}

/// Two drivers move together on a straight line. The five-bar toggles where its rods are in line;
/// the place on the line follows by bisection of the closed form.
#[test]
fn two_drivers_move_on_a_straight_line() {
    let start = [2.0, 1.1];
    let mut stops = 0;
    for seed in 0..40 {
        let mut random = fastrand::Rng::with_seed(seed);
        let mut follower = five_bar(start, 1.0).follower(0.0).unwrap();
        assert_eq!(follower.drivers()[1].unit.as_deref(), Some("rad"));
        let to = start.map(|angle| angle + 6.0 * random.f64() - 3.0);
        let at = |share: f64| -> [f64; 2] {
            std::array::from_fn(|k| start[k] + share * (to[k] - start[k]))
        };
        let open = |share: f64| rods(at(share), 1.0).is_none();
        let first = (1..=20_000).map(|k| f64::from(k) / 20_000.0).find(|share| open(*share));
        let moved = follower.to([("left motor", to[0]), ("right motor", to[1])]);
        match (moved, first) {
            (Ok(here), None) => {
                let [left, right] = rods(to, 1.0).unwrap();
                for (name, angle) in [("left rod.theta", left), ("right rod.theta", right)] {
                    let off = here.coordinate(name).unwrap() - angle;
                    assert!((off - (off / TAU).round() * TAU).abs() < 1e-9, "{seed} {name} {off}");
                }
            }
            (Err(Error::CannotReach(stop)), Some(first)) => {
                stops += 1;
                let [mut closed, mut broken] = [first - 1.0 / 20_000.0, first];
                for _ in 0..60 {
                    let middle = 0.5 * (closed + broken);
                    if open(middle) { broken = middle } else { closed = middle }
                }
                let exact = at(closed);
                for (value, exact) in stop.reached.iter().zip(exact) {
                    assert!((value.value - exact).abs() < 1e-12, "{seed}: {stop} {exact}");
                }
                follower.to([("left motor", start[0]), ("right motor", start[1])]).unwrap();
            }
            (moved, first) => panic!("{seed}: {moved:?} {first:?}"),
        }
    }
    assert!((5..35).contains(&stops), "{stops}");
}

/// Wrong names, values that are not finite and names twice are errors by name, and the follower
/// stays where it is.
#[test]
fn mistakes_leave_the_follower_where_it_is() {
    let mut follower = five_bar([2.0, 1.1], 1.0).follower(0.0).unwrap();
    let before = follower.here().q().to_vec();
    let text = |found: kin::Result<kin::solver::Configuration<'_>>| found.unwrap_err().to_string();
    let unknown = text(follower.to([("left", 1.0)]));
    assert!(unknown.contains("`left motor`") && unknown.contains("`left`"), "{unknown}");
    let bad = text(follower.to([("left motor", f64::NAN)]));
    assert!(bad.contains("left motor") && bad.contains("NaN"), "{bad}");
    let twice = text(follower.to([("left motor", 1.0), ("left motor", 2.0)]));
    assert!(twice.contains("left motor"), "{twice}");
    assert_eq!(follower.here().q(), before);

    let mut m = Mechanism::new("at rest");
    let x = m.length("x", 0.0).unwrap();
    m.add("shaken", shaken(x)).unwrap();
    let none = m.build().unwrap().follower(0.0).unwrap_err().to_string();
    assert!(none.contains("\"at rest\" has no driver with a law of time"), "{none}");
}

/// A toggle names what is in line, in the values of the driver.
#[test]
fn a_stop_says_where_and_what_is_in_line() {
    let bar = FourBar { driven: 2.0, next: 1.5, last: 2.2, ground: 3.5, by_coupler: false };
    let mut follower = follower(&bar, 1.0, -1.0);
    let error = follower.to([("motor", 3.0)]).unwrap_err();
    let text = error.to_string();
    assert!(text.starts_with("the follower stops at `motor` = "), "{text}");
    assert!(text.contains(" rad on its way to `motor` = 3 rad."), "{text}");
    assert!(text.contains("`rocker`") && text.contains("`coupler`"), "{text}");
    let exact = bar.toggle(1.0, 1.0).unwrap();
    assert!((follower.drivers()[0].value - exact).abs() < 1e-12);
    let at_stop = error.motion().unwrap();
    assert_eq!(at_stop.q(0), follower.here().q());
    // Beyond the toggle there is nothing: the next move stops there again.
    assert!(follower.to([("motor", 3.1)]).is_err());
    assert!((follower.drivers()[0].value - exact).abs() < 1e-12);
    // The same values once more: the driver has a name in the error, if there is one.
    let there = follower.drivers()[0].value;
    if let Err(error) = follower.to([("motor", there)]) {
        assert!(error.to_string().contains("stops at `motor` = "), "{error}");
    }
    assert!((follower.drivers()[0].value - exact).abs() < 1e-12);
}

/// q̇ and q̈ for given rates of the driver are those of a run with the same rates.
#[test]
fn rates_follow_those_of_the_driver() {
    let bar = FourBar { driven: 1.0, next: 2.5, last: 2.0, ground: 2.2, by_coupler: false };
    let law = Law::polynomial(&[0.4, 0.7, -0.3]);
    let (system, _) = bar.system(law, 0.4, 1.0).unwrap();
    let motion = system.run([0.0, 0.5]).unwrap();
    let mut follower = system.follower(0.0).unwrap();
    let value = 0.4 + 0.7 * 0.5 - 0.3 * 0.25;
    follower.to([("motor", value)]).unwrap();
    let found = follower.rates([("motor", [0.7 - 0.3, -0.6])]).unwrap();
    for (found, exact) in
        [(&found.q, motion.q(1)), (&found.qd, motion.qd(1)), (&found.qdd, motion.qdd(1))]
    {
        assert!(found.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-10), "{found:?} {exact:?}");
    }
    // The rates do not move the follower.
    assert!(bar.error(follower.here().q(), 1.0) < 1e-10);
}

/// A slider that follows time outside of a law.
#[constraint]
fn shaken(x: Coord, t: Time) -> f64 {
    x - 0.2 * (3.0 * t).sin()
}

/// A law whose argument is not time alone.
#[constraint]
fn delayed(y: Coord, law: Law, t: Time) -> f64 {
    y - law.at(t - 0.5)
}

/// Time elsewhere in equations stands still, and the follower says where.
#[test]
fn time_outside_of_laws_stands_still() {
    let mut m = Mechanism::new("table");
    let x = m.length("x", 0.0).unwrap();
    let y = m.length("y", 0.0).unwrap();
    let z = m.length("z", 0.0).unwrap();
    m.add("shaken", shaken(x)).unwrap();
    m.add("delayed", delayed(y, Law::ramp(2.0))).unwrap();
    m.add("motor", drive(z, Law::ramp(1.0))).unwrap();
    let mut follower = m.build().unwrap().follower(0.25).unwrap();
    assert_eq!(follower.frozen(), ["shaken", "delayed"]);
    assert_eq!(follower.drivers().len(), 1);
    let here = follower.to([("motor", 4.0)]).unwrap();
    let exact = [0.2 * 0.75_f64.sin(), -0.5, 4.0];
    assert!(here.q().iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-12), "{:?}", here.q());
}

/// A parallelogram passes its change points smoothly, as a run does, over several turns at once.
#[test]
fn change_points_are_passed_as_by_a_run() {
    let bar = FourBar { driven: 1.0, next: 2.0, last: 1.0, ground: 2.0, by_coupler: false };
    let (system, _) = bar.system(Law::linear(0.6, 1.0), 0.6, 1.0).unwrap();
    let mut follower = system.follower(0.0).unwrap();
    let angle = 0.6 + 2.0 * TAU;
    let here = follower.to([("motor", angle)]).unwrap();
    let motion = system.run(linspace(0.0, 2.0 * TAU, 1001)).unwrap();
    assert!(here.q().iter().zip(motion.q(1000)).all(|(a, b)| (a - b).abs() < 1e-7));
}

/// Measures of joints by name, with their units.
#[test]
fn a_configuration_has_measures_by_name() {
    let bar = FourBar { driven: 1.0, next: 2.5, last: 2.0, ground: 2.2, by_coupler: false };
    let mut follower = follower(&bar, 0.4, 1.0);
    let here = follower.to([("motor", 1.4)]).unwrap();
    let all = here.measures().unwrap();
    let angle = all.iter().find(|one| one.name == "B.angle").unwrap();
    assert_eq!(
        (angle.unit.as_deref(), angle.value),
        (Some("rad"), here.measure("B.angle").unwrap())
    );
    let turn = here.coordinate("coupler.theta").unwrap() - here.coordinate("rocker.theta").unwrap();
    let off = (angle.value - turn + PI).rem_euclid(TAU) - PI;
    assert!(off.abs() < 1e-9, "{} {turn}", angle.value);
    assert!(here.measure("nothing").unwrap_err().to_string().contains("`nothing`"));
    assert_eq!(here.coordinate("nothing"), None);
}

/// A reach of a slider whose equation is not defined everywhere.
#[constraint]
fn root_of(x: Coord, y: Coord) -> f64 {
    y - (1.0 - x).sqrt()
}

/// Where an equation is not defined the follower stays where it was, and says why.
#[test]
fn a_move_beyond_an_equation_leaves_the_follower_where_it_was() {
    let mut m = Mechanism::new("root");
    let x = m.length("x", 0.0).unwrap();
    let y = m.length("y", 1.0).unwrap();
    m.add("root", root_of(x, y)).unwrap();
    m.add("motor", drive(x, Law::constant(0.0))).unwrap();
    let mut follower = m.build().unwrap().follower(0.0).unwrap();
    let error = follower.to([("motor", 3.0)]).unwrap_err();
    assert!(matches!(&error, Error::CannotReach(stop) if stop.singular.is_none()), "{error}");
    let text = error.to_string();
    assert!(
        text.starts_with("the follower stays at `motor` = 0 m") && !text.contains("t ="),
        "{text}"
    );
    assert_eq!(follower.drivers()[0].value, 0.0);
    assert!((follower.to([("motor", 0.75)]).unwrap().q()[1] - 0.5).abs() < 1e-12);
}

/// Redundant equations: three cranks on one rod.
#[test]
fn redundant_mechanisms_are_followed() {
    let mut m = Mechanism::new("three cranks");
    let rod = m.link("rod", 2.0).unwrap();
    let cranks = ["a", "b", "c"].map(|name| m.link(name, 1.0).unwrap());
    for (k, crank) in cranks.into_iter().enumerate() {
        let x = k as f64;
        m.add(&format!("O{k}"), revolute(Ground, crank, vec2(x, 0.0), crank.start())).unwrap();
        m.add(&format!("A{k}"), revolute(crank, rod, crank.end(), vec2(x - 1.0, 0.0))).unwrap();
    }
    m.add("motor", drive_angle(cranks[0], Law::constant(0.8))).unwrap();
    for crank in cranks {
        m.prefer(crank, 0.8);
    }
    let mut follower = m.build().unwrap().follower(0.0).unwrap();
    let here = follower.to([("motor", 2.0)]).unwrap();
    for name in ["a.theta", "b.theta", "c.theta"] {
        assert!((here.coordinate(name).unwrap() - 2.0).abs() < 1e-9, "{:?}", here.q());
    }
    let circuit = follower.circuit("motor", 100).unwrap_err().to_string();
    assert!(circuit.contains("redundant"), "{circuit}");
}

/// A mechanism in space: a revolute joint and a slider on its plate.
#[test]
fn spatial_mechanisms_are_followed() {
    let mut m = Mechanism::new("wrist");
    let plate = m.spatial("plate", SpatialPose::at(vec3(0.0, 0.0, 0.0))).unwrap();
    let zero = vec3(0.0, 0.0, 0.0);
    let z = vec3(0.0, 0.0, 1.0);
    m.add("hinge", spatial::revolute(plate, Ground, zero, zero, z, z)).unwrap();
    m.add("motor", spatial::drive_turn(plate, Ground, z, z, Law::constant(0.0))).unwrap();
    let mut follower = m.build().unwrap().follower(0.0).unwrap();
    let value = follower.to([("motor", 5.0)]).unwrap().measure("hinge.angle").unwrap();
    assert!(wrapped(value - 5.0).abs() < 1e-9, "{value}");
    let circuit = follower.circuit("motor", 60).unwrap();
    assert!(circuit.is_closed() && circuit.dead_centres().is_empty());
    assert!((circuit.inputs()[59] - circuit.inputs()[0]).abs() - TAU < 1e-7);
}

fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}
