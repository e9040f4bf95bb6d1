use super::*;
use crate::law::tests::{bounded, listed, near, own, shown};
use crate::numbers::random::Random;

/// \[s, v, a, j\] at x after pieces of (duration, acceleration that they begin with if it jumps,
/// jerk), each integrated from the one before.
fn integrated(pieces: &[(f64, Option<f64>, f64)], x: f64) -> [f64; 4] {
    let mut from = 0.0;
    let mut at = [0.0; 3];
    for (duration, jump, j) in pieces {
        let [s, v, a] = [at[0], at[1], jump.unwrap_or(at[2])];
        let t = (x - from).min(*duration);
        let there = [
            s + v * t + a * t * t / 2.0 + j * t * t * t / 6.0,
            v + a * t + j * t * t / 2.0,
            a + j * t,
        ];
        if x < from + duration {
            return [there[0], there[1], there[2], *j];
        }
        (from, at) = (from + duration, there);
    }
    [at[0], 0.0, 0.0, 0.0]
}

/// The law goes as its pieces are integrated, forwards and backwards; its breaks are where they
/// meet.
fn goes(law: fn(f64) -> Law, distance: f64, pieces: &[(f64, Option<f64>, f64)], order: usize) {
    let end: f64 = pieces.iter().map(|piece| piece.0).sum();
    for sign in [1.0, -1.0] {
        let law = law(sign * distance);
        assert_eq!((law.jet(-0.1), law.jet(-1e-9), law.refusal()), ([0.0; 4], [0.0; 4], None));
        for k in 0..240 {
            let x = end * f64::from(k) / 239.7 + 1e-4;
            let exact = integrated(pieces, x).map(|f| sign * f);
            law.jet(x).into_iter().zip(exact).for_each(|(found, exact)| near(found, exact, 1e-11));
            assert_eq!(law.fourth(x), 0.0);
        }
        assert_eq!(
            [1.0 + 1e-13, 2.0, 9.0].map(|k| law.jet(k * end)),
            [[sign * distance, 0.0, 0.0, 0.0]; 3]
        );
        let found = listed(&law, -1.0, 2.0 * end);
        assert_eq!((found.len(), found[0].0), (pieces.len() + 1, 0.0), "{found:?}");
        let mut at = 0.0;
        for ((x, found), duration) in
            found.iter().zip(pieces.iter().map(|piece| piece.0).chain([0.0]))
        {
            near(*x, at, 1e-13);
            assert_eq!((*found, listed(&law, *x, *x).len()), (order, 1));
            at += duration;
        }
        assert_eq!(
            (listed(&law, -2.0, -1.0), listed(&law, 1e-3 * end, 2e-3 * end), law.is_smooth()),
            (vec![], vec![], false)
        );
        bounded(
            &law,
            &[
                (-2.0, -1.0),
                (0.1 * end, 0.11 * end),
                (0.55 * end, 0.56 * end),
                (1.5 * end, 2.0 * end),
                (-0.1 * end, 1.1 * end),
            ],
            8.0,
        );
    }
}

#[test]
fn trapezoidal_velocity() {
    goes(
        |d| Law::trapezoidal(d, 1.0, 2.0),
        2.0,
        &[(0.5, Some(2.0), 0.0), (1.5, Some(0.0), 0.0), (0.5, Some(-2.0), 0.0)],
        2,
    );
    // too short for the full speed
    let half = 0.15_f64.sqrt();
    goes(
        |d| Law::trapezoidal(d, 1.0, 2.0),
        0.3,
        &[(half, Some(2.0), 0.0), (half, Some(-2.0), 0.0)],
        2,
    );
    goes(
        |d| Law::trapezoidal(d, 1.0, 2.0),
        0.5,
        &[(0.5, Some(2.0), 0.0), (0.5, Some(-2.0), 0.0)],
        2,
    );
}

