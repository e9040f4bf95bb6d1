//! Bounds are the range itself but for rounding, and known wherever there is one: against values at
//! ends and extremes, and against dual numbers.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use kin_graph::functions::{ALLOWED, acosh, atanh};
use kin_graph::{Function, Function2, Number};

use crate::ask::proof::bounds::taylor;
use crate::numbers::enclosure::interval::{ALL, Interval, ONE};
use crate::numbers::enclosure::series::{ORDER, Series};
use crate::numbers::real::Real;

const FULL: usize = ORDER + 1;

/// Beyond this angle sine, cosine and tangent are allowed an error that is so many times as large.
const LARGE: f64 = 1e5;
const MORE: f64 = 8.0;

/// Where functions are special, and a little beside that.
#[rustfmt::skip]
const ENDS: [f64; 33] = [
    -800.0, -20.0, -7.0, -PI, -2.0, -FRAC_PI_2 - 1e-8, -1.000_000_000_000_000_2, -1.0, -0.75, -0.5, -1e-3,
    -1e-9, -1e-300, 0.0, 1e-300, 1e-9, 1e-3, 0.5, 0.75, 0.999_999_999_999_999_9, 1.0,
    1.000_000_000_000_000_2, FRAC_PI_2 - 1e-8, FRAC_PI_2 + 1e-8, 2.0, 2.5, PI - 1e-8, PI + 1e-8, 4.0, 7.0,
    20.0, 100.0, 800.0,
];

/// Asserts that bounds hold a range, and are no wider than rounding makes them.
fn is_range(found: Interval, [lo, hi]: [f64; 2], places: f64, what: &str) {
    let room = |x: f64| places * f64::EPSILON * x.abs() + 1e-300;
    assert!(
        found.lo() <= lo && found.hi() >= hi,
        "{what}: {found:?} does not hold {lo:e} to {hi:e}"
    );
    assert!(
        found.lo() >= lo - room(lo) || lo.is_infinite(),
        "{what}: {found:?} is wider than {lo:e} to {hi:e}"
    );
    assert!(
        found.hi() <= hi + room(hi) || hi.is_infinite(),
        "{what}: {found:?} is wider than {lo:e} to {hi:e}"
    );
}

fn range(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    values
        .into_iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], y| [lo.min(y), hi.max(y)])
}

/// All intervals from one end to another.
fn intervals(ends: &[f64]) -> impl Iterator<Item = [f64; 2]> {
    ends.iter()
        .flat_map(move |lo| ends.iter().filter(move |hi| lo <= *hi).map(move |hi| [*lo, *hi]))
}

struct Line {
    name: &'static str,
    over: fn(Interval) -> Interval,
    f: fn(f64) -> f64,
    /// Where it is defined.
    domain: [f64; 2],
    /// All values that it has, f64's own beyond them being rounding.
    image: [f64; 2],
    /// Its extremes: the first, and how far apart they are.
    extremes: Option<[f64; 2]>,
}

fn lines() -> Vec<Line> {
    const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
    let line = |name, over, f, domain, image| Line { name, over, f, domain, image, extremes: None };
    let waves = |name, over, f, extremes| Line {
        name,
        over,
        f,
        domain: EVERYWHERE,
        image: [-1.0, 1.0],
        extremes: Some(extremes),
    };
    let even = |name, over, f, least| Line {
        name,
        over,
        f,
        domain: EVERYWHERE,
        image: [least, f64::INFINITY],
        extremes: Some([0.0, f64::INFINITY]),
    };
    let up = [0.0, f64::INFINITY];
    let near = [-1.0, 1.0];
    vec![
        waves("sin", Interval::sin, f64::sin, [FRAC_PI_2, PI]),
        waves("cos", Interval::cos, f64::cos, [0.0, PI]),
        even("cosh", Interval::cosh, f64::cosh, 1.0),
        even("abs", Interval::abs, f64::abs, 0.0),
        even("sqr", Interval::sqr, |x| x * x, 0.0),
        line("asin", Interval::asin, f64::asin, near, EVERYWHERE),
        line("acos", Interval::acos, f64::acos, near, EVERYWHERE),
        line("atan", Interval::atan, f64::atan, EVERYWHERE, EVERYWHERE),
        line("sinh", Interval::sinh, f64::sinh, EVERYWHERE, EVERYWHERE),
        line("tanh", Interval::tanh, f64::tanh, EVERYWHERE, EVERYWHERE),
        line("asinh", Interval::asinh, f64::asinh, EVERYWHERE, EVERYWHERE),
        line("acosh", Interval::acosh, acosh, [1.0, f64::INFINITY], EVERYWHERE),
        line("atanh", Interval::atanh, atanh, near, EVERYWHERE),
        line("exp", Interval::exp, f64::exp, EVERYWHERE, up),
        line("exp_m1", Interval::exp_m1, f64::exp_m1, EVERYWHERE, EVERYWHERE),
        line("ln", Interval::ln, f64::ln, up, EVERYWHERE),
        line("ln_1p", Interval::ln_1p, f64::ln_1p, [-1.0, f64::INFINITY], EVERYWHERE),
        line("cbrt", Interval::cbrt, f64::cbrt, EVERYWHERE, EVERYWHERE),
    ]
}

