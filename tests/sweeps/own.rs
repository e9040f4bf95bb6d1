//! Sweeps over constraints of one's own, over spatial bodies, and over cases that fail.

use kin::extend::Lanes;
use kin::prelude::*;
use kin::{Error, SolverOptions, vec3};

use crate::engines::Engines;
use crate::{NAMES, case, far, four_bar, kinds_of_machine, links, numbers, times};

/// A pin in a parabolic slot.
#[constraint]
fn slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - k * s.x * s.x
}

#[test]
fn constraints_of_ones_own_go_over_lanes_without_asking() {
    let mut m = Mechanism::new("quick return");
    let disc = m.planar("disc", pose(0.0, 0.0, 0.0)).unwrap();
    let arm = m.link("arm", 0.12).unwrap();
    m.add("O", revolute(m.ground(), disc, vec2(0.0, 0.0), vec2(0.0, 0.0))).unwrap();
    m.add("C", revolute(m.ground(), arm, vec2(0.05, 0.0), arm.start())).unwrap();
    m.add("slot", slot(arm, disc, arm.end(), 4.0)).unwrap();
    m.add("motor", drive_angle(disc, Law::sine(0.3, 1.0, 0.2))).unwrap();
    m.prefer(arm, 0.0);
    let system = m.build().unwrap();
    let cases: Vec<[f64; 2]> =
        (0..13).map(|k| [3.0 + 0.2 * f64::from(k), 0.04 + 0.001 * f64::from(k)]).collect();
    let run = |lanes| {
        let sweep = system.sweep(["slot.k", "C.u_i.x"]).unwrap().lanes(lanes);
        sweep.run(&cases, linspace(0.0, 3.0, 201), |_, motion| motion.unwrap()).unwrap()
    };
    for (lanes, alone) in run(Lanes::Best).iter().zip(run(Lanes::Off)) {
        assert!(
            lanes.engine().compiled > 180 && alone.engine().compiled == 0,
            "{:?}",
            lanes.engine()
        );
        let lanes = numbers(lanes);
        let alone = numbers(&alone);
        assert!(far(&lanes, &alone) < 1e-10, "{:e}", far(&lanes, &alone));
    }
}

#[test]
fn spatial_bodies_go_over_lanes_too() {
    use kin::joints::drivers::spatial::{drive_orientation, drive_point, drive_turn};
    use kin::joints::spatial::revolute;
    let mut m = Mechanism::new("spatial arm");
    let arm = m.spatial("arm", SpatialPose::at(Vec3::zeros())).unwrap();
    let hand = m.spatial("hand", SpatialPose::at(vec3(1.5, 0.0, 0.0))).unwrap();
    let x = vec3(1.0, 0.0, 0.0);
    let z = Axis::along(vec3(0.0, 0.0, 1.0));
    m.add(
        "at",
        drive_point(
            arm,
            Vec3::zeros(),
            Law::sine(0.3, 1.0, 0.0),
            Law::ramp(0.1),
            Law::constant(0.0),
        ),
    )
    .unwrap();
    m.add(
        "turned",
        drive_orientation(arm, m.ground(), Law::ramp(0.4), Law::constant(0.1), Law::constant(0.0)),
    )
    .unwrap();
    m.add("wrist", revolute(arm, hand, x, -0.5 * x, z, z.h)).unwrap();
    m.add("motor", drive_turn(arm, hand, z, z, Law::sine(0.5, 2.0, 0.0))).unwrap();
    let system = m.build().unwrap();
    let times = linspace(0.0, 1.0, 21);
    let cases: Vec<[f64; 1]> = (0..20).map(|k| [0.5 + 0.05 * f64::from(k)]).collect();
    let run = |lanes| {
        let sweep = system.sweep(["wrist.u_i.x"]).unwrap().lanes(lanes);
        sweep.run(&cases, &times, |_, motion| numbers(&motion.unwrap()))
    };
    let alone = run(Lanes::Off).unwrap();
    let tried: Vec<_> =
        [2, 4, 8].into_iter().filter_map(|lanes| run(Lanes::Only(lanes)).ok()).collect();
    assert_eq!(tried.len(), kinds_of_machine());
    for (found, alone) in tried.iter().flat_map(|found| found.iter().zip(&alone)) {
        assert!(far(found, alone) < 1e-10);
    }
}

