use super::*;
use crate::law::tests::{near, own};
use crate::numbers::random::Random;

fn places(all: &[(f64, usize)]) -> Vec<(f64, usize)> {
    let all = merged(all.iter().map(|(x, order)| Break { x: *x, order: *order }).collect());
    all.iter().map(|found| (found.x, found.order)).collect()
}

/// Places that differ by rounding are one, with the sharper break of both, on either side of zero
/// and not beside it.
#[test]
fn places_that_differ_by_rounding_are_one() {
    assert_eq!(places(&[(2.0, 0), (1.0 + 1e-13, 1), (1.0, 3)]), [(1.0, 1), (2.0, 0)]);
    assert_eq!(places(&[(-1.0, 1), (-1.0 - 1e-13, 3), (-2.0, 2)]), [(-2.0, 2), (-1.0 - 1e-13, 1)]);
    assert_eq!(places(&[(0.0, 2), (1e-13, 3), (-1e-13, 1)]), [(-1e-13, 1), (0.0, 2), (1e-13, 3)]);
    assert_eq!(
        places(&[(1.0, 2), (1.0 + 3e-12, 1), (1e6, 3), (1e6 + 5e-7, 2)]),
        [(1.0, 2), (1.0 + 3e-12, 1), (1e6, 2)]
    );
    let many: Vec<(f64, usize)> = (0..=MOST_BREAKS).map(|k| (k as f64, 1)).collect();
    assert_eq!(places(&many).len(), MOST_BREAKS);
}

/// Carried on by Taylor's formula: exactly for a cubic, and with the fourth derivative in the
/// second and the third.
#[test]
fn the_left_side_of_an_end() {
    let cubic = Law::polynomial(&[1.0, -2.0, 3.0, -4.0]);
    for (x, step) in [(2.0, 0.5), (-1.0, 0.3), (0.7, 0.0)] {
        left_jet(&cubic, x, step)
            .into_iter()
            .zip(cubic.jet(x))
            .for_each(|(found, exact)| near(found, exact, 1e-10));
    }
    let quartic = Law::polynomial(&[1.0, -2.0, 3.0, -4.0, 5.0]);
    let found = left_jet(&quartic, 2.0, 0.5);
    let exact = quartic.jet(2.0);
    near(found[2], exact[2], 1e-10);
    near(found[3], exact[3], 1e-10);
    near(exact[1] - found[1], 120.0 * 0.5_f64.powi(3) / 6.0, 1e-10);
}

/// A value that is none meets nothing; a derivative that is none jumps nowhere.
#[test]
fn what_jumps_at_a_seam() {
    let law = Law::polynomial(&[0.0, 1.0, 1.0]);
    let order = |right: [f64; 4]| {
        let seam = Seam::after(&law, 1.0, Sizes::of(&law, 1.0), (right, Sizes::default(), 1.0));
        assert!((seam.end() - 2.0).abs() < 1e-12);
        seam.order()
    };
    assert_eq!(order([2.0, 3.0, 2.0, 0.0]), None);
    assert_eq!(
        [[2.1, 3.0, 2.0, 0.0], [2.0, 3.1, 2.0, 0.0], [2.0, 3.0, 2.1, 0.0], [2.0, 3.0, 2.0, 0.1]]
            .map(order),
        [0, 1, 2, 3].map(Some)
    );
    assert_eq!(
        [[f64::NAN, 3.0, 2.0, 0.0], [2.0, f64::NAN, 2.0, 0.0], [2.0, f64::NAN, 2.1, 0.0]]
            .map(order),
        [Some(0), None, Some(2)]
    );
    assert_eq!(Seam::before(1.0, [1.0, 0.0, 0.0, 5.0], Sizes::of(&law, 1.0), 1.0).order(), Some(3));
}

/// Bounds of the library's own laws are nobody's word.
#[test]
fn laws_of_the_library_are_not_trusted() {
    let spline = Law::spline(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.5)], crate::law::Ends::Natural);
    let plain = [
        Law::constant(1.0),
        Law::ramp(1.0),
        Law::polynomial(&[1.0, 2.0]),
        Law::harmonic(0.0, 1.0),
        Law::fourier(0.0, 1.0, &[(1.0, 0.0)]),
    ];
    for law in plain.into_iter().chain([
        spline,
        Law::cycloidal(1.0, 1.0),
        Law::sequence(0.0, [(1.0, Law::ramp(1.0))]),
    ]) {
        assert_eq!(
            (law.trusted(), law.kind().is_empty()),
            (Vec::<String>::new(), false),
            "{law:?}"
        );
    }
}

