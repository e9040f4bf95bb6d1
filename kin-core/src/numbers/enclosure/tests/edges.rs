//! At the edges: where domains end, where intervals touch, where a bound is reached, and that
//! nothing is given away there.

use kin_graph::{Comparison, Condition, Function, Function2, Number, Possibly};

use crate::numbers::enclosure::interval::{ALL, Interval, ONE, UNIT};
use crate::numbers::enclosure::series::{ORDER, Series};

const FULL: usize = ORDER + 1;

fn over(lo: f64, hi: f64) -> Series {
    Series::variable(Interval::new(lo, hi), ONE, FULL)
}

/// A function has bounds up to the ends of its domain, and none of an interval that reaches beyond
/// on either side.
#[test]
fn domains_end_where_they_end() {
    for (f, lo, hi) in [
        (Function::Asin, -1.0, 1.0),
        (Function::Acos, -1.0, 1.0),
        (Function::Acosh, 1.0, f64::INFINITY),
        (Function::Atanh, -1.0, 1.0),
        (Function::Ln, 0.0, f64::INFINITY),
        (Function::Log2, 0.0, f64::INFINITY),
        (Function::Log10, 0.0, f64::INFINITY),
        (Function::Ln1p, -1.0, f64::INFINITY),
        (Function::Sqrt, 0.0, f64::INFINITY),
    ] {
        let inside = lo + 0.25;
        let top = if hi.is_finite() { hi - 0.25 } else { lo + 9.0 };
        let known = |from: f64, to: f64| over(from, to).call(f).len() > 0;
        assert!(known(inside, top), "{f:?}");
        assert!(
            !known(lo - 0.5, inside)
                && !known(lo.next_down(), inside)
                && !known(lo - 2.0, lo - 1.0),
            "{f:?} below {lo}"
        );
        // its value at the end, if it is finite
        let at = |x: f64| {
            let bounds = Series::constant(Interval::from(x)).call(f);
            (bounds.len() > 0).then(|| bounds.value())
        };
        let exact = Number::call(crate::numbers::real::Real(lo), f).0;
        assert_eq!(at(lo).is_some(), exact.is_finite(), "{f:?} at {lo}");
        assert!(at(lo).is_none_or(|bounds| bounds.contains(exact) && bounds.radius() < 1e-14));
        if hi.is_finite() {
            assert!(
                !known(inside, hi + 0.5)
                    && !known(inside, hi.next_up())
                    && !known(hi + 0.25, hi + 0.5),
                "{f:?} above {hi}"
            );
            assert_eq!(
                at(hi).is_some(),
                Number::call(crate::numbers::real::Real(hi), f).0.is_finite(),
                "{f:?} at {hi}"
            );
        }
    }
}

/// Bounds do not exceed the range of a function, and reach all values that it takes.
#[test]
fn values_stay_in_their_range() {
    for k in 0..400 {
        let x = -10.0 + 0.05 * f64::from(k);
        for width in [0.0, 1e-9, 0.3, 2.0, 4.0] {
            let x = Interval::new(x, x + width);
            for (f, sample) in [(x.sin(), f64::sin as fn(f64) -> f64), (x.cos(), f64::cos)] {
                assert!(f.lo() >= -1.0 && f.hi() <= 1.0);
                let all = (0..=1000).map(|k| sample(x.lo() + width * f64::from(k) / 1000.0));
                let (lo, hi) = all.fold((1.0_f64, -1.0_f64), |(lo, hi), y| (lo.min(y), hi.max(y)));
                assert!(
                    f.lo() <= lo && f.hi() >= hi && f.lo() > lo - 1e-4 && f.hi() < hi + 1e-4,
                    "{x:?}: {f:?} for {lo} and {hi}"
                );
            }
            if let Some(lo) = Some(x.cosh().lo()).filter(|lo| lo.is_finite()) {
                assert!(lo >= 1.0);
            }
            assert!(x.exp().lo() >= 0.0 && x.sqr().lo() >= 0.0 && x.abs().lo() >= 0.0);
        }
    }
    assert_eq!(
        (Interval::new(-1e-9, 1e-9).cosh().lo(), Interval::from(-800.0).exp().lo()),
        (1.0, 0.0)
    );
    // as far as the argument is known, whatever its size
    assert!(
        Interval::from(1e10).sin().radius() < 1e-5 && Interval::from(1e14).cos().radius() < 0.2
    );
    assert_eq!(
        (Interval::from(1e18).sin(), Interval::new(f64::NEG_INFINITY, 0.0).cos(), ALL.tan()),
        (UNIT, UNIT, ALL)
    );
    assert!(
        Interval::new(1e6, 1e6 + 1e-3).tan().radius() < 0.1
            && Interval::new(1.0, 2.0).tan() == ALL
            && Interval::new(-2.0, -1.0).tan() == ALL
    );
}