#[test]
fn functions_give_their_range_and_nothing_beside_it() {
    for Line { name, over, f, domain, image, extremes } in lines() {
        for [lo, hi] in intervals(&ENDS) {
            let found = over(Interval::new(lo, hi));
            let what = format!("{name} from {lo:e} to {hi:e}");
            if lo < domain[0] || hi > domain[1] {
                assert_eq!(found, ALL, "{what}");
                continue;
            }
            let inner = extremes.into_iter().flat_map(|[first, apart]| {
                let number = if apart.is_finite() { ((lo - first) / apart).ceil() } else { 0.0 };
                let at = move |k: u32| {
                    if apart.is_finite() { first + (number + f64::from(k)) * apart } else { first }
                };
                (0..2)
                    .map(at)
                    .filter(move |x| (lo..=hi).contains(x))
                    .map(|x| if image[1] == 1.0 { f(x).round() } else { f(x) })
            });
            let expected = range([f(lo), f(hi)].into_iter().chain(inner));
            is_range(
                found,
                expected,
                if f(1e308).is_infinite() || image[0] == -1.0 { 20.0 } else { 800.0 },
                &what,
            );
            assert!(
                found.lo() >= image[0] && found.hi() <= image[1],
                "{what}: {found:?} is beyond all values"
            );
        }
    }
}

/// Every bound has room for the error of other platforms' functions, however exact this platform's
/// are: a proof is the same everywhere.
#[test]
fn bounds_leave_the_room_that_is_allowed() {
    let leaves = |found: Interval, y: f64, allowed: f64, what: &str| {
        let room = 0.9 * allowed * f64::EPSILON * y.abs();
        assert!(
            found.lo() <= y - room
                && found.hi() >= y + room
                && found.radius() <= 1.3 * room + 1e-300,
            "{what}: {found:?} around {y:e}"
        );
    };
    for Line { name, over, f, domain, .. } in
        lines().into_iter().filter(|line| !["abs", "sqr"].contains(&line.name))
    {
        for x in [-0.7, -0.3, 0.4, 0.8, 1.3, 2.0]
            .into_iter()
            .filter(|x| (domain[0]..=domain[1]).contains(x))
        {
            leaves(over(Interval::from(x)), f(x), ALLOWED, name);
        }
    }
    type Wave = (fn(Interval) -> Interval, fn(f64) -> f64);
    let waves: [Wave; 3] =
        [(Interval::sin, f64::sin), (Interval::cos, f64::cos), (Interval::tan, f64::tan)];
    for ((over, f), x) in waves.into_iter().flat_map(|wave| {
        [0.4, 0.9 * LARGE, 1.1 * LARGE, -0.9 * LARGE, -1.1 * LARGE].map(|x| (wave, x))
    }) {
        leaves(
            over(Interval::from(x)),
            f(x),
            if x.abs() > LARGE { MORE * ALLOWED } else { ALLOWED },
            "an angle",
        );
    }
    for (y, x) in [(0.3, 1.0), (-0.3, -1.0), (2.0, -0.1)] {
        leaves(Interval::from(y).atan2(Interval::from(x)).0, f64::atan2(y, x), ALLOWED, "atan2");
    }
}

/// Odd powers of σ are of both signs, even ones of one; the last coefficient is that over all of
/// the interval, those before it are at its middle.
#[test]
fn the_formula_of_taylor_takes_each_power_by_itself() {
    let series = |c: &[f64], len: usize| {
        Series::of(&c.iter().map(|c| Interval::from(*c)).collect::<Vec<_>>(), len)
    };
    let at = series(&[10.0, 1.0, 2.0, 4.0, 8.0], FULL);
    let over = series(&[20.0, 30.0, 40.0, 50.0, 60.0, 0.0, 16.0], FULL);
    is_range(
        taylor(&at, &over),
        [10.0 - 1.0 - 4.0, 10.0 + 1.0 + 2.0 + 4.0 + 8.0 + 16.0],
        20.0,
        "all",
    );
    is_range(taylor(&at, &over.cut(3)), [10.0 - 1.0, 10.0 + 1.0 + 40.0], 20.0, "two and the rest");
    is_range(taylor(&at, &over.cut(2)), [10.0 - 30.0, 10.0 + 30.0], 20.0, "one and the rest");
    assert_eq!((taylor(&at, &over.cut(1)), taylor(&at, &over.cut(0))), (Interval::from(20.0), ALL));
}