#[test]
fn seven_pieces_of_jerk() {
    let three = |t_j: f64, flat: f64, j: f64| [(t_j, None, j), (flat, None, 0.0), (t_j, None, -j)];
    let all = |t_j: f64, flat: f64, cruise: f64, j: f64| {
        [&three(t_j, flat, j)[..], &[(cruise, None, 0.0)], &three(t_j, flat, -j)].concat()
    };
    goes(|d| Law::s_curve(d, 1.0, 2.0, 8.0), 2.0, &all(0.25, 0.25, 1.25, 8.0), 3);
    // the acceleration is not reached
    let t_j = 0.5_f64.sqrt();
    let short = [
        (t_j, None, 2.0),
        (t_j, None, -2.0),
        (5.0 - 2.0 * t_j, None, 0.0),
        (t_j, None, -2.0),
        (t_j, None, 2.0),
    ];
    goes(|d| Law::s_curve(d, 1.0, 4.0, 2.0), 5.0, &short, 3);
    // the speed is not reached
    let ramp = 0.0625 + (0.0625_f64 * 0.0625 + 0.8).sqrt();
    let flat = [
        (0.125, None, 8.0),
        (ramp - 0.25, None, 0.0),
        (0.25, None, -8.0),
        (ramp - 0.25, None, 0.0),
        (0.125, None, 8.0),
    ];
    goes(|d| Law::s_curve(d, 2.0, 1.0, 8.0), 0.8, &flat, 3);
    // neither of both
    let t_j = 0.003_125_f64.cbrt();
    goes(
        |d| Law::s_curve(d, 2.0, 2.0, 8.0),
        0.05,
        &[(t_j, None, 8.0), (2.0 * t_j, None, -8.0), (t_j, None, 8.0)],
        3,
    );
}

/// Whatever the numbers: within the limits, from rest to rest, no piece shorter than rounding, and
/// no quicker way where a limit is not met.
#[test]
fn limits_are_kept_and_reached() {
    let mut random = Random::new(5);
    let mut size = || 10_f64.powf(2.0 * random.number());
    for _ in 0..400 {
        let d = size();
        let v = size();
        let a = size();
        let j = size();
        for (law, jerk) in
            [(Law::trapezoidal(d, v, a), f64::INFINITY), (Law::s_curve(d, v, a, j), j)]
        {
            let breaks = listed(&law, -1.0, 1e9);
            let end = breaks[breaks.len() - 1].0;
            assert!(
                breaks.windows(2).all(|pair| pair[1].0 - pair[0].0 > 1e-9 * end),
                "{law:?} {breaks:?}"
            );
            let mut most = [0.0_f64; 4];
            for x in (0..2000)
                .map(|k| (f64::from(k) + 0.5) / 2000.0 * end)
                .chain(breaks.windows(2).map(|pair| 0.5 * (pair[0].0 + pair[1].0)))
            {
                law.jet(x)
                    .into_iter()
                    .zip(&mut most)
                    .for_each(|(f, most)| *most = most.max(f.abs()));
            }
            assert!(
                most[1] <= v * (1.0 + 1e-9)
                    && most[2] <= a * (1.0 + 1e-9)
                    && most[3] <= jerk * (1.0 + 1e-9)
                    && most[0] <= d * (1.0 + 1e-9),
                "{law:?} {most:?}"
            );
            near(law.at(end * (1.0 - 1e-12)) / d, 1.0, 1e-8);
            // The speed is constant for a while, or not reached; the same of the acceleration.
            assert!(
                most[1] >= 0.99 * v || jerk.is_infinite() && breaks.len() == 3 || breaks.len() <= 6,
                "{law:?} {most:?}"
            );
            assert!(
                most[2] >= 0.99 * a || breaks.len() == 4 || breaks.len() == 6,
                "{law:?} {most:?} {breaks:?}"
            );
        }
    }
}