/// All that can be said of a comparison, and no more: held against both ends of both, and what of
/// one lies within the other.
#[test]
fn comparisons_of_intervals() {
    let ends = [-1.0, 0.0, 1.0, 2.0];
    let all: Vec<Interval> = ends
        .iter()
        .flat_map(|lo| ends.iter().filter(move |hi| *hi >= lo).map(|hi| Interval::new(*lo, *hi)))
        .collect();
    let points = |a: Interval, b: Interval| {
        [a.lo(), a.hi(), b.lo(), b.hi(), a.mid()]
            .into_iter()
            .filter(|x| a.contains(*x))
            .collect::<Vec<_>>()
    };
    for comparison in Comparison::ALL {
        for (a, b) in all.iter().flat_map(|a| all.iter().map(move |b| (*a, *b))) {
            let holds: Vec<bool> = points(a, b)
                .iter()
                .flat_map(|x| points(b, a).into_iter().map(move |y| comparison.holds(x, &y)))
                .collect();
            let expected =
                Possibly { never: !holds.contains(&true), always: !holds.contains(&false) };
            let found = Series::compare(comparison, &Series::constant(a), &Series::constant(b));
            assert_eq!(found, expected, "{a:?} {comparison:?} {b:?}");
        }
    }
    let open = over(-0.1, 0.1).call2(Function2::Atan2, Series::number(-1.0));
    assert_eq!(
        Series::compare(Comparison::Less, &open, &Series::number(100.0)),
        Possibly { never: false, always: false }
    );
}

#[test]
fn conditions_that_may_hold() {
    let all = [(true, false), (false, true), (false, false)]
        .map(|(never, always)| Possibly { never, always });
    let [never, always, maybe] = all;
    for (a, b, both, either) in [
        (&never, &never, &never, &never),
        (&never, &always, &never, &always),
        (&never, &maybe, &never, &maybe),
        (&always, &always, &always, &always),
        (&always, &maybe, &maybe, &always),
        (&maybe, &maybe, &maybe, &maybe),
    ] {
        for (a, b) in [(a, b), (b, a)] {
            assert_eq!((&a.and(*b), &a.or(*b)), (both, either));
        }
    }
    assert_eq!(all.map(Condition::negated), [always, never, maybe]);
    let chosen =
        all.map(|condition| Series::select(&condition, Series::number(1.0), Series::number(2.0)));
    assert_eq!(
        chosen.map(|chosen| (chosen.len(), chosen.values())),
        [(FULL, [2.0; 2]), (FULL, [1.0; 2]), (0, [f64::NEG_INFINITY, f64::INFINITY])]
    );
    assert_eq!(
        all.map(|condition| Series::of_condition(&condition).values()),
        [[0.0; 2], [1.0; 2], [0.0, 1.0]]
    );
    let holds = [[0.0, 0.0], [0.0, 1.0], [-1.0, 1.0], [0.5, 1.0], [-2.0, -1.0]]
        .map(|[lo, hi]| Series::constant(Interval::new(lo, hi)).holds());
    assert_eq!(holds, [never, maybe, maybe, always, always]);
}

