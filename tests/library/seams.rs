//! Where parts of laws meet, and laws that repeat for longer than anybody can list.

use std::time::{Duration, Instant};

use kin::error::FailureKind;
use kin::law::Break;
use kin::prelude::*;

use crate::engines::Engines;

/// Far more than any of these takes, on a slow machine that does other things besides.
const LONGEST: Duration = Duration::from_secs(120);

fn orders(law: &Law, from: f64, to: f64) -> Vec<(f64, usize)> {
    law.breaks(from, to).iter().map(|b| (b.x, b.order)).collect()
}

/// A fast and small vibration has a large third derivative, beside which the jump of the value was
/// nothing.
#[test]
fn a_law_that_jumps_after_a_fast_vibration_is_refused() {
    for omega in [1.0, 100.0 * PI, 1e4 * PI, 1e7 * PI] {
        let vibration = || Law::sine(0.1, omega, 0.0);
        let jump = Law::sequence(0.0, [(10.0, vibration()), (10.0, Law::constant(0.9))]);
        assert!(
            jump.refusal().is_some_and(|said| said.contains("do not meet")),
            "{omega}: {:?}",
            jump.refusal()
        );
        let back = Law::sequence(0.0, [(10.0, Law::constant(0.9)), (10.0, vibration())]);
        assert!(back.refusal().is_some_and(|said| said.contains("do not meet")), "{omega}");
        let ramp = (vibration() + Law::ramp(1e-3)).periodic(10.0);
        assert!(ramp.refusal().is_some_and(|said| said.contains("does not repeat")), "{omega}");
        assert!(
            jump.shifted(3.0).refusal().is_some()
                && (jump.clone() + Law::ramp(1.0)).refusal().is_some()
        );
    }
    // Whole vibrations end where they began; their slope jumps, and that is a break.
    let stops =
        Law::sequence(0.0, [(10.0, Law::sine(0.1, 100.0 * PI, 0.0)), (10.0, Law::constant(0.0))]);
    assert_eq!((stops.refusal(), orders(&stops, -1.0, 30.0)), (None, vec![(0.0, 1), (10.0, 1)]));
}

/// The same of slopes: a jump of 1e-4 of it is a break, though the third derivative is a million
/// times as large.
#[test]
fn a_jump_of_slope_beside_a_fast_vibration_is_a_break() {
    let omega = 100.0 * PI;
    let slope = 10.0 * PI;
    let stops = |share: f64| {
        Law::sequence(
            0.0,
            [(10.0, Law::sine(0.1, omega, 0.0)), (1.0, Law::linear(0.0, slope * share))],
        )
    };
    assert_eq!(orders(&stops(1.0 + 1e-4), 5.0, 10.5), [(10.0, 1)]);
    assert_eq!(orders(&stops(1.0), 5.0, 10.5), [(10.0, 3)]);
    // A law that goes on as it was has no break, however fast it is.
    for turns in [1.0, 500.0, 1e6] {
        let sine = || Law::sine(0.1, TAU * turns, 0.0);
        let twice = Law::sequence(0.0, [(1.0, sine()), (1.0, sine())]);
        assert_eq!((twice.refusal(), orders(&twice, 0.5, 1.5)), (None, vec![]), "{turns}");
        assert_eq!(orders(&sine().periodic(1.0), -2.5, 2.5), [], "{turns}");
    }
}

#[test]
fn parts_meet_to_nine_digits_whatever_their_size() {
    for size in [1e-150, 1e-30, 1e-3, 1.0, 1e12, 1e150] {
        let parts = |apart: f64| {
            Law::sequence(
                0.0,
                [(1.0, Law::cycloidal(size, 1.0)), (1.0, Law::constant(size * (1.0 + apart)))],
            )
        };
        let turn = |apart: f64| (Law::constant(size) + Law::ramp(size * apart)).periodic(1.0);
        for apart in [1e-3, 1e-6, 1e-8, -1e-8] {
            assert!(
                parts(apart).refusal().is_some() && turn(apart).refusal().is_some(),
                "{apart} of {size} is a jump"
            );
        }
        for apart in [1e-11, -1e-14, 0.0] {
            assert_eq!(
                (parts(apart).refusal(), turn(apart).refusal()),
                (None, None),
                "{apart} of {size} is rounding"
            );
        }
    }
    // Parts that meet at zero, but for rounding.
    let there_and_back = Law::sequence(
        0.0,
        [(1.0, Law::cycloidal(0.1, 1.0)), (0.7, Law::constant(0.1) - Law::cycloidal(0.1, 0.7))],
    );
    assert_eq!(there_and_back.refusal(), None);
    assert!(
        there_and_back.breaks(-1.0, 3.0).iter().all(|b| b.order == 3),
        "{:?}",
        there_and_back.breaks(-1.0, 3.0)
    );
}

