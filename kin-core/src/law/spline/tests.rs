use super::*;
use crate::law::tests::{bounded, listed, near};

const TABLE: [(f64, f64); 6] =
    [(-0.5, 1.0), (0.5, 1.8), (1.25, 0.2), (2.0, -0.7), (3.5, 0.4), (4.0, 1.0)];
const CLAMPED: Ends = Ends::Clamped { start: -1.0, end: 2.0 };
const ALL: [Ends; 3] = [Ends::Natural, CLAMPED, Ends::Periodic];

fn spline(table: &[(f64, f64)], ends: Ends) -> Spline {
    Spline::new(Points { table: table.to_vec(), ends })
}

/// The conditions that make a spline: it goes through the points, with the same slope and curvature
/// on both sides of each, and with the ends that are asked for.
#[test]
fn splines_do_what_makes_them_splines() {
    for ends in ALL {
        let (spline, law, last) =
            (spline(&TABLE, ends), Law::spline(&TABLE, ends), TABLE.len() - 1);
        assert_eq!(spline.curvature.len(), TABLE.len());
        for k in 0..last {
            let [left, right] = [TABLE[k].0, TABLE[k + 1].0].map(|x| spline.inside(k, x));
            near(left[0], TABLE[k].1, 1e-14);
            near(right[0], TABLE[k + 1].1, 1e-14);
            let next = if k + 1 < last {
                Some(spline.inside(k + 1, TABLE[k + 1].0))
            } else {
                (ends == Ends::Periodic).then(|| spline.inside(0, TABLE[0].0))
            };
            next.iter()
                .for_each(|next| (0..3).for_each(|order| near(next[order], right[order], 1e-13)));
            // derivatives are those of the value, which is a cubic
            let x = 0.5 * (TABLE[k].0 + TABLE[k + 1].0);
            let h = 0.25 * (TABLE[k + 1].0 - TABLE[k].0);
            let f = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|s| spline.inside(k, x + s * h)[0]);
            let found = law.jet(x);
            near(found[1], (8.0 * (f[3] - f[1]) - (f[4] - f[0])) / (12.0 * h), 1e-12);
            near(found[2], (f[3] - 2.0 * f[2] + f[1]) / (h * h), 1e-12);
            near(found[3], (f[4] - 2.0 * f[3] + 2.0 * f[1] - f[0]) / (2.0 * h.powi(3)), 1e-11);
            assert_eq!((law.fourth(x), spline.third(k)), (0.0, spline.inside(k, x)[3]));
        }
        let [first, second] =
            [spline.inside(0, TABLE[0].0), spline.inside(last - 1, TABLE[last].0)];
        let end = 7.25;
        match ends {
            Ends::Natural => assert!(first[2].abs() + second[2].abs() < 1e-13),
            Ends::Clamped { start, end } => [(first, start), (second, end)]
                .iter()
                .for_each(|(found, slope)| near(found[1], *slope, 1e-13)),
            Ends::Periodic => {
                near(spline.third(last), spline.third(0), 0.0);
                (0..3).for_each(|order| {
                    [-4.5, 4.5, 9.0].iter().for_each(|turn| {
                        near(law.jet(0.7 + turn)[order], law.jet(0.7)[order], 1e-13)
                    })
                });
                continue;
            }
        }
        // straight on
        assert_eq!(
            (law.jet(-3.5), law.jet(end)),
            (
                [first[0] - 3.0 * first[1], first[1], 0.0, 0.0],
                [second[0] + 3.25 * second[1], second[1], 0.0, 0.0]
            )
        );
        assert_eq!(spline.third(last), 0.0);
        assert_eq!(law.jet(TABLE[0].0), first);
        near(law.jet(TABLE[last].0)[1], second[1], 0.0);
        assert_eq!(law.jet(TABLE[last].0), second);
    }
}

