//! Awkward positions: singular, out of reach, contradictory, not finite, far from the guess.

use std::f64::consts::TAU;

use super::models::*;
use super::*;
use crate::coordinates::Ground;
use crate::model::mechanism::{Mechanism, linspace};
use crate::numbers::algebra::Vec2;
use crate::outcome::error::{FailureKind, RunFailure};
use crate::solve::options::{Follow, SolverOptions};
use crate::system::System;

/// Two points at a fixed distance: |r_P − r_Q| − l = 0.   \[m\]
#[kin_macros::constraint]
fn rod(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, l: f64) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm() - l
}

/// Quad-bar with opposite links alike, flat at t = 0.
fn parallelogram(law: Law) -> System {
    let mut m = Mechanism::new("parallelogram");
    let ground = m.ground();
    let crank = m.link_between("crank", v(0.0, 0.0), v(1.0, 0.0)).unwrap();
    let coupler = m.link_between("coupler", v(1.0, 0.0), v(4.0, 0.0)).unwrap();
    let rocker = m.link_between("rocker", v(3.0, 0.0), v(4.0, 0.0)).unwrap();
    m.add("O", revolute(ground, crank, v(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(ground, rocker, v(3.0, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, law)).unwrap();
    m.build().unwrap()
}

#[test]
fn flat_parallelogram_is_singular_by_name() {
    let error = parallelogram(Law::ramp(1.0)).run([0.0, 0.1]).unwrap_err();
    let Some(FailureKind::SingularAt { n, rank, movable, .. }) = error.kind() else {
        panic!("{error}")
    };
    assert_eq!((error.failure().unwrap().t, *n, *rank), (0.0, 9, 8));
    assert_eq!(movable, &["coupler", "rocker"]);
    assert!(error.motion().is_none());
    assert!(
        error
            .to_string()
            .contains("`coupler` turns about (1.000, 0) m and `rocker` turns about (3.000, 0) m"),
        "{error}"
    );
}

#[test]
fn flat_parallelogram_ends_a_run_that_is_not_checked() {
    // Flat at t = 0, which the sweep reaches from above.
    let system = parallelogram(Law::linear(0.0, 1.0));
    let times = [0.3, 0.2, 0.1, 0.0];
    let error = system
        .solver()
        .options(SolverOptions::new().follow(Follow::Unchecked))
        .run(times)
        .unwrap_err();
    assert!(
        matches!(
            error.failure(),
            Some(RunFailure { t: 0.0, kind: FailureKind::SingularAt { .. }, .. })
        ),
        "{error}"
    );
    assert_eq!(error.motion().unwrap().times(), [0.3, 0.2, 0.1]);
    assert!(error.to_string().contains("`error.motion()`"), "{error}");
    let motion = system.run(times).unwrap();
    assert_eq!((motion.len(), motion.singular_positions().len()), (4, 1));
    assert!((motion.qd(3)[8] - 1.0).abs() < 1e-9, "{:?}", motion.qd(3));
}

#[test]
fn toggle_has_its_time() {
    // l2 = 1, l3 = 0.8: sin t = 0.8 is the end.
    let system = slider_crank([1.0, 0.8, 0.0], 1.0, [0.0, 1.8]);
    let end = 0.8_f64.asin();
    let error = system.run(linspace(0.0, 2.0, 21)).unwrap_err();
    let Some(RunFailure { t, kind: FailureKind::Toggle { asked, movable, .. }, .. }) =
        error.failure()
    else {
        panic!("{error}")
    };
    assert!((t - end).abs() < 1e-12 && (asked - 1.0).abs() < 1e-12, "{t} {end} {asked}");
    assert_eq!(movable, &["theta3", "x"]);
    assert_eq!(error.motion().unwrap().len(), 10);
    // Unchecked, the end is where no step succeeds any more.
    let error = system
        .solver()
        .options(SolverOptions::new().follow(Follow::Unchecked))
        .run(linspace(0.0, 2.0, 21))
        .unwrap_err();
    let Some(FailureKind::NoConvergence { constraint, row, last: Some(last), .. }) = error.kind()
    else {
        panic!("{error}")
    };
    assert_eq!((constraint.as_str(), row.as_str()), ("loop", "y"));
    assert!(*last <= end && *last > end - 1e-3, "{last} {end}");
}

#[test]
fn loop_that_cannot_close_is_no_convergence() {
    let error = slider_crank([1.0, 0.5, 2.0], 1.0, [0.0, 1.0]).run([0.0]).unwrap_err();
    assert!(
        matches!(error.kind(), Some(FailureKind::NoConvergence { constraint, last: None, .. }) if constraint == "loop"),
        "{error}"
    );
}

#[test]
fn prediction_carries_through_a_change_point_between_times() {
    // The times straddle the flat position; there the parallelogram could become an
    // antiparallelogram.
    let mut system = parallelogram(Law::linear(-0.105, 1.0));
    let (s, c) = (-0.105_f64).sin_cos();
    system
        .set_initial(&[0.5 * c, 0.5 * s, -0.105, 1.5 + c, s, 0.0, 3.0 + 0.5 * c, 0.5 * s, -0.105])
        .unwrap();
    let motion = system.run(linspace(0.0, 0.21, 22)).unwrap();
    for k in 0..22 {
        assert!(
            (motion.q(k)[8] - motion.q(k)[2]).abs() < 1e-10 && (motion.qd(k)[8] - 1.0).abs() < 1e-8,
            "{:?}",
            motion.q(k)
        );
    }
}

#[test]
fn motor_may_start_far_from_the_guess() {
    let system = four_bar(100.0).0;
    let motion = system.run(linspace(1000.0, 1001.0, 101)).unwrap();
    assert!((motion.q(0)[2] - 1000.0 * TAU).abs() < 1e-11);
    assert!(motion.q(0)[8] > 1.0 && motion.q(0)[8] < 2.5);
}

#[test]
fn contradiction_is_told_with_its_equations() {
    let mut m = Mechanism::new("contradiction");
    let a = m.link("a", 1.0).unwrap();
    let b = m.link("spare", 1.0).unwrap();
    m.add("O", revolute(Ground, a, v(0.0, 0.0), a.start())).unwrap();
    m.add("P", revolute(Ground, a, v(0.0, 0.0), a.end())).unwrap();
    m.add("motor", drive_angle(a, Law::ramp(1.0))).unwrap();
    m.add("other", drive_angle(b, Law::ramp(1.0))).unwrap();
    let error = m.build().unwrap().run([0.5]).unwrap_err();
    let Some(FailureKind::SingularAt { rank, movable, dependent, unmet: Some(unmet), .. }) =
        error.kind()
    else {
        panic!("{error}")
    };
    assert_eq!((*rank, movable.as_slice()), (4, ["spare".to_string()].as_slice()));
    assert!(dependent.iter().any(|name| name == unmet), "{error}");
}

#[test]
fn rod_of_length_zero_at_the_guess_is_no_obstacle() {
    // All poses zero: the distance of the two points has no derivative there.
    let mut m = Mechanism::new("rod");
    let crank = m.link("crank", 1.0).unwrap();
    let rocker = m.link("rocker", 3.0).unwrap();
    m.add("O", revolute(Ground, crank, v(0.0, 0.0), crank.start())).unwrap();
    m.add("C", revolute(Ground, rocker, v(4.0, 0.0), rocker.start())).unwrap();
    m.add("rod", rod(crank, rocker, v(0.0, 0.0), v(0.0, 0.0), 3.0)).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(1.0))).unwrap();
    let motion = m.build().unwrap().run(linspace(0.0, 6.0, 61)).unwrap();
    assert!(motion.residuals().iter().all(|r| *r < 1e-14));
}

#[test]
fn nothing_at_all_runs() {
    let motion = Mechanism::new("nothing").build().unwrap().run([0.0, 1.0]).unwrap();
    assert_eq!(
        (motion.len(), motion.q(0).len(), motion.headers()),
        (2, 0, vec!["t [s]".to_string()])
    );
}

#[test]
fn not_finite_names_the_constraint_and_keeps_the_motion() {
    let mut m = Mechanism::new("root");
    let x = m.length("x", 1.0).unwrap();
    m.add("slot", Root(x)).unwrap();
    let system = m.build().unwrap();
    let motion = system.run(linspace(0.0, 1.5, 16)).unwrap();
    assert!((motion.q(15)[0] - 6.25).abs() < 1e-13 && (motion.qdd(15)[0] - 2.0).abs() < 1e-12);

    let error = system.run(linspace(0.0, 3.0, 4)).unwrap_err();
    assert!(
        matches!(
            error.failure(),
            Some(RunFailure { t: 2.0, kind: FailureKind::NotFinite { quantity: "C_t", constraint, .. }, .. })
                if constraint == "slot"
        ),
        "{error}"
    );
    assert_eq!(error.motion().unwrap().len(), 2);

    let error = system.residual(&[-1.0], 0.0).unwrap_err();
    let told = "C of `slot` is not finite at t = 0 s: `x.sqrt()` is not a number (operand -1).\n  at x = -1.";
    assert!(
        matches!(error.kind(), Some(FailureKind::NotFinite { quantity: "C", .. }))
            && error.to_string().contains(told),
        "{error}"
    );
    let error = system.jacobian(&[0.0], 0.0).unwrap_err();
    assert!(matches!(error.kind(), Some(FailureKind::NotFinite { quantity: "C_q", .. })));
}

/// Where C_q is regular no rank is told that it has not, whatever has stopped Newton's method
/// there.
#[test]
fn a_regular_position_is_not_told_as_singular() {
    use crate::solve::newton::{Failure, Newton, Steps};
    let system = parallelogram(Law::linear(0.4, 1.0));
    let options = SolverOptions::default();
    let pose = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        [0.5 * cos, 0.5 * sin, angle, 1.5 + cos, sin, 0.0, 3.0 + 0.5 * cos, 0.5 * sin, angle]
    };
    let mut newton = Newton::new(&system, &options);
    newton.q.copy_from_slice(&pose(0.4));
    newton.solve(0.0, Steps::Damped).unwrap();
    let error = newton.error(Failure::Singular, 0.0, None);
    assert!(matches!(error.kind(), Some(FailureKind::NoConvergence { .. })), "{error}");
    // Nearly flat the rank is full, and is told as it is; nearer still it is not.
    let error = system.singular(0.0, &pose(1e-6), None);
    assert!(
        matches!(error.kind(), Some(FailureKind::SingularAt { rank: 9, pivot, .. }) if *pivot > 1e-7),
        "{error:?}"
    );
    assert!(error.to_string().contains("C_q (9 x 9) is singular within rounding error"), "{error}");
    let error = system.singular(0.0, &pose(1e-8), None);
    assert!(matches!(error.kind(), Some(FailureKind::SingularAt { rank: 8, .. })), "{error:?}");
}