#[test]
fn moves_of_no_length_and_limits_that_make_no_sense() {
    for law in [Law::trapezoidal(0.0, 1.0, 2.0), Law::s_curve(0.0, 1.0, 2.0, 3.0)] {
        assert_eq!(
            (law.jet(-1.0), law.jet(0.0), law.jet(1.0), listed(&law, -1.0, 1.0), law.refusal()),
            ([0.0; 4], [0.0; 4], [0.0; 4], vec![], None)
        );
    }
    let said = |law: Law| law.refusal().unwrap_or_default();
    let words = |kind: &str| {
        format!(
            "{kind}: speed, acceleration and jerk must be above zero; give the sign of the motion to the distance"
        )
    };
    for wrong in [0.0, -1.0] {
        assert_eq!(
            [Law::trapezoidal(1.0, wrong, 1.0), Law::trapezoidal(1.0, 1.0, wrong)].map(said),
            [words("trapezoidal"), words("trapezoidal")]
        );
        let laws = [
            Law::s_curve(1.0, wrong, 1.0, 1.0),
            Law::s_curve(1.0, 1.0, wrong, 1.0),
            Law::s_curve(1.0, 1.0, 1.0, wrong),
        ];
        assert_eq!(laws.map(said), [words("s_curve"), words("s_curve"), words("s_curve")]);
    }
    assert_eq!(
        said(Law::s_curve(1.0, 1.0, 1.0, f64::INFINITY)),
        "jerk is inf. Give a finite number"
    );
    // A law that is refused has no pieces, and is the distance from 0 on.
    for law in [
        Law::s_curve(1.0, 1.0, f64::NAN, 1.0),
        Law::s_curve(1.0, 1.0, 1.0, f64::INFINITY),
        Law::trapezoidal(f64::INFINITY, 1.0, 1.0),
        Law::trapezoidal(1.0, 0.0, 1.0),
    ] {
        assert_eq!((listed(&law, -1.0, 9.0), law.jet(-1.0)), (vec![], [0.0; 4]), "{law:?}");
    }
}

/// Where a piece begins is known but for rounding: so much is in the bounds.
#[test]
fn bounds_hold_what_is_meant() {
    use crate::numbers::enclosure::{Interval, ONE};
    let law = Law::trapezoidal(0.3, 1.0, 2.0);
    let half = 0.15_f64.sqrt();
    let speed = |x: f64| {
        law.over(&Series::variable(Interval::from(x), ONE, 7)).expect("has bounds").at(1).radius()
    };
    let [first, second] = [0.5, 1.01].map(|share| speed(share * half));
    assert!(second > 8.0 * f64::EPSILON, "{first:e} {second:e}");
}

#[test]
fn parameters_of_moves() {
    for (mut law, names) in
        [(Law::trapezoidal(1.0, 2.0, 3.0), 3), (Law::s_curve(1.0, 2.0, 3.0, 4.0), 4)]
    {
        let all: Vec<(String, f64)> = ["distance", "speed", "acceleration", "jerk"]
            .iter()
            .map(|name| name.to_string())
            .zip([1.0, 2.0, 3.0, 4.0])
            .collect();
        assert_eq!(shown(&law), all[..names]);
        for (k, (name, value)) in all[..names].iter().enumerate() {
            assert!(law.set_parameter(name, value + 4.0));
            let expected: Vec<f64> =
                (0..names).map(|j| all[j].1 + if j <= k { 4.0 } else { 0.0 }).collect();
            assert_eq!(shown(&law).iter().map(|(_, value)| *value).collect::<Vec<_>>(), expected);
        }
        assert!(!law.set_parameter("time", 1.0));
        assert_eq!(law.set_parameter("jerk", 1.0), names == 4);
        assert_eq!((law.kind(), law.trusted().len()), (["trapezoidal", "s_curve"][names - 3], 0));
    }
    assert!(
        Law::trapezoidal(1.0, 1.0, 1.0).description()
            != Law::s_curve(1.0, 1.0, 1.0, 1.0).description()
    );
    assert!(own(|x| [x; 5]).compose(&Law::trapezoidal(1.0, 1.0, 1.0)).trusted().len() == 1);
}