/// Of each derivative its own, wherever it is largest, and from nowhere else.
#[test]
fn sizes_are_the_largest_of_each_derivative() {
    for sign in [1.0, -1.0] {
        let [at_end, at_begin] = [[0.0, 0.0, 0.0, 0.0, 1.0], [16.0, -32.0, 24.0, -8.0, 1.0]]
            .map(|c| Law::polynomial(&c.map(|c| sign * c)));
        assert_eq!(
            (Sizes::of(&at_end, 2.0).0, Sizes::of(&at_begin, 2.0).0),
            ([16.0, 32.0, 48.0, 48.0, 24.0], [16.0, 32.0, 48.0, 48.0, 24.0])
        );
    }
    for k in 0..16 {
        let (from, to) = (f64::from(k) / 8.0, f64::from(k + 1) / 8.0);
        let law = own(move |x| {
            [-2.0, 0.5, -3.0, 4.0, -5.0]
                .map(|f| if (from..to).contains(&x) { f } else { f64::from((x - 1.0).abs() > 1.0) })
        });
        assert_eq!(Sizes::of(&law, 2.0).0, [2.0, 0.5, 3.0, 4.0, 5.0], "{k}");
    }
    let unknown = Sizes([1.0, f64::NAN, 3.0, f64::NAN, 5.0])
        .with(Sizes([2.0, 1.0, f64::NAN, f64::NAN, 4.0]))
        .0;
    assert_eq!(unknown[..3], [2.0, 1.0, 3.0]);
    assert!(unknown[3].is_nan() && unknown[4] == 5.0);
}

/// A left side is looked at where the law has hardly changed, nearer than a billionth of the
/// length, and no nearer than rounding lets it.
#[test]
fn how_far_before_an_end_a_law_is_looked_at() {
    let step = |f: f64, f1: f64, length: f64| Sizes([f, f1, 0.0, 0.0, 0.0]).step(length);
    near(1e11 * step(2.0, 1e7, 4.0), 2.0, 1e-12);
    near(1e9 * step(2.0, 1e3, 4.0), 4.0, 1e-12);
    assert_eq!((step(2.0, 1e12, 4.0), step(2.0, -1e3, 4.0)), (256.0 * f64::EPSILON, 4e-9));
    assert_eq!((step(0.0, 1.0, 4.0), step(0.0, 0.0, 4.0), step(1.0, 0.0, 4.0)), (4e-9, 4e-9, 4e-9));
}

/// Nine digits of a value, seven of a derivative, what the law changes by over the step, and
/// rounding of the others.
#[test]
fn what_two_sides_may_differ_by() {
    let allowed = |sizes: [f64; 5], k: usize, length: f64| Sizes(sizes).allowed(k, 1e-8, length);
    let sizes = [2.0, 3.0, 5.0, 7.0, 11.0];
    let expected = [
        (allowed(sizes, 0, 1.0), 2e-9 + 24.0 * f64::EPSILON),
        (allowed(sizes, 0, 1e6), 2e-9 + 24e6 * f64::EPSILON),
        (allowed(sizes, 1, 1e3), 3e-7 + 1e-7 + 7e-7),
        (allowed(sizes, 1, 1e-7), 3e-7 + 1e-7 + 2e-6),
        (allowed(sizes, 2, 1e6), 5e-7 + 1.4e-7 + 7e-7),
        (allowed(sizes, 2, 1e-4), 5e-7 + 1.4e-7 + 2e-5),
        (allowed(sizes, 3, 1e-2), 7e-7 + 2.2e-7 + 2e-7),
        (allowed([0.0, 0.0, 5.0, 7.0, 11.0], 3, 1e-7), 7e-7 + 2.2e-7 + 5e-6),
        (allowed([0.0, 3.0, 0.0, 0.0, 0.0], 3, 1e-3), 3e-7),
        (allowed([0.0, 0.0, 0.0, 3.0, 0.0], 1, 1e3), 3e-7),
    ];
    expected.iter().for_each(|(found, exact)| near(1e6 * found, 1e6 * exact, 1e-12));
}