#[test]
fn the_sign_of_a_zero_is_no_side_of_the_cut() {
    for zero in [0.0, -0.0] {
        for (lo, across) in [(-0.1, true), (zero, false)] {
            let (angle, found) = Interval::new(lo, zero).atan2(Interval::new(-2.0, -1.0));
            assert!(
                found == across && angle.contains(PI) && angle.lo() > 3.1 && angle.hi() < 3.3,
                "{lo} to {zero}: {angle:?}"
            );
        }
    }
}

#[test]
fn tangents_are_known_between_their_poles() {
    for [lo, hi] in intervals(&ENDS) {
        let found = Interval::new(lo, hi).tan();
        if (lo / PI + 0.5).floor() == (hi / PI + 0.5).floor() {
            is_range(found, [lo.tan(), hi.tan()], 20.0, &format!("tan from {lo:e} to {hi:e}"));
        } else {
            assert_eq!(found, ALL, "{lo:e} to {hi:e}");
        }
    }
}

#[test]
fn roots_powers_and_steps_give_their_range() {
    for [lo, hi] in intervals(&ENDS) {
        let x = Interval::new(lo, hi);
        match hi < 0.0 {
            true => assert_eq!(x.sqrt(), ALL),
            false => is_range(
                x.sqrt(),
                [lo.max(0.0).sqrt(), hi.sqrt()],
                4.0,
                &format!("root from {lo:e} to {hi:e}"),
            ),
        }
        for n in 0..8_u32 {
            let least = (n > 0 && n.is_multiple_of(2) && x.contains(0.0)).then_some(0.0);
            let expected = range([lo.powi(n as i32), hi.powi(n as i32)].into_iter().chain(least));
            is_range(
                x.powi(n),
                expected,
                4.0 * f64::from(n),
                &format!("power {n} from {lo:e} to {hi:e}"),
            );
        }
        for f in [f64::floor, f64::ceil, f64::trunc, f64::round] {
            assert_eq!(
                x.step(f),
                (f(lo) == f(hi)).then(|| Interval::from(f(lo))),
                "step from {lo:e} to {hi:e}"
            );
        }
        for a in [-1.5, 0.3, 2.0] {
            let expected = range([lo.powf(a), hi.powf(a)]);
            let found = x.powf(Interval::from(a));
            match lo > 0.0 {
                true => is_range(found, expected, 3e4, &format!("power {a} from {lo:e} to {hi:e}")),
                false => assert_eq!(found, ALL),
            }
        }
    }
    assert_eq!(
        (ALL.step(f64::floor), ALL.powi(2), ALL.powi(5)),
        (None, Interval::new(0.0, f64::INFINITY), ALL)
    );
}

/// Of two numbers: products and quotients at the corners, the distance at the nearest and the
/// farthest, angles on a grid.
#[test]
fn functions_of_two_numbers_give_their_range() {
    let ends = [-3.0, -1.0, -0.5, 0.0, 0.25, 1.0, 2.0];
    for ([a, b], [c, d]) in intervals(&ends).flat_map(|x| intervals(&ends).map(move |y| (x, y))) {
        let x = Interval::new(a, b);
        let y = Interval::new(c, d);
        let what = format!("[{a}, {b}] and [{c}, {d}]");
        is_range(x + y, [a + c, b + d], 2.0, &what);
        is_range(x - y, [a - d, b - c], 2.0, &what);
        is_range(x * y, range([a * c, a * d, b * c, b * d]), 2.0, &what);
        match y.contains(0.0) {
            true => assert_eq!(x / y, ALL, "{what}"),
            false => is_range(x / y, range([a / c, a / d, b / c, b / d]), 2.0, &what),
        }
        let least =
            |lo: f64, hi: f64| if lo <= 0.0 && hi >= 0.0 { 0.0 } else { lo.abs().min(hi.abs()) };
        let most = |lo: f64, hi: f64| lo.abs().max(hi.abs());
        is_range(
            x.hypot(y),
            [least(a, b).hypot(least(c, d)), most(a, b).hypot(most(c, d))],
            8.0,
            &what,
        );
        let (angle, across) = y.atan2(x);
        let is_cut = b < 0.0 && c < 0.0 && d >= 0.0;
        assert_eq!(across, is_cut, "{what}");
        if x.contains(0.0) && y.contains(0.0) {
            assert_eq!(angle, ALL, "{what}");
            continue;
        }
        let grid = |lo: f64, hi: f64, k: i32| {
            if k == 8 { hi } else { lo + (hi - lo) * f64::from(k) / 8.0 }
        };
        // below the axis angles go on; a zero is above it
        let turned = |y: f64, x: f64| {
            if y == 0.0 {
                0.0_f64.atan2(x)
            } else if is_cut && y < 0.0 {
                y.atan2(x) + TAU
            } else {
                y.atan2(x)
            }
        };
        let all = range((0..81).map(|k| turned(grid(c, d, k % 9), grid(a, b, k / 9))));
        is_range(angle, all, 40.0, &what);
    }
}