/// Where one is the larger all along, it is that; where they touch too.
#[test]
fn the_larger_and_the_size() {
    let [low, high, both] = [over(0.0, 1.0), over(1.0, 2.0), over(0.5, 1.5)];
    let is = |f: Function2, a: Series, b: Series| (a.call2(f, b).len(), a.call2(f, b).values());
    for (a, b) in [(low, high), (high, low)] {
        assert_eq!(
            (is(Function2::Max, a, b), is(Function2::Min, a, b)),
            ((FULL, [1.0, 2.0]), (FULL, [0.0, 1.0]))
        );
    }
    for (a, b) in [(low, both), (both, low)] {
        assert_eq!(
            (is(Function2::Max, a, b), is(Function2::Min, a, b)),
            ((2, [0.5, 1.5]), (2, [0.0, 1.0]))
        );
    }
    let size = |lo: f64, hi: f64| (over(lo, hi).abs().len(), over(lo, hi).abs().values());
    assert_eq!(
        [size(0.0, 1.0), size(-1.0, 0.0), size(-1.0, 2.0)],
        [(FULL, [0.0, 1.0]), (FULL, [0.0, 1.0]), (2, [0.0, 2.0])]
    );
    // a zero has the sign of its way of being computed
    let sign = |lo: f64, hi: f64| over(lo, hi).call(Function::Signum).values();
    assert_eq!([sign(0.1, 1.0), sign(-1.0, -0.1)], [[1.0; 2], [-1.0; 2]]);
    assert_eq!(
        [sign(0.0, 1.0), sign(-1.0, 0.0), sign(-1.0, 1.0)],
        [[f64::NEG_INFINITY, f64::INFINITY]; 3]
    );
    // the slope of |x| over 0 is between −1 and 1
    assert_eq!((over(-1.0, 2.0).abs().at(1), over(-1.0, 0.0).abs().at(1)), (UNIT, -ONE));
}

/// Whole powers are those of the ends, or 0 between them; of a power that is not whole the number
/// has to be above zero.
#[test]
fn powers() {
    let near = |found: [f64; 2], exact: [f64; 2]| {
        assert!(found[0] <= exact[0] && found[1] >= exact[1], "{found:?} {exact:?}");
        let slack = exact.map(|x| 1e-14 * (1.0 + x.abs()));
        assert!(
            exact[0] - found[0] < slack[0] && found[1] - exact[1] < slack[1],
            "{found:?} {exact:?}"
        );
    };
    for (lo, hi) in [(-2.0, 1.5), (0.0, 1.5), (-2.0, 0.0), (0.5, 1.5), (-2.0, -0.5)] {
        for n in [0, 1, 2, 3, 4, 5, 6, 7, 11] {
            let a = f64::powi(lo, n);
            let b = f64::powi(hi, n);
            let least = if n > 0 && n % 2 == 0 && lo <= 0.0 && hi >= 0.0 { 0.0 } else { a.min(b) };
            near(over(lo, hi).powi(n).values(), [least, a.max(b)]);
            near(
                over(lo, hi).call2(Function2::Powf, Series::number(f64::from(n))).values(),
                [least, a.max(b)],
            );
        }
    }
    near(over(0.5, 2.0).powi(-3).values(), [0.125, 8.0]);
    assert!(over(-0.5, 2.0).powi(-3).len() == 0 && over(0.5, 2.0).powi(i32::MIN).len() == 0);
    let power = |x: Series, a: Series| x.call2(Function2::Powf, a);
    near(power(over(0.25, 4.0), Series::number(0.5)).values(), [0.5, 2.0]);
    near(power(over(0.25, 4.0), Series::number(-0.5)).values(), [0.5, 2.0]);
    near(power(over(1.0, 2.0), over(0.5, 3.0)).values(), [1.0, 8.0]);
    // a whole number only in part, or too large to be multiplied out
    assert!(power(over(-2.0, -1.0), Series::constant(Interval::new(2.0, 2.5))).len() == 0);
    assert!(
        power(over(-2.0, -1.0), over(2.0, 2.0)).len() == 0
            && power(over(0.0, 1.0), Series::number(0.5)).len() == 0
    );
    assert!(
        power(Series::number(-1.0), Series::number(0.5)).len() == 0
            && Series::number(1e200).powi(2).values()[1] == f64::INFINITY
    );
    assert!(
        power(over(-1.0, 1.0), Series::number(0.5)).len() == 0
            && power(over(-1.0, -0.9), Series::number(2e6)).len() == 0
    );
    near(power(Series::number(1.0), Series::number(2e6)).values(), [1.0, 1.0]);
}

