//! Where pieces of laws meet, and where they do not; what is not seen is not known.

use kin_graph::Function2;

use crate::law::{Ends, Law};
use crate::numbers::enclosure::interval::{Interval, ONE};
use crate::numbers::enclosure::series::{ORDER, Series, Turns};

const FULL: usize = ORDER + 1;

/// How many coefficients of a law are known over an interval.
fn known(law: &Law, lo: f64, hi: f64) -> usize {
    law.over(&Series::variable(Interval::new(lo, hi), ONE, FULL)).expect("bounds").len()
}

/// Over a seam the first coefficient that differs may jump, those behind it mean nothing.
#[test]
fn kinks_keep_as_many_derivatives_as_agree() {
    let kink = Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]);
    assert_eq!(
        [known(&kink, 0.2, 0.8), known(&kink, 0.9, 1.1), known(&kink, 1.0, 1.0)],
        [FULL, 2, 2]
    );
    for (law, at, order) in [
        (Law::harmonic_rise(0.3, 2.0), 0.0, 2),
        (Law::cycloidal(0.3, 2.0), 2.0, 3),
        (Law::polynomial_4567(0.3, 2.0), 2.0, 4),
        (Law::modified_trapezoid(0.3, 2.0), 0.25, 3),
        (Law::trapezoidal(1.0, 0.5, 1.0), 0.5, 2),
        (Law::s_curve(1.0, 0.5, 1.0, 4.0), 0.25, 3),
        (Law::spline(&[(0.0, 0.0), (1.0, 0.5), (2.5, 0.1), (3.0, 0.4)], Ends::Natural), 1.0, 3),
        (
            Law::sequence(
                0.0,
                [
                    (2.0, Law::cycloidal(1.0, 2.0)),
                    (2.0, Law::constant(1.0) - Law::cycloidal(1.0, 2.0)),
                ],
            )
            .periodic(4.0),
            6.0,
            3,
        ),
    ] {
        assert_eq!(known(&law, at - 1e-3, at + 1e-3), order + 1, "{law:?} at {at}");
    }
}

#[test]
fn pieces_that_do_not_meet_have_no_value_there() {
    let meets = |gap: f64| {
        known(
            &Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::constant(1.0 + gap))]),
            0.9,
            1.1,
        ) > 0
    };
    assert_eq!(
        [0.0, 1e-16, 1e-10, -1e-10, 1e-5, 1e-3, 0.1].map(meets),
        [true, true, false, false, false, false, false]
    );
    let repeats = |gap: f64| known(&Law::linear(0.0, gap).periodic(1.0), 0.9, 1.1) > 0;
    assert_eq!([0.0, 1e-10, 1e-4, 1.0].map(repeats), [true, false, false, false]);
    // far from the first period as near it
    let far = Law::sine(0.1, 1.0, 0.2).periodic(std::f64::consts::TAU);
    assert!(known(&far, 6.28e5, 6.284e5) > 0 || known(&far, 6.283e5, 6.2832e5) > 0);
}

/// A seam counts where an interval but touches it; more pieces at once than are of use say nothing.
#[test]
fn seams_at_the_end_of_an_interval_count() {
    let kink = Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]);
    let seam = Interval::near(1.0, 1.0);
    assert_eq!([known(&kink, seam.hi(), 1.5), known(&kink, seam.hi().next_up(), 1.5)], [2, FULL]);
    assert_eq!([known(&kink, 0.5, seam.lo()), known(&kink, 0.5, seam.lo().next_down())], [2, FULL]);
    let saw = |k: u32| if k.is_multiple_of(2) { Law::ramp(1.0) } else { Law::linear(1.0, -1.0) };
    let law = Law::sequence(0.0, (0..200).map(|k| (1.0, saw(k))));
    assert_eq!(
        [
            known(&law, 0.5, 64.5),
            known(&law, 100.5, 164.5),
            known(&law, 0.5, 65.5),
            known(&law, 0.5, 150.0)
        ],
        [2, 2, 0, 0]
    );
}

