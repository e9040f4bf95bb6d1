//! Singular positions: no step over one is proved.

use kin::error::FailureKind;
use kin::prelude::*;
use kin::results::UnprovedReason;
use kin::{Follow, SolverOptions};

use crate::engines::Engines;

use crate::models::{FourBar, slider_crank};

/// The steps that were not proved.
fn unproved(proof: &kin::results::Proof) -> Vec<usize> {
    proof.steps().iter().filter(|step| step.tube.is_err()).map(|step| step.step).collect()
}

/// The steps of a motion in which a time lies, at their ends too.
fn around(motion: &Motion, at: f64) -> Vec<usize> {
    let times = motion.times();
    (0..times.len() - 1).filter(|k| times[*k] <= at + 1e-12 && at <= times[k + 1] + 1e-12).collect()
}

/// A parallelogram through its flat positions, staying what it is or turning into the
/// antiparallelogram, with the flat position at a time of the grid or between two.
#[test]
fn change_points() {
    let bar = FourBar { driven: 1.0, next: 2.0, last: 1.0, ground: 2.0, by_coupler: false };
    let (system, _) = bar.system(Law::linear(1.0, TAU), 1.0, 1.0).unwrap();
    let flat = (PI - 1.0) / TAU;
    for (follow, grid) in [
        (Follow::Smooth, linspace(0.0, 0.6, 61)),
        (Follow::OtherBranchAt(vec![0]), linspace(0.0, 0.6, 61)),
        (Follow::Smooth, linspace(0.0, 2.0 * flat, 41)),
    ] {
        let motion = system.run_both_with(&grid, &SolverOptions::new().follow(follow)).unwrap();
        let proof = system.prove(&motion).unwrap();
        let expected = around(&motion, flat);
        let found = unproved(&proof);
        assert!(
            !expected.is_empty() && expected.iter().all(|step| found.contains(step)),
            "{expected:?} {found:?}"
        );
        assert!(found.len() <= expected.len() + 4, "{expected:?} {found:?}");
        let doubt = proof.first_unproved().unwrap().tube.as_ref().unwrap_err();
        assert!(
            (doubt.t - flat).abs() < 0.02
                && matches!(&doubt.reason, UnprovedReason::Singular { .. }),
            "{proof}"
        );
        println!("{proof}");
    }
}

/// The lecture's singular case: crank and rod of one length at 90°.
#[test]
fn slider_crank_with_equal_links() {
    let system = slider_crank(1.0, 1.0, Law::ramp(1.0), 0.0).unwrap();
    let motion = system.run_both(linspace(0.0, 3.0, 101)).unwrap();
    let found = unproved(&system.prove(&motion).unwrap());
    let expected = around(&motion, 0.5 * PI);
    assert!(
        expected.iter().all(|step| found.contains(step)) && found.len() < 8,
        "{expected:?} {found:?}"
    );
}

/// Up to a toggle everything is proved but the last steps; the toggle itself is not within a proved
/// step.
#[test]
fn up_to_a_toggle() {
    let bar = FourBar { driven: 2.0, next: 1.5, last: 2.2, ground: 3.5, by_coupler: false };
    let end = bar.toggle(0.5, 1.0).unwrap() - 0.5;
    let (system, _) = bar.system(Law::linear(0.5, 1.0), 0.5, 1.0).unwrap();
    let error = system.run_both(linspace(0.0, 1.1 * end, 111)).expect_err("a toggle");
    assert!(matches!(error.kind(), Some(FailureKind::Toggle { .. })), "{error}");
    let motion = error.into_motion().expect("the motion before");
    let proof = system.prove(&motion).unwrap();
    assert!(proof.proved() + 3 >= proof.steps().len() && proof.proved() > 95, "{proof}");
    // as far as the toggle, and no further
    let motion = system.run_both(linspace(0.0, end * (1.0 - 1e-13), 101));
    let Ok(motion) = motion else { return };
    assert!(unproved(&system.prove(&motion).unwrap()).contains(&99));
}

/// There and back through a toggle: a law that turns round just beyond it, and the motion on the
/// other side, which no mechanism makes.
#[test]
fn a_gap_without_positions_is_not_proved() {
    let bar = FourBar { driven: 2.0, next: 1.5, last: 2.2, ground: 3.5, by_coupler: false };
    let end = bar.toggle(0.5, 1.0).unwrap();
    // θ rises to 0.001 rad beyond the toggle at t = 1 and falls again
    let top = end + 1e-3;
    let law = Law::polynomial(&[0.5, 2.0 * (top - 0.5), 0.5 - top]);
    let (system, _) = bar.system(law, 0.5, 1.0).unwrap();
    let times = [0.0, 0.2, 0.4, 0.6, 0.8, 1.2, 1.4, 1.6, 1.8, 2.0];
    let careless = SolverOptions::new().follow(Follow::Unchecked);
    let motion = system.run_both_with(times, &careless).unwrap();
    let found = unproved(&system.prove(&motion).unwrap());
    assert_eq!(found, [4]);
}