/// The length of (x, y), and the angle, over boxes on all sides of the origin: by many points
/// within, and not much wider.
#[test]
fn lengths_and_angles_of_boxes() {
    let ends = [-2.0, -0.5, 0.0, 0.25, 1.5];
    let all: Vec<Interval> = ends
        .iter()
        .flat_map(|lo| ends.iter().filter(move |hi| *hi > lo).map(|hi| Interval::new(*lo, *hi)))
        .collect();
    let points =
        |x: Interval| (0..=20).map(move |k| x.lo() + (x.hi() - x.lo()) * f64::from(k) / 20.0);
    for (x, y) in all.iter().flat_map(|x| all.iter().map(move |y| (*x, *y))) {
        let corners = |f: &dyn Fn(f64, f64) -> f64| {
            let values: Vec<f64> = points(x)
                .flat_map(|x| points(y).map(move |y| (x, y)))
                .map(|(x, y)| f(x, y))
                .collect();
            values
                .into_iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)))
        };
        let (least, most) = corners(&f64::hypot);
        let length = x.hypot(y);
        assert!(
            length.lo() <= least
                && length.hi() >= most
                && length.hi() < most + 1e-12
                && length.lo() > least - 0.3,
            "{x:?} {y:?}: {length:?}"
        );
        let (angle, across) = y.atan2(x);
        if x.contains(0.0) && y.contains(0.0) {
            assert_eq!((angle, across), (ALL, false));
            continue;
        }
        assert_eq!(across, x.hi() < 0.0 && y.lo() < 0.0 && y.hi() >= 0.0, "{x:?} {y:?}");
        let turned = |x: f64, y: f64| {
            let angle = if y == 0.0 { 0.0_f64.atan2(x) } else { y.atan2(x) };
            if across && angle < 0.0 { angle + std::f64::consts::TAU } else { angle }
        };
        let (least, most) = corners(&turned);
        assert!(
            angle.lo() < least && angle.hi() > most,
            "{x:?} {y:?}: {angle:?} for {least} and {most}"
        );
        assert!(
            angle.lo() > least - 1e-13 && angle.hi() < most + 1e-13,
            "{x:?} {y:?}: {angle:?} for {least} and {most}"
        );
    }
    // of what does not move, too
    let still = |x: f64| Series::constant(Interval::new(x, x + 0.25));
    let length = still(3.0).call2(Function2::Hypot, still(4.0));
    assert!(length.is_constant() && length.value().lo() > 4.99 && length.value().hi() < 5.4);
    assert!(
        !over(3.0, 3.25).call2(Function2::Hypot, still(4.0)).is_constant()
            && !still(3.0).call2(Function2::Hypot, over(4.0, 4.25)).is_constant()
    );
    let angle = still(-0.1).call2(Function2::Atan2, still(-2.0));
    assert!(angle.is_constant() && angle.is_open() && angle.sin().is_constant());
}