#[test]
fn a_law_that_repeats_but_for_a_drift_does_not_repeat() {
    let wave = Law::fourier(0.4, 1.0, &[(0.1, 0.2), (0.0, 0.0), (0.01, 0.0)]);
    let fast = Law::sine(0.1, 1000.0, 0.3);
    assert!(
        wave.is_periodic(TAU)
            && fast.is_periodic(TAU)
            && (wave.clone() + fast.clone()).is_periodic(TAU)
    );
    assert!(Law::constant(3.0).is_periodic(TAU) && !Law::ramp(1.0).is_periodic(TAU));
    for drift in [1e-3, 1e-6] {
        assert!(!(wave.clone() + Law::ramp(drift)).is_periodic(TAU), "{drift}");
        assert!(
            !(fast.clone() + Law::ramp(drift)).is_periodic(TAU),
            "{drift} beside a fast vibration"
        );
    }
    assert!(!Law::sine(1.0, 1.001, 0.0).is_periodic(TAU));
}

fn wave() -> Law {
    Law::spline(&[(0.0, 0.0), (1.0, 1.0), (1.5, 0.3), (2.0, 0.0)], Ends::Periodic)
}

/// Laws with more breaks than can be listed, each in its own way.
fn endless() -> Vec<(&'static str, Law)> {
    let rises = || {
        Law::sequence(
            0.0,
            [(1.0, Law::cycloidal(1.0, 1.0)), (1.0, Law::constant(1.0) - Law::cycloidal(1.0, 1.0))],
        )
    };
    vec![
        ("spline", wave()),
        ("periodic", rises().periodic(2.0)),
        ("sum", wave() + rises().periodic(2.0)),
        ("product", wave() * rises().periodic(2.0)),
        ("multiple", -1.0 * wave()),
        ("shifted", wave().shifted(0.25)),
        ("composed", wave().compose(&Law::linear(1.0, -3.0))),
        ("composed of both", wave().compose(&(2.0 * wave()))),
        ("sequence", Law::sequence(-5.0, [(2e13, wave())])),
        ("periodic of periodic", wave().periodic(4.0)),
    ]
}

#[test]
fn breaks_of_laws_that_repeat_are_listed_in_bounded_time_and_memory() {
    let begun = Instant::now();
    for (name, law) in endless() {
        for (from, to) in [
            (0.0, 1e8),
            (0.0, 1e12),
            (-1e300, 1e300),
            (f64::NEG_INFINITY, f64::INFINITY),
            (f64::NAN, 1.0),
            (0.0, f64::INFINITY),
        ] {
            let breaks = law.breaks(from, to);
            assert!(breaks.len() <= 10_000, "{name}: {}", breaks.len());
            assert!(
                breaks.windows(2).all(|pair| pair[0].x < pair[1].x),
                "{name} from {from} to {to}"
            );
        }
        assert!(law.breaks(0.0, 1e12).len() > 1000, "{name}");
        assert!(law.sharpest_break(0.0, 1e12).is_some_and(|found| found.order == 3), "{name}");
    }
    assert!(begun.elapsed() < LONGEST, "{:?}", begun.elapsed());
    // Near at hand all of them are there, also far from where the law begins.
    assert_eq!(wave().breaks(1e6, 1e6 + 4.0).len(), 7);
}

fn driven(law: Law, times: &[f64]) -> kin::Result<Motion> {
    let mut m = Mechanism::new("slide");
    let x = m.length("x", 0.0)?;
    m.add("motor", drive(x, law))?;
    m.build()?.run_both(times)
}

#[test]
fn a_run_over_a_billion_periods_ends() {
    let begun = Instant::now();
    for end in [1e8, 1e12, -1e12] {
        let motion = driven(wave(), &[0.0, end]).expect("runs");
        assert!(
            motion.len() == 2 && (9_990..=10_000).contains(&motion.breaks().len()),
            "{}",
            motion.breaks().len()
        );
    }
    let times: Vec<f64> = (0..200).map(|k| 1e6 * f64::from(k)).collect();
    assert_eq!(driven(wave(), &times).expect("runs").breaks().len(), 100_000);
    assert!(begun.elapsed() < LONGEST, "{:?}", begun.elapsed());
}

#[test]
fn a_corner_behind_more_breaks_than_are_listed_ends_the_run() {
    let corner = Law::sequence(0.0, [(1e9, Law::constant(0.0)), (1e9, Law::ramp(1e-9))]);
    for law in [wave() + corner.clone(), (wave() + corner.clone()).shifted(0.25)] {
        let error = driven(law.clone(), &[0.5, 1.5e9]).expect_err("a corner");
        assert!(
            matches!(error.kind(), Some(FailureKind::LawJumps { order: 1, at, .. }) if (at - 1e9).abs() < 1.0),
            "{error}"
        );
        assert!(matches!(law.sharpest_break(0.5, 1.5e9), Some(Break { order: 1, .. })));
    }
    let saw =
        Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]).periodic(2.0);
    let error = driven(saw, &[0.5, 1e10]).unwrap_err();
    assert!(matches!(error.kind(), Some(FailureKind::LawJumps { order: 1, at: 1.0, .. })));
}