/// At an argument that does not move a law has one value at a seam too, unless it jumps there.
#[test]
fn at_a_seam_alone() {
    let at = |law: Law| law.over(&Series::number(1.0)).unwrap();
    assert!(
        at(Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]))
            .is_constant()
    );
    assert_eq!(at(Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::constant(3.0))])).len(), 0);
}

/// All derivatives go on where the same function does; a flat jump is seen however small it is.
#[test]
fn seams_within_one_function() {
    let line = Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, 1.0))]);
    let flat =
        |gap: f64| Law::sequence(0.0, [(1.0, Law::constant(1.0)), (1.0, Law::constant(1.0 + gap))]);
    assert_eq!(
        [known(&line, 0.9, 1.1), known(&flat(0.0), 0.9, 1.1), known(&flat(1e-14), 0.9, 1.1)],
        [FULL, FULL, 0]
    );
    // The end of a fast one is known as well as its place is, on both sides of zero.
    let fast = Law::sine(1.0, 1e4, 0.0);
    let turn = std::f64::consts::TAU;
    for start in [0.0, -2.0 * turn] {
        let twice = Law::sequence(start, [(turn, fast.clone()), (turn, fast.clone())]);
        assert!(known(&twice, start + turn - 0.1, start + turn + 0.1) > 1, "{start}");
    }
    assert!(known(&fast.periodic(turn), 6.2, 6.3) > 1);
}

/// Periods are counted from the first; over many of them it has all values of one, over part of one
/// those of that part.
#[test]
fn laws_that_repeat_have_their_own_values() {
    let law = Law::sequence(
        0.0,
        [(2.0, Law::cycloidal(1.0, 2.0)), (2.0, Law::constant(1.0) - Law::cycloidal(1.0, 2.0))],
    )
    .periodic(4.0);
    // So far away that periods cannot be counted one by one.
    let far =
        law.over(&Series::variable(Interval::new(3e16, 3e16 + 32.0), ONE, FULL)).unwrap().values();
    assert!(far[0] <= 0.0 && far[1] >= 1.0);
    let spline = Law::spline(&[(0.3, 0.1), (1.0, 0.5), (1.7, 0.2), (2.3, 0.1)], Ends::Periodic);
    for (law, period) in [(law, 4.0), (spline, 2.0)] {
        for (lo, width) in [
            (0.4, 0.2),
            (1.4, 0.3),
            (-0.7, 0.1),
            (1e3 * period + 0.4, 0.2),
            (1e7 * period + 0.4, 0.2),
            (0.5, 1000.3),
        ] {
            let found = law
                .over(&Series::variable(Interval::new(lo, lo + width), ONE, FULL))
                .unwrap()
                .values();
            let all = (0..=1000).map(|k| law.jet(lo + width * f64::from(k) / 1000.0)[0]);
            let (least, most) =
                all.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), y| (lo.min(y), hi.max(y)));
            assert!(
                found[0] <= least + 1e-12 && most - 1e-12 <= found[1],
                "{law:?} at {lo}: {found:?} {least} {most}"
            );
            assert!(
                found[1] - found[0] < 4.0 * (most - least) + 1e-5,
                "{law:?} at {lo}: {found:?} {least} {most}"
            );
        }
    }
}