/// Each derivative jumps by more than is allowed, and by no less; nothing meets nothing.
#[test]
fn the_least_jump_of_a_seam() {
    let law = Law::polynomial(&[1.0, 1.0, 1.0, 1.0]);
    let sizes = Sizes::of(&law, 2.0);
    for k in 0..4 {
        let step = sizes.step(2.0);
        let left = left_jet(&law, 2.0, step);
        let allowed = sizes.allowed(k, step, 0.5);
        let order = |factor: f64| {
            let mut right = left;
            right[k] += factor * allowed;
            Seam::after(&law, 2.0, sizes, (right, Sizes::default(), 0.5)).order()
        };
        assert_eq!([0.9, 1.2, -0.9, -1.2].map(order), [None, Some(k), None, Some(k)], "{k}");
        // The derivatives after the break may be the larger ones.
        let mut right = left;
        right[k] += 1.2 * allowed;
        assert_eq!(
            Seam::after(&law, 2.0, sizes, (right, Sizes([1e3, 1e3, 1e3, 1e3, 1e3]), 0.5)).order(),
            None
        );
    }
    let held = |right: [f64; 4]| Seam::before(2.0, right, Sizes([2.0, 1.0, 1.0, 1.0, 0.0]), 1.0);
    assert_eq!(
        (
            held([2.0, 1e-6, 0.0, 0.0]).order(),
            held([2.0, 1e-8, 0.0, 0.0]).order(),
            held([2.0; 4]).end()
        ),
        (Some(1), None, 2.0)
    );
    assert_eq!(Seam::before(0.0, [0.0; 4], Sizes::default(), 1.0).order(), None);
}

/// The fourth derivative is that of the place that is looked at, and counts for nothing where it is
/// not known.
#[test]
fn the_fourth_derivative_before_an_end() {
    let law = |f4: fn(f64) -> f64| own(move |x| [0.0, 0.0, 0.0, 0.0, f4(x)]);
    assert_eq!(left_jet(&law(|x| x), 2.0, 0.5), [0.0, 0.0, 0.1875, 0.75]);
    assert_eq!(left_jet(&law(|_| f64::NAN), 2.0, 0.5), [0.0; 4]);
    assert_eq!(left_jet(&law(|_| f64::INFINITY), 2.0, 0.5), [0.0; 4]);
}

#[test]
fn the_nearest_places_that_are_two() {
    assert_eq!(places(&[(0.0, 2), (0.0, 1)]), [(0.0, 1)]);
    assert_eq!(places(&[(1.0, 2), (1.0 + 1.2e-12, 1)]), [(1.0, 2), (1.0 + 1.2e-12, 1)]);
    assert_eq!(places(&[(-1.0, 2), (-1.0 - 0.9e-12, 3)]), [(-1.0 - 0.9e-12, 2)]);
}

fn again(one: &[(f64, usize)], start: f64, period: f64, from: f64, to: f64) -> Vec<(f64, usize)> {
    let one: Vec<Break> = one.iter().map(|(x, order)| Break { x: *x, order: *order }).collect();
    repeated(&one, start, period, from, to).iter().map(|b| (b.x, b.order)).collect()
}

/// Both ends count; nothing comes of nothing, of a period that is none, and of an end that is no
/// number.
#[test]
fn breaks_of_each_period() {
    let one = [(0.5, 1), (1.25, 3)];
    assert_eq!(
        again(&one, 0.5, 1.0, 0.5, 2.5),
        [(0.5, 1), (1.25, 3), (1.5, 1), (2.25, 3), (2.5, 1)]
    );
    assert_eq!(again(&one, 0.5, 1.0, -1.75, -0.5), [(-1.75, 3), (-1.5, 1), (-0.75, 3), (-0.5, 1)]);
    assert_eq!(again(&[(0.5, 1)], 0.5, 4.0, 100.5, 108.5), [(100.5, 1), (104.5, 1), (108.5, 1)]);
    assert_eq!(again(&[(0.5, 1)], 0.5, 0.25, -1.0, -0.5), [(-1.0, 1), (-0.75, 1), (-0.5, 1)]);
    for (period, from, to) in [
        (1.0, 2.5, 0.5),
        (-1.0, 0.0, 9.0),
        (0.0, 0.0, 9.0),
        (f64::NAN, 0.0, 9.0),
        (1.0, f64::NAN, 9.0),
        (1.0, 0.0, f64::NAN),
    ] {
        assert_eq!(again(&one, 0.5, period, from, to), [], "{period} {from} {to}");
    }
    assert_eq!(again(&[], 0.0, 1.0, 0.0, 9.0), []);
}

