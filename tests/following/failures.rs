//! A step that failed leaves nothing behind, and runs come to an end. And runs that must come to an
//! end.

use kin::error::{FailureKind, RunFailure};
use kin::prelude::*;
use kin::{Follow, SolverOptions};

use crate::engines::Engines;

/// Two bodies in a chain about parallel axes, each with its motor: an iterate far off must not make
/// later matrices look singular.
#[test]
fn an_iterate_that_goes_astray_does_not_make_later_positions_look_singular() {
    let mut random = fastrand::Rng::with_seed(5);
    for number in 0..40 {
        let rates = if number == 0 {
            [15.0, 0.7]
        } else {
            [20.0 * random.f64() - 10.0, 20.0 * random.f64() - 10.0]
        };
        let mut m = Mechanism::new("chain");
        let zero = vec3(0.0, 0.0, 0.0);
        let end = vec3(1.0, 0.0, 0.0);
        let z = vec3(0.0, 0.0, 1.0);
        let a = m.spatial("a", SpatialPose::at(zero)).unwrap();
        let b = m.spatial("b", SpatialPose::at(end)).unwrap();
        m.add("O", spatial::revolute(a, Ground, zero, zero, z, z)).unwrap();
        m.add("A", spatial::revolute(b, a, zero, end, z, z)).unwrap();
        m.add("first", spatial::drive_turn(a, Ground, z, z, Law::ramp(rates[0]))).unwrap();
        m.add("second", spatial::drive_turn(b, a, z, z, Law::ramp(rates[1]))).unwrap();
        let system = m.build().unwrap();
        let coarse = system.run_both([0.0, 1.0]);
        let fine = system.run_both(linspace(0.0, 1.0, 101)).unwrap();
        let coarse = coarse.unwrap_or_else(|error| panic!("{rates:?}: {error}"));
        let off = coarse
            .q(1)
            .iter()
            .zip(fine.q(100))
            .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(off < 1e-9, "{rates:?}: {off:e}");
    }
}

/// x² = 1 − t has no solution beyond t = 1.
#[test]
fn halvings_without_end_come_to_one() {
    #[constraint]
    fn root(x: Coord, t: Time) -> f64 {
        x * x - (1.0 - t)
    }
    let mut m = Mechanism::new("root");
    let x = m.length("x", 1.0).unwrap();
    m.add("root", root(x)).unwrap();
    let system = m.build().unwrap();
    for halvings in [0, 12, 60, 200, u32::MAX] {
        for times in [vec![0.0, 2.0], vec![-1e9, 2.0], vec![0.0, 1.0, 1.0 + 1e-12]] {
            let options = SolverOptions::new().halvings(halvings).follow(Follow::Unchecked);
            let Err(error) = system.run_both_with(&times, &options) else {
                panic!("{halvings} {times:?}")
            };
            assert!(
                matches!(
                    error.kind(),
                    Some(FailureKind::NoConvergence { .. } | FailureKind::SingularAt { .. })
                ),
                "{error}"
            );
        }
    }
}

/// The last correction is within the tolerance, but may take x over a jump: then it is left out.
#[test]
fn a_last_correction_over_a_jump_is_not_taken() {
    #[constraint]
    fn floored(x: Coord, z: Coord) -> f64 {
        z - x.floor()
    }
    #[constraint(dual)]
    fn floored_by_dual(x: Coord, z: Coord) -> f64 {
        z - x.floor()
    }
    for dual in [false, true] {
        for guess in [1.0 - 1e-16, 1.0 - 1e-14, 1.0, 1.0 + 1e-15, 1.0 + 3e-14] {
            let mut m = Mechanism::new("steps");
            let x = m.length("x", guess).unwrap();
            let z = m.length("z", guess.floor()).unwrap();
            m.add("motor", drive(x, Law::constant(1.0))).unwrap();
            if dual {
                m.add("floor", floored_by_dual(x, z)).unwrap()
            } else {
                m.add("floor", floored(x, z)).unwrap()
            };
            let system = m.build().unwrap();
            for options in [SolverOptions::default(), SolverOptions::new().predict(false)] {
                let motion = system.run_both_with([0.0, 1.0], &options).unwrap();
                for k in 0..2 {
                    let q = motion.q(k);
                    assert_eq!(q[1], q[0].floor(), "{guess:e}: {q:?}");
                }
            }
        }
    }
}

/// A million swings in one step, or in few: the run ends before it has taken a minute, by counting
/// and not by the clock.
#[test]
fn a_run_that_needs_too_many_smaller_steps_says_so_soon() {
    #[constraint]
    fn wavy(x: Coord, z: Coord) -> f64 {
        z + 0.3 * (2.0 * z).sin() - x
    }
    let run = |far: f64, times: usize| {
        let mut m = Mechanism::new("wavy");
        let x = m.length("x", 0.0).unwrap();
        let z = m.length("z", 0.0).unwrap();
        m.add("x", drive(x, Law::ramp(far))).unwrap();
        m.add("z", wavy(x, z)).unwrap();
        m.build().unwrap().solver().run(linspace(0.0, 1.0, times))
    };
    for times in [2, 3] {
        let error = run(2e6, times).unwrap_err();
        let Some(RunFailure { t, kind: FailureKind::CannotFollow { reason }, .. }) =
            error.failure()
        else {
            panic!("{times}: {error}")
        };
        assert!(*t < 0.1 && reason.to_string().contains("Give closer times"), "{t} {reason}");
    }
    // A few thousand are no trouble.
    let motion = run(1e3, 2).unwrap();
    let off = motion.q(1)[1] + 0.3 * (2.0 * motion.q(1)[1]).sin() - 1e3;
    assert!(off.abs() < 1e-9, "{off:e}");
}
