//! A coarse grid gives the motion of a fine one.

use kin::error::{FailureKind, RunFailure};
use kin::prelude::*;
use kin::{Follow, SolverOptions};

use crate::engines::Engines;
use crate::models::FourBar;

const CRANK_ROCKER: FourBar =
    FourBar { driven: 1.0, next: 3.5, last: 3.0, ground: 4.0, by_coupler: false };

/// Ten positions a turn, and five hundred, through three turns in both assemblies, either way
/// round.
#[test]
fn crank_rocker_in_steps_of_36_degrees() {
    for (side, sense) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let (system, _) = CRANK_ROCKER.system(Law::linear(0.1, sense * TAU), 0.1, side).unwrap();
        let coarse = system.run_both(linspace(0.0, 3.0, 31)).unwrap();
        let fine = system.run_both(linspace(0.0, 3.0, 1501)).unwrap();
        assert!(coarse.singular_positions().is_empty());
        for k in 0..31 {
            assert!(CRANK_ROCKER.error(coarse.q(k), side) < 1e-11, "{k}: {:?}", coarse.q(k));
            for (a, b) in [
                (coarse.q(k), fine.q(50 * k)),
                (coarse.qd(k), fine.qd(50 * k)),
                (coarse.qdd(k), fine.qdd(50 * k)),
            ] {
                let error = a
                    .iter()
                    .zip(b)
                    .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs() / (1.0 + b.abs())));
                assert!(error < 1e-9, "{side} {sense} {k}: {error:e}");
            }
        }
    }
}

/// Whole turns a step: the links come back to where they were, turned by as much as they have
/// turned.
#[test]
fn steps_of_whole_turns_are_followed_all_the_way() {
    let drag_link = FourBar { driven: 2.0, next: 2.2, last: 2.5, ground: 1.0, by_coupler: false };
    let (system, [_, next, last]) = drag_link.system(Law::ramp(TAU), 0.0, 1.0).unwrap();
    let motion = system.run_both([0.0, 1.0, 4.0]).unwrap();
    for body in [next, last] {
        let turns: Vec<f64> = motion
            .coordinate(body.theta())
            .unwrap()
            .value
            .values()
            .iter()
            .map(|theta| theta / TAU)
            .collect();
        assert!(
            (turns[1] - turns[0] - 1.0).abs() < 1e-12 && (turns[2] - turns[0] - 4.0).abs() < 1e-12,
            "{turns:?}"
        );
    }
}

/// Near its toggle a four-bar's assemblies are close to one another: clearances down to a millionth
/// of the links.
#[test]
fn assemblies_that_nearly_meet_are_told_apart() {
    for clearance in [1e-1, 1e-2, 1e-4, 1e-6] {
        // The driven link stretches the two others to all but their length.
        let bar = FourBar {
            driven: 1.0,
            next: 2.0,
            last: 2.0,
            ground: 3.0 - 4.0 * clearance,
            by_coupler: false,
        };
        assert!(bar.clearance() > 0.0);
        for (side, points) in [(1.0, 11), (-1.0, 11), (1.0, 8), (1.0, 361)] {
            let (system, _) = bar.system(Law::linear(0.2, TAU), 0.2, side).unwrap();
            let motion = system.run_both(linspace(0.0, 2.0, points)).unwrap();
            for k in 0..points {
                assert!(
                    bar.error(motion.q(k), side) < 1e-9,
                    "{clearance} {points} {k}: {:e}",
                    bar.error(motion.q(k), side)
                );
            }
        }
    }
}

/// A run without checks says nothing: on the same grid Newton's method ends in whatever assembly it
/// finds, as the README used to warn.
#[test]
fn checks_are_an_option() {
    let bar = FourBar { driven: 1.0, next: 2.0, last: 2.0, ground: 3.0 - 4e-6, by_coupler: false };
    let (system, _) = bar.system(Law::linear(0.2, TAU), 0.2, 1.0).unwrap();
    let motion = system
        .run_both_with(linspace(0.0, 2.0, 11), &SolverOptions::new().follow(Follow::Unchecked));
    let stays = motion.is_ok_and(|motion| (0..11).all(|k| bar.error(motion.q(k), 1.0) < 1e-9));
    assert!(!stays);
}
/// Cases of a sweep in SIMD lanes: each is on its branch, or ends at its toggle, as it is alone;
/// the ground's length differs from case to case.
#[test]
fn sweeps_in_lanes_stay_on_their_branches() {
    let grounds: Vec<f64> = (0..60).map(|k| 1.2 + 0.055 * f64::from(k)).collect();
    let bar = |ground| FourBar { driven: 1.0, next: 2.0, last: 2.3, ground, by_coupler: false };
    let start = 0.4;
    let (system, _) = bar(grounds[0]).system(Law::linear(start, TAU), start, 1.0).unwrap();
    let names: Vec<String> = std::iter::once("C.u_j.x".to_string())
        .chain(system.coordinate_names().iter().cloned())
        .collect();
    let cases: Vec<Vec<f64>> = grounds
        .iter()
        .map(|ground| {
            std::iter::once(*ground).chain(bar(*ground).pose(start, 1.0).unwrap()).collect()
        })
        .collect();
    for points in [21, 90] {
        let times = linspace(0.0, 2.0, points);
        let found = system
            .sweep(&names)
            .unwrap()
            .run(&cases, &times, |case, motion| (case, motion))
            .unwrap();
        let mut toggles = 0;
        for (case, result) in found {
            let bar = bar(grounds[case]);
            let end = bar.toggle(start, 1.0).map(|angle| (angle - start) / TAU);
            let motion = match (result.as_ref().map_err(kin::Error::failure), end) {
                (Ok(motion), None) => motion,
                (
                    Err(Some(RunFailure {
                        t,
                        kind: FailureKind::Toggle { .. },
                        motion: Some(motion),
                        ..
                    })),
                    Some(end),
                ) => {
                    assert!((t - end).abs() < 1e-10, "{case}: {t} {end}");
                    toggles += 1;
                    motion
                }
                (_, end) => panic!("{case}: toggle at {end:?}: {result:?}"),
            };
            assert!((0..motion.len()).all(|k| bar.error(motion.q(k), 1.0) < 1e-8), "{case}");
        }
        assert!(toggles > 5 && toggles < 55, "{toggles}");
    }
}