/// A failing case cost a hundred good ones, because what is wrong with it was looked for.
#[test]
fn a_failing_case_is_diagnosed_on_request_only() {
    let system = four_bar([1.0, 3.5, 3.0, 4.0]);
    // None of these closes.
    let cases: Vec<[f64; 8]> =
        (0..48).map(|k| case([1.0, 0.5 + 0.001 * f64::from(k), 0.5, 4.0])).collect();
    let swept = |lanes: Lanes, diagnose: bool, cases: &[[f64; 8]]| {
        let sweep = system.sweep(NAMES).unwrap().lanes(lanes).diagnose(diagnose);
        sweep
            .run(cases, times(), |_, motion| {
                motion.expect_err("does not close").diagnosis().is_some()
            })
            .unwrap()
    };
    for lanes in [Lanes::Off, Lanes::Best] {
        assert!(swept(lanes, false, &cases).iter().all(|diagnosed| !diagnosed));
    }
    assert!(swept(Lanes::Best, true, &cases[..1]).iter().all(|diagnosed| *diagnosed));
    // A run of one case alone says it, as ever.
    let mut m = Mechanism::new("too long");
    let x = m.length("x", 0.0).unwrap();
    m.add("reach", reach(x)).unwrap();
    assert!(m.build().unwrap().run_both([0.0]).err().unwrap().diagnosis().is_some());
}

/// x² + 1 = 0
#[constraint]
fn reach(x: Coord) -> f64 {
    x * x + 1.0
}

#[test]
fn a_failing_case_with_redundant_equations_is_diagnosed_on_request_only() {
    let mut m = Mechanism::new("twice");
    let x = m.length("x", 0.0).unwrap();
    let y = m.length("y", 0.0).unwrap();
    m.add("x", drive(x, Law::ramp(1.0))).unwrap();
    m.add("y", drive(y, Law::constant(0.0))).unwrap();
    m.add("y again", drive(y, Law::constant(0.0))).unwrap();
    let system = m.build().unwrap();
    for (asked, diagnosed) in [(false, false), (true, true)] {
        let sweep = system.sweep(["y again.law.c"]).unwrap().diagnose(asked);
        let swept = sweep.run(&[[0.0], [0.25]], [0.0, 1.0], |_, motion| {
            motion.map_err(|error| (error.diagnosis().is_some(), error.to_string()))
        });
        let [good, bad] = &swept.unwrap()[..] else { panic!("two cases") };
        assert!(good.is_ok());
        let (found, text) = bad.as_ref().err().unwrap();
        assert_eq!(*found, diagnosed, "{text}");
        assert!(text.contains("y"), "{text}");
    }
}

/// Each thread has one motion under way.
#[test]
fn memory_of_a_sweep_is_that_of_all_motions_under_way() {
    let system = four_bar([1.0, 3.5, 3.0, 4.0]);
    let cases: Vec<[f64; 8]> = links(64).into_iter().map(case).collect();
    let one = 61 * 8 * (3 + 3 * 9);
    let run = |lanes: Lanes, threads: usize, memory: usize| {
        let sweep = system
            .sweep(NAMES)
            .unwrap()
            .lanes(lanes)
            .threads(threads)
            .options(SolverOptions::new().memory(memory));
        sweep.run(&cases, times(), |_, motion| motion.is_ok())
    };
    assert!(run(Lanes::Off, 1, one).is_ok_and(|all| all.iter().all(|ok| *ok)));
    for refused in
        [run(Lanes::Off, 1, one - 1), run(Lanes::Off, 2, one), run(Lanes::Best, 2, 2 * one - 1)]
    {
        let error = refused.expect_err("too much");
        assert!(matches!(error, Error::NeedsMemory { times: 61, coordinates: 9, .. }), "{error}");
    }
    let text = run(Lanes::Off, 2, one).unwrap_err().to_string();
    assert!(
        text.contains(
            "2 simultaneous motions of 61 times of 9 coordinates need 29.3 kB, but `SolverOptions::memory` allows 14.6 kB"
        ),
        "{text}"
    );
}