#[test]
fn a_spline_of_too_few_points_is_none() {
    let refused = spline(&TABLE[..1], Ends::Natural);
    assert!(
        refused.curvature.is_empty()
            && refused.jet(0.0).iter().all(|f| f.is_nan())
            && refused.over(&Series::number(0.0)).is_none()
    );
    assert!(
        refused.breaks(-9.0, 9.0).is_empty()
            && Law::spline(&[(0.0, 0.0); 0], Ends::Natural).over(&Series::number(0.0)).is_none()
    );
    assert!(Law::spline(&TABLE, Ends::Natural).jet(f64::NAN).iter().all(|f| f.is_nan()));
}

/// A cubic with its own slopes at the ends is itself, to the last knots, with no break inside; two
/// and three points do.
#[test]
fn a_cubic_is_its_own_spline() {
    let knots = [&[0.0, 1.0][..], &[-1.0, 0.25, 1.0], &[-1.0, -0.25, 0.5, 1.75, 2.0]];
    for (knots, sign) in knots.into_iter().flat_map(|knots| [(knots, 1.0), (knots, -1.0)]) {
        let cubic = sign * Law::polynomial(&[1.0, -2.0, 0.5, 0.75]);
        let table: Vec<(f64, f64)> = knots.iter().map(|x| (*x, cubic.at(*x))).collect();
        let from = knots[0];
        let to = knots[knots.len() - 1];
        let law =
            Law::spline(&table, Ends::Clamped { start: cubic.slope(from), end: cubic.slope(to) });
        for k in 0..50 {
            let x = from + (to - from) * f64::from(k) / 50.0;
            law.jet(x)
                .into_iter()
                .zip(cubic.jet(x))
                .for_each(|(found, exact)| near(found, exact, 1e-13));
        }
        assert_eq!(listed(&law, -9.0, 9.0), [(from, 2), (to, 2)]);
    }
    // A parabola has a curvature at its ends and no third derivative.
    assert_eq!(
        listed(
            &Law::spline(&[(0.0, 0.0), (1.0, 1.0)], Ends::Clamped { start: 0.0, end: 2.0 }),
            -9.0,
            9.0
        ),
        [(0.0, 2), (1.0, 2)]
    );
    // A hat, by hand: f″ = −3 in the middle.
    let hat = spline(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)], Ends::Natural);
    assert_eq!(hat.curvature, [0.0, -3.0, 0.0]);
    // A line has no break anywhere, whatever its ends; a parabola between lines has them at its
    // ends alone.
    for ends in [Ends::Natural, Ends::Clamped { start: 2.0, end: 2.0 }] {
        assert_eq!(
            listed(&Law::spline(&[(0.0, 1.0), (1.0, 3.0), (3.0, 7.0)], ends), -9.0, 9.0),
            []
        );
    }
    assert_eq!(
        listed(&Law::spline(&[(0.0, 1.0), (1.0, 1.0), (3.0, 1.0)], Ends::Periodic), -9.0, 9.0),
        []
    );
}

