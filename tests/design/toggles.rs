//! The time of a toggle by dimensions, and the four places at which there is no gradient: a change
//! of branch, a toggle, a jump, a kink.

use kin::prelude::*;
use kin::results::SingularPosition;
use kin::{Follow, SolverOptions};

use crate::engines::Engines;

/// A four-bar that its crank drives to where coupler and rocker are in line: θ = 0.4 + 0.7 t.
fn four_bar() -> System {
    four_bar_in(1.0, None)
}

/// The same in other units, and a feed of that speed beside it.
fn four_bar_in(unit: f64, feed: Option<f64>) -> System {
    let mut m = Mechanism::new("four-bar");
    let [a, b, c, d] = [("a", 0.3), ("b", 0.2), ("c", 0.25), ("d", 0.35)]
        .map(|(name, value)| m.dimension(name, value * unit).expect("a dimension"));
    let speed = m.dimension("speed", 0.7).expect("a dimension");
    let [crank, coupler, rocker] = [("crank", a), ("coupler", b), ("rocker", c)]
        .map(|(name, l)| m.link(name, l).expect("a link"));
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0))).expect("adds");
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).expect("adds");
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).expect("adds");
    m.add("C", revolute(rocker, Ground, rocker.start(), (d, 0.0))).expect("adds");
    m.add("motor", drive_angle(crank, Law::linear(0.4, speed))).expect("adds");
    m.prefer(rocker, 1.2);
    if let Some(feed) = feed {
        let x = m.length("x", 0.0).expect("a length");
        m.add("feed", drive(x, Law::ramp(feed * unit))).expect("adds");
    }
    m.build().expect("a four-bar")
}

/// The toggle at which a run ends.
fn toggle(system: &System) -> SingularPosition {
    let error = system.run_both(linspace(0.0, 4.0, 81)).expect_err("a toggle");
    let motion = error.motion().expect("a motion");
    motion.singular_positions().last().expect("a singular position").clone()
}

/// In line at cos θ = (a² + d² − (b + c)²)/(2 a d).
#[test]
fn the_time_of_a_toggle_is_that_of_its_closed_form() {
    let system = four_bar();
    let [a, b, c, d, w] = [0.3_f64, 0.2, 0.25, 0.35, 0.7];
    let found = toggle(&system);
    let x = (a * a + d * d - (b + c) * (b + c)) / (2.0 * a * d);
    let t = (x.acos() - 0.4) / w;
    assert!((found.t - t).abs() < 1e-10, "{} {t}", found.t);
    let by_x = -1.0 / (w * (1.0 - x * x).sqrt());
    let exact = [
        by_x * (1.0 / d - x / a),
        by_x * -(b + c) / (a * d),
        by_x * -(b + c) / (a * d),
        by_x * (1.0 / a - x / d),
        -t / w,
    ];
    let names = ["a", "b", "c", "d", "speed"];
    let by = system.toggle_by(&found, names).expect("derivatives");
    for ((by, exact), name) in by.iter().zip(exact).zip(names) {
        assert!((by - exact).abs() < 1e-9 * exact.abs(), "{name}: {by} {exact}");
    }
    // And where the toggle of another four-bar is.
    let h = 1e-5;
    let beside = |by: f64| {
        let mut other = four_bar();
        other.set("b", b + by).expect("sets");
        toggle(&other).t
    };
    assert!(((beside(h) - beside(-h)) / (2.0 * h) - by[1]).abs() < 1e-5 * by[1].abs());
}

/// The same in mm, km and beside what is driven far faster: a share decides whether a driver
/// pushes.
#[test]
fn the_time_of_a_toggle_has_derivatives_in_all_units_and_beside_fast_drivers() {
    let x = (0.3_f64 * 0.3 + 0.35 * 0.35 - 0.45 * 0.45) / (2.0 * 0.3 * 0.35);
    let w = 0.7;
    let by_b = 0.45 / (0.3 * 0.35 * w * (1.0 - x * x).sqrt());
    for unit in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        for feed in [None, Some(1e3), Some(-1e7)] {
            let system = four_bar_in(unit, feed);
            let found = toggle(&system);
            assert!((found.t - (x.acos() - 0.4) / w).abs() < 1e-10, "{unit} {feed:?}: {}", found.t);
            let by = system.toggle_by(&found, ["b", "speed"]).expect("derivatives");
            let exact = [by_b / unit, -found.t / w];
            for (by, exact) in by.iter().zip(exact) {
                assert!((by - exact).abs() < 1e-8 * exact.abs(), "{unit} {feed:?}: {by} {exact}");
            }
        }
    }
}