/// f, f′, f″/2, f‴/6 of one number, by dual numbers, and the next two by differences of those.
#[test]
fn at_one_number_all_coefficients_are_known() {
    let at = |f: Function, a: f64| Series::variable(Interval::from(a), ONE, FULL).call(f);
    for (&f, a) in Function::ALL.iter().flat_map(|f| [-2.3, -0.6, 0.3, 0.7, 1.8].map(|a| (f, a))) {
        let exact = Real(crate::numbers::real::Dual3_64::new(a, 1.0, 0.0, 0.0)).call(f).0;
        let found = at(f, a);
        let what = format!("{f:?} at {a}");
        let exact = [exact.re, exact.v1, exact.v2 / 2.0, exact.v3 / 6.0];
        if !exact.iter().all(|c| c.is_finite()) {
            assert_eq!(found.len(), 0, "{what}: {exact:?}");
            continue;
        }
        assert_eq!(found.len(), FULL, "{what}");
        for (k, c) in exact.into_iter().enumerate() {
            let off = (found.at(k) - Interval::from(c)).mag();
            assert!(
                off <= 1e-10 * (1.0 + c.abs()),
                "coefficient {k} of {what}: {:?} and {c:e}",
                found.at(k)
            );
        }
        let h = 1e-3;
        let before = at(f, a - h);
        let after = at(f, a + h);
        for k in 3..ORDER {
            let slope = (after.at(k).mid() - before.at(k).mid()) / (2.0 * h * (k + 1) as f64);
            let off = (found.at(k + 1) - Interval::from(slope)).mag();
            assert!(
                off <= 1e-3 * (1.0 + slope.abs())
                    && found.at(k + 1).radius() <= 1e-8 * (1.0 + slope.abs()),
                "coefficient {} of {what}",
                k + 1
            );
        }
        let constant = Series::constant(Interval::from(a)).call(f);
        assert!(
            constant.is_constant()
                && constant.value().meets(found.value())
                && constant.value().radius() <= 1e-14 * (1.0 + exact[0].abs()),
            "{what}"
        );
    }
}

/// The same of two numbers that move along a line.
#[test]
fn at_two_numbers_all_coefficients_are_known() {
    let numbers = [(1.3, 0.4), (-1.3, 0.4), (1.3, -0.4), (-0.7, -2.6), (0.4, 2.0), (2.0, 3.0)];
    let all = Function2::ALL
        .iter()
        .flat_map(|f| numbers.map(|pair| (f, pair)))
        .flat_map(|(f, pair)| [(0.8, -0.3), (0.8, 0.0), (0.0, -0.3)].map(|v| (f, pair, v)));
    for (&f, (a, b), (v, w)) in all {
        let dual = |x: f64, v: f64| Real(crate::numbers::real::Dual3_64::new(x, v, 0.0, 0.0));
        let series = |x: f64, v: f64| Series::variable(Interval::from(x), Interval::from(v), FULL);
        let exact = dual(a, v).call2(f, dual(b, w)).0;
        let found = series(a, v).call2(f, series(b, w));
        let what = format!("{f:?} of {a} and {b}, at {v} and {w}");
        let exact = [exact.re, exact.v1, exact.v2 / 2.0, exact.v3 / 6.0];
        if !exact.iter().all(|c| c.is_finite()) {
            assert_eq!(found.len(), 0, "{what}");
            continue;
        }
        assert_eq!(found.len(), FULL, "{what}");
        for (k, c) in exact.into_iter().enumerate() {
            assert!(
                (found.at(k) - Interval::from(c)).mag() <= 1e-10 * (1.0 + c.abs()),
                "coefficient {k} of {what}: {:?} and {c:e}",
                found.at(k)
            );
        }
        let still = |x: f64| Series::constant(Interval::from(x));
        let constant = still(a).call2(f, still(b));
        assert!(constant.is_constant() && constant.value().meets(found.value()), "{what}");
        // one of them alone moves
        assert!(
            !series(a, 0.8).call2(f, still(b)).is_constant()
                || [Function2::DivEuclid, Function2::Max, Function2::Min].contains(&f),
            "{what}"
        );
        assert_eq!(
            (series(a, 0.8).call2(f, still(b)).len(), still(a).call2(f, series(b, 0.8)).len() > 0),
            (FULL, !(f == Function2::Powf && a < 0.0)),
            "{what}"
        );
    }
}