#[test]
fn breaks_of_splines() {
    let found = |ends, from, to| listed(&Law::spline(&TABLE, ends), from, to);
    let with = |first: usize, order: &[usize]| {
        TABLE.iter().skip(first).zip(order).map(|((x, _), order)| (*x, *order)).collect::<Vec<_>>()
    };
    assert_eq!(found(Ends::Natural, -9.0, 9.0), with(0, &[3; 6]));
    assert_eq!(found(CLAMPED, -9.0, 9.0), with(0, &[2, 3, 3, 3, 3, 2]));
    assert_eq!(found(CLAMPED, 0.5, 3.5), with(1, &[3; 4]));
    assert_eq!(found(Ends::Periodic, -0.5, 4.0), [with(0, &[3; 5]), vec![(4.0, 3)]].concat());
    assert_eq!(found(Ends::Periodic, 4.25, 6.0), [(5.0, 3), (5.75, 3)]);
    assert!(ALL.iter().all(|ends| !Law::spline(&TABLE, *ends).is_smooth()));
    // One knot that the cubic goes through without a jump, one where it jumps by little and one by
    // less than rounding.
    let jumps = |by: f64| {
        let cubic = |x: f64| x * x * x - x + if x > 0.5 { by * (x - 0.5).powi(3) } else { 0.0 };
        let table: Vec<(f64, f64)> =
            [-1.0, -0.5, 0.5, 1.0].iter().map(|x| (*x, cubic(*x))).collect();
        listed(
            &Law::spline(&table, Ends::Clamped { start: 2.0, end: 2.0 + by * 0.75 }),
            -0.75,
            0.75,
        )
    };
    for (by, count) in
        [(0.0, 0), (0.7e-9, 0), (1.3e-9, 1), (-0.7e-9, 0), (-1.3e-9, 1), (1e-6, 1), (-0.5, 1)]
    {
        assert_eq!(jumps(by), [(0.5, 3)][..count], "{by}");
    }
    // One that repeats and begins where nothing jumps, though its third derivative is not zero
    // there.
    let base = Law::spline(&TABLE, Ends::Periodic);
    let mut again: Vec<(f64, f64)> = TABLE[1..].to_vec();
    again.insert(0, (0.0, base.at(0.0)));
    again.push((4.5, base.at(0.0)));
    let found = listed(&Law::spline(&again, Ends::Periodic), -0.1, 4.6);
    assert_eq!(found.iter().map(|found| found.0).collect::<Vec<_>>(), [0.5, 1.25, 2.0, 3.5, 4.0]);
    assert!(base.jet(0.0)[3].abs() > 1.0 && base.kind() == "spline");
    let many: Vec<(f64, f64)> = (0..15_500).map(|k| (f64::from(k), f64::from(k % 3))).collect();
    assert_eq!(listed(&Law::spline(&many, Ends::Natural), -1.0, 1e9).len(), breaks::MOST_BREAKS);
}

/// How far curvatures can be off: what is added to one of them is found, and hardly more; what was
/// found of a table is right to rounding.
#[test]
fn curvatures_that_are_off_are_known_to_be() {
    for ends in ALL {
        let sound = spline(&TABLE, ends);
        assert!(sound.error > 0.0 && sound.error < 1e-13, "{ends:?} {}", sound.error);
        for k in 0..TABLE.len() {
            let mut off = sound.clone();
            off.curvature[k] += 1e-6;
            if ends == Ends::Periodic && (k == 0 || k == TABLE.len() - 1) {
                off.curvature[0] = sound.curvature[0] + 1e-6;
                off.curvature[TABLE.len() - 1] = off.curvature[0];
            }
            let error = off.curvature_error();
            let room =
                if ends == Ends::Natural && (k == 0 || k == TABLE.len() - 1) { 1.1 } else { 2.1 };
            assert!(error >= 1e-6 && error <= room * 1e-6, "{ends:?} {k} {error:e}");
        }
    }
    // The error of the curvatures is in the bounds of a piece: f is off by no more than x (h − x)/2
    // times it, and its slope by a share of h.
    let mut off = spline(&TABLE, Ends::Natural);
    let sound = off.cubic(1, &Series::variable(Interval::from(0.875), ONE, 7));
    off.error = 1e-3;
    let wide = off.cubic(1, &Series::variable(Interval::from(0.875), ONE, 7));
    let added: Vec<f64> = (0..4).map(|k| wide.at(k).radius() - sound.at(k).radius()).collect();
    let least = [0.5 * 0.375 * 0.375 * 1e-3, 0.0, 0.5e-3, 1e-3 / (3.0 * 0.75)];
    added.iter().zip(least).for_each(|(added, least)| {
        assert!(*added >= 0.999 * least && *added <= 6.0 * least + 1e-3, "{added} {least}")
    });
}

#[test]
fn bounds_of_splines() {
    for ends in ALL {
        let law = Law::spline(&TABLE, ends);
        let points: Vec<(f64, f64)> =
            (0..40).map(|k| -3.0 + 0.23 * f64::from(k)).map(|x| (x, x)).collect();
        bounded(&law, &points, 1.0);
        bounded(
            &law,
            &[
                (0.6, 0.61),
                (1.2, 1.3),
                (-0.6, -0.4),
                (3.9, 4.1),
                (-3.0, -2.0),
                (5.0, 6.0),
                (2.1, 2.2),
                (-20.0, 20.0),
            ],
            60.0,
        );
        assert!(law.trusted().is_empty());
    }
}