/// A change point has none in any units, called a toggle or not.
#[test]
fn the_time_of_a_change_point_has_no_derivatives_in_any_units() {
    for unit in [1e-6, 1.0, 1e6] {
        let system = parallelogram_in(unit);
        let motion = system.run_both(linspace(0.0, 4.0, 41)).expect("a motion");
        let mut change = motion.singular_positions().last().expect("a change point").clone();
        change.kind = kin::results::SingularKind::TurningPoint;
        let told = system.toggle_by(&change, ["P.u_i.x"]).expect_err("an error").to_string();
        assert!(told.contains("no driver moves the singular parts"), "{unit}: {told}");
    }
}

/// The errors of a derivative by a name, forward and backward, which are one.
fn said(system: &System, motion: &Motion, name: &str) -> String {
    let forward = system.sensitivities(motion, [name]).err().expect("an error").to_string();
    let what = system.coordinate_names()[0].clone();
    let backward =
        system.gradient(motion, [name], &what, |_| [1.0, 0.0, 0.0]).expect_err("an error");
    assert_eq!(forward, backward.to_string());
    forward
}

#[test]
fn there_is_no_gradient_at_a_toggle() {
    let system = four_bar();
    let error = system.run_both(linspace(0.0, 4.0, 81)).expect_err("a toggle");
    let told = said(&system, error.motion().expect("a motion"), "a");
    assert!(told.contains("`a`: the motion passes a singular position at t = 1.604"), "{told}");
    // Nor at the pose itself, which a run may begin at.
    let found = toggle(&system);
    let mut there = system.clone();
    there.set_initial(&found.q).expect("a pose");
    match there.run_both([found.t]) {
        Err(error) => assert!(error.to_string().contains("toggle or change point"), "{error}"),
        Ok(motion) => assert!(said(&there, &motion, "a").contains("singular")),
    }
}

/// A parallelogram whose cranks are in line at π: beyond it there are two branches.
fn parallelogram() -> System {
    parallelogram_in(1.0)
}

/// The same in other units.
fn parallelogram_in(unit: f64) -> System {
    let mut m = Mechanism::new("parallelogram");
    let a = m.link("a", unit).expect("a link");
    let b = m.link("b", unit).expect("a link");
    let coupler = m.link("coupler", 2.0 * unit).expect("a link");
    m.add("O", revolute(m.ground(), a, vec2(0.0, 0.0), a.start())).expect("adds");
    m.add("A", revolute(a, coupler, a.end(), coupler.start())).expect("adds");
    m.add("B", revolute(coupler, b, coupler.end(), b.end())).expect("adds");
    m.add("P", revolute(m.ground(), b, vec2(2.0 * unit, 0.0), b.start())).expect("adds");
    m.add("motor", drive_angle(a, Law::linear(1.0, 1.0))).expect("adds");
    m.build().expect("a parallelogram")
}

#[test]
fn there_is_no_gradient_through_a_change_of_branch() {
    let system = parallelogram();
    for follow in [Follow::Smooth, Follow::OtherBranchAt(vec![0])] {
        let options = SolverOptions::new().follow(follow);
        let motion = system.run_both_with(linspace(0.0, 4.0, 41), &options).expect("a motion");
        let told = said(&system, &motion, "P.u_i.x");
        assert!(
            told.contains("`P.u_i.x`: the motion passes a singular position at t = 2.14"),
            "{told}"
        );
        // Nor has the change point a time that would go on with the dimensions.
        let change = motion.singular_positions().last().expect("a change point");
        let told = system.toggle_by(change, ["P.u_i.x"]).expect_err("an error").to_string();
        assert!(
            told.contains("Kin cannot compute a derivative by `P.u_i.x`")
                && told.contains("a change point"),
            "{told}"
        );
        // Called a toggle it has none either: no driver pushes what is singular there.
        let mut called = change.clone();
        called.kind = kin::results::SingularKind::TurningPoint;
        let told = system.toggle_by(&called, ["P.u_i.x"]).expect_err("an error").to_string();
        assert!(told.contains("no driver moves the singular parts"), "{told}");
    }
}