/// Where bounds are so wide that a jump could hide in them it is as if it were there.
#[test]
fn wide_bounds_hide_no_jump() {
    for omega in [1e9, 1e12, 1e15, 1e17] {
        let law =
            Law::sequence(0.0, [(1.0, Law::sine(1.0, omega, 0.0)), (1.0, Law::constant(0.3))]);
        assert_eq!(known(&law, 0.999_999_999, 1.000_000_001), 0, "{omega}");
    }
    // A small one too, whether its bounds are wide because of where the seam is or of what the law
    // is made of.
    let fast = Law::sequence(
        0.0,
        [(1.0, Law::sine(1.0, 1e12, 0.0)), (1.0, Law::constant(1e12_f64.sin() + 1e-5))],
    );
    assert_eq!(known(&fast, 0.999_999_999, 1.000_000_001), 0);
    for (length, slope) in [(1e-5, 1.0), (1e-3, 1e3)] {
        let piece = |phase: f64| Law::sine(1.0, slope, phase);
        let law = Law::sequence(0.0, [(length, piece(1e5)), (length, piece(1e5 + slope * length))]);
        assert_eq!(known(&law, 0.9 * length, 1.1 * length), 0, "{length}");
    }
}

/// An angle that may have passed its cut goes through a law that repeats after a turn, and through
/// no other.
#[test]
fn whole_turns_are_nothing_to_laws_that_repeat() {
    let y = Series::variable(Interval::new(-0.01, 0.01), ONE, FULL);
    let angle = y.call2(Function2::Atan2, Series::constant(-ONE));
    assert_eq!(angle.turns(), Turns::ONE);
    let turn = std::f64::consts::TAU;
    let known = |law: Law, angle: Series| law.over(&angle).is_some_and(|y| !y.is_open());
    for law in [
        Law::sine(1.0, 2.0, 0.3),
        Law::fourier(0.1, 1.0, &[(0.2, 0.1), (0.0, 0.3)]),
        Law::constant(3.0),
        Law::cycloidal(0.0, 1.0).periodic(turn),
        Law::sine(0.2, 1.0, 0.0).periodic(turn).shifted(1.0),
        Law::spline(&[(0.0, 0.1), (2.0, 0.3), (turn, 0.1)], Ends::Periodic),
        Law::sine(1.0, 1.0, 0.0) * Law::harmonic(0.2, 0.1) + 2.0 * Law::sine(1.0, 3.0, 0.0),
        Law::cycloidal(1.0, 1.0).compose(&Law::sine(1.0, 1.0, 0.0)),
        Law::sine(1.0, 1.0, 0.0).compose(&Law::linear(0.3, -2.0)),
        Law::sine(0.2, 3.0, 0.1).periodic(turn / 3.0),
    ] {
        assert!(known(law.clone(), angle) && known(law.clone(), angle.times(-3.0)), "{law:?}");
    }
    for law in [
        Law::ramp(1.0),
        Law::sine(1.0, 0.5, 0.0),
        Law::polynomial(&[0.0, 0.0, 1.0]),
        Law::cycloidal(1.0, 4.0),
        Law::sine(0.2, 0.5, 0.1).periodic(2.0 * turn),
        Law::sine(0.2, 1.0, 0.1).periodic(turn * (1.0 + 1e-14)),
        Law::spline(&[(0.0, 0.1), (2.0, 0.3), (6.0, 0.1)], Ends::Periodic),
        Law::spline(&[(0.0, 0.1), (2.0, 0.3), (6.0, 0.1)], Ends::Natural),
    ] {
        assert!(!known(law.clone(), angle), "{law:?}");
    }
    // after two turns it is the same
    assert!(
        known(Law::sine(1.0, 0.5, 0.0), angle.times(2.0))
            && known(Law::sine(0.2, 0.5, 0.1).periodic(2.0 * turn), angle.times(2.0))
    );
    // the line through an angle is an angle
    assert!(Law::ramp(2.0).over(&angle).is_some_and(|y| y.cos().len() > 1));
}

#[test]
fn the_cut_of_an_angle_that_is_touched_from_below() {
    // a zero y is on the axis, and what is below it is a turn away
    let (angle, across) = Interval::new(-0.1, 0.0).atan2(Interval::new(-2.0, -1.0));
    assert!(across && angle.contains(std::f64::consts::PI) && angle.contains(3.2));
    let (_, across) = Interval::new(-0.1, -1e-300).atan2(Interval::new(-2.0, -1.0));
    assert!(!across);
}