/// The quotient that leaves a rest of no sign, over divisors of both signs.
#[test]
fn whole_quotients() {
    for (a, b) in [(7.5, 2.0), (-7.5, 2.0), (7.5, -2.0), (-7.5, -2.0), (0.5, 3.0), (-0.5, -3.0)] {
        let [x, y] = [a, b].map(|x: f64| Series::constant(Interval::new(x, x + 1e-6)));
        let rest = x.call2(Function2::RemEuclid, y).value();
        assert_eq!(x.call2(Function2::DivEuclid, y).values(), [a.div_euclid(b); 2]);
        assert!(
            rest.contains(a.rem_euclid(b))
                && rest.radius() < 1e-5
                && x.call2(Function2::Rem, y).value().contains(a % b)
        );
    }
    let both = over(-1.0, 2.0);
    assert!(
        over(7.5, 7.6).call2(Function2::DivEuclid, both).len() == 0
            && over(7.9, 8.1).call2(Function2::DivEuclid, Series::number(2.0)).len() == 0
    );
}

/// A result is known as far as all that it is made of; what does not move stays where it is.
#[test]
fn results_are_as_long_as_the_shortest_operand() {
    let long = over(1.0, 2.0);
    let short = Series::variable(Interval::new(1.0, 2.0), ONE, 3);
    for (a, b) in [(long, short), (short, long)] {
        assert_eq!(
            [(a + b).len(), (a - b).len(), (a * b).len(), (a / b).len(), a.hull(&b).len()],
            [3; 5]
        );
    }
    assert_eq!([long.chain(&[[0.0, 1.0]; 2]).len(), short.chain(&[[0.0, 1.0]; 5]).len()], [2, 3]);
    assert!(Series::number(1.0).chain(&[[2.0; 2], [1.0; 2]]).is_constant());
    // At the end of its domain a function has a value, and no slope.
    assert_eq!(
        [
            over(0.5, 1.0).asin().len(),
            over(1.0, 2.0).call(Function::Acosh).len(),
            over(0.0, 1.0).sqrt().len()
        ],
        [1; 3]
    );
    let still = Series::variable(ONE, Interval::from(0.0), FULL);
    assert!(still.is_constant() && !still.cut(2).is_constant() && !over(1.0, 2.0).is_constant());
    assert_eq!((still.degree(), long.degree(), long.sqr().degree()), (0, 1, 2));
    let unknown = crate::numbers::enclosure::series::UNKNOWN;
    assert!(
        (Series::number(0.0) * unknown).len() == 0 && (unknown * Series::number(0.0)).len() == 0
    );
    assert!((still.cut(2) * Series::number(0.0)).is_constant());
}

/// Of an argument that is not known no value is known.
#[test]
fn nothing_comes_of_nothing() {
    let unknown = crate::numbers::enclosure::series::UNKNOWN;
    for f in Function::ALL {
        assert_eq!(unknown.call(*f).len(), 0, "{f:?}");
    }
    for f in Function2::ALL {
        for (a, b) in [(unknown, over(1.0, 2.0)), (over(1.0, 2.0), unknown), (unknown, unknown)] {
            assert_eq!(a.call2(*f, b).len(), 0, "{f:?}");
        }
    }
    assert!(
        unknown.powi(3).len() == 0
            && unknown.powi(-2).len() == 0
            && unknown.powi(1).len() == 0
            && (unknown * Series::number(0.0)).len() == 0
    );
    // an open angle is nothing to all but sine and cosine
    let open = over(-0.1, 0.1).call2(Function2::Atan2, Series::number(-1.0));
    for f in Function::ALL {
        let known = open.call(*f).len() > 0;
        assert_eq!(known, matches!(f, Function::Sin | Function::Cos), "{f:?}");
    }
    for f in Function2::ALL.iter().filter(|f| !matches!(f.name(), "Sum" | "Difference" | "Product"))
    {
        assert!(
            open.call2(*f, over(1.0, 2.0)).len() == 0 && over(1.0, 2.0).call2(*f, open).len() == 0,
            "{f:?}"
        );
    }
}