/// θ of the follower is k times the whole turns of the body, or k |θ − 1|.      [rad]
#[constraint]
fn counted(body: Planar, other: Planar, k: f64) -> f64 {
    other.theta - k * body.theta.floor()
}

#[constraint]
fn bounced(body: Planar, other: Planar, k: f64) -> f64 {
    other.theta - k * (body.theta - 1.0).abs()
}

/// Two cranks of which one is driven, and the other coupled.
fn coupled(couple: impl FnOnce(&mut Mechanism, PlanarBody, PlanarBody)) -> System {
    let mut m = Mechanism::new("coupled");
    let crank = m.link("crank", 1.0).expect("a link");
    let other = m.link("other", 1.0).expect("a link");
    for (name, link) in [("O", crank), ("P", other)] {
        let ground = m.ground();
        m.add(name, revolute(ground, link, vec2(0.0, 0.0), link.start())).expect("adds");
    }
    m.add("motor", drive_angle(crank, Law::ramp(1.0))).expect("adds");
    couple(&mut m, crank.into(), other.into());
    m.build().expect("a system")
}

#[test]
fn there_is_no_gradient_at_a_jump() {
    let system = coupled(|m, crank, other| {
        m.add("jump", counted(crank, other, 2.0)).expect("adds");
    });
    // At the jump, alone or among other times, and beside it.
    let motion = system.run_both([1.0]).expect("a pose");
    let told = said(&system, &motion, "jump.k");
    assert!(
        told.contains("Kin cannot compute a derivative by `jump.k`: at t = 1 s `jump` jumps. Choose other times"),
        "{told}"
    );
    let motion = system.run_both([1.25, 1.5]).expect("a motion");
    let by = system.sensitivities(&motion, ["jump.k"]).expect("derivatives");
    let theta =
        system.coordinate_names().iter().position(|name| name == "other.theta").expect("theta");
    assert!((by.all()[0].q(0)[theta] - 1.0).abs() < 1e-14);
}

#[test]
fn there_is_no_gradient_at_a_kink() {
    let system = coupled(|m, crank, other| {
        m.add("kink", bounced(crank, other, 2.0)).expect("adds");
    });
    for times in [vec![1.0], vec![0.5, 1.0, 1.5], vec![1.0, 1.5], vec![0.5, 1.0]] {
        let motion = system.run_both(&times).expect("a motion");
        let told = said(&system, &motion, "kink.k");
        assert!(
            told.contains(
                "Kin cannot compute a derivative by `kink.k`: at t = 1 s there is a kink of `kink`"
            ),
            "{told}"
        );
    }
    let motion = system.run_both([0.5, 1.5]).expect("a motion");
    assert!(system.sensitivities(&motion, ["kink.k"]).is_ok());
}

#[test]
fn extremes_and_tolerances_are_refused_at_a_kink_too() {
    let mut m = Mechanism::new("bounce");
    let k = m.dimension("k", 2.0).expect("a dimension").tolerance(0.1);
    let crank = m.link("crank", 1.0).expect("a link");
    let other = m.link("other", 1.0).expect("a link");
    for (name, link) in [("O", crank), ("P", other)] {
        m.add(name, revolute(Ground, link, vec2(0.0, 0.0), link.start())).expect("adds");
    }
    m.add("motor", drive_angle(crank, Law::ramp(1.0))).expect("adds");
    m.add("kink", bounced(crank, other, k)).expect("adds");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.25, 0.75, 1.25, 1.75]).expect("a motion");
    let told = system.tolerance_of(&motion, other.theta(), 1.0).expect_err("a kink").to_string();
    assert!(told.contains("at t = 1 s there is a kink of `kink`"), "{told}");
    assert!(system.tolerance_of(&motion, other.theta(), 1.25).is_ok());
    let least = system.extremes(&motion, other.theta()).expect("extremes").min();
    if (least.t - 1.0).abs() < 1e-6 {
        let by = system.sensitivities(&motion, ["k"]).expect("derivatives");
        assert!(by.extreme(other.theta(), &least).is_err());
    }
}