/// As many as are listed at most, from the first one on; where periods are shorter than rounding
/// each place once.
#[test]
fn breaks_of_many_periods() {
    for one in [&[(0.5, 1)][..], &[(0.25, 1), (0.5, 2), (0.75, 3)]] {
        let found = again(one, 0.0, 1.0, 7.0, 1e9);
        let count = MOST_BREAKS as f64 / one.len() as f64;
        assert_eq!((found.len(), found[0]), (MOST_BREAKS, (7.0 + one[0].0, 1)));
        assert!((found[MOST_BREAKS - 1].0 - (7.0 + count)).abs() < 1.0);
    }
    let tight = again(&[(0.0, 1)], 0.0, 1e-17, 1.0, 1.0 + 1e-14);
    assert!(!tight.is_empty() && tight.windows(2).all(|pair| pair[0].0 < pair[1].0), "{tight:?}");
}

/// A break at the very end of a period is found at the number that it is at.
#[test]
fn a_break_at_the_end_of_a_period_is_not_lost_by_rounding() {
    let mut random = Random::new(3);
    for _ in 0..3000 {
        let start = random.number();
        let period = 1.5 + random.number();
        let last = (start + period).next_down();
        assert_eq!(again(&[(last, 2)], start, period, last, last), [(last, 2)], "{start} {period}");
    }
}

#[test]
fn a_law_is_sampled_at_65_places() {
    let places = |law: &Law, from: f64, to: f64| Samples::between(law, from, to).places;
    let line = Law::linear(3.0, -2.0);
    let found = places(&line, -1.0, 3.0);
    assert_eq!(found.len(), 65);
    assert!(
        found
            .iter()
            .zip(0..)
            .all(|((x, y), k)| *x == -1.0 + f64::from(k) / 16.0 && *y == 3.0 - 2.0 * x)
    );
    assert_eq!(places(&line, -1.0, 1e-17)[64].0, 1e-17);
    assert_eq!(Samples::between(&line, -1.0, 3.0).range(), (-3.0, 5.0));
}

/// Each passage once, upwards and downwards, also at a sample; the first number that is not on the
/// side before.
#[test]
fn where_a_law_takes_a_value() {
    let preimages =
        |law: &Law, from: f64, to: f64, y: f64| Samples::between(law, from, to).preimages(y);
    for (law, y) in [(Law::ramp(1.0), 5.0), (Law::ramp(-1.0), -5.0)] {
        assert_eq!(
            (
                preimages(&law, 0.0, 64.0, y),
                preimages(&law, 0.0, 64.0, 1.1 * y),
                preimages(&law, 0.0, 64.0, -y)
            ),
            (vec![5.0], vec![5.5], vec![])
        );
    }
    // −1/4 at the bottom, 0 at ±1/2
    let bowl = Law::polynomial(&[-0.25, 0.0, 1.0]);
    let mut found = preimages(&bowl, -1.0, 1.01, 0.0);
    found.sort_by(f64::total_cmp);
    assert!(
        found.len() == 2 && (found[0] + 0.5).abs() < 1e-15 && (found[1] - 0.5).abs() < 1e-15,
        "{found:?}"
    );
    assert!(preimages(&bowl, -1.0, 1.0, -0.3).is_empty());
    assert_eq!(preimages(&bowl, -1.0, 1.0, -0.25), [0.0]);
    for sign in [1.0, -1.0] {
        assert_eq!(bisected(&|x| sign * (x - 0.3), 0.0, 1.0), 0.3);
        let rest = |x: f64| if x < 0.4 { -sign } else { sign * f64::from(x > 0.6) };
        assert_eq!(
            (bisected(&rest, 0.0, 1.0), bisected(&|x| rest(x - 3.0), 3.0, 4.0)),
            (0.4, bisected(&|x| rest(x - 3.0), 3.1, 3.9))
        );
        assert_eq!(bisected(&|x| sign * (x + 0.7), -1.0, 0.0), -0.7);
    }
}
