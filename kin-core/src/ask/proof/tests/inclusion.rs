//! Every operation on intervals gives all that it can give: against error-free transformations,
//! against f64's functions at points inside, at the edges.

use kin_graph::{Function, Function2, Number};
use proptest::prelude::*;

use crate::ask::proof::bounds::taylor;
use crate::numbers::enclosure::interval::{ALL, Interval, ONE, UNIT, ZERO};
use crate::numbers::enclosure::series::{ORDER, Series, Turns};

/// Numbers of all sizes, some of them 0 or whole.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![4 => -4.0..4.0, 2 => -1e3..1e3, 1 => (-4_i32..5).prop_map(f64::from), 1 => (-1.0..1.0, -40_i32..40).prop_map(|(m, e)| m * 2_f64.powi(e))]
}

/// An interval, from a point to wide ones, and a number in it.
fn interval() -> impl Strategy<Value = (Interval, f64)> {
    (number(), prop_oneof![Just(0.0), Just(1e-12), 0.0..0.1_f64, 0.0..8.0_f64], 0.0..=1.0_f64)
        .prop_map(|(x, width, share)| {
            let lo = x;
            let hi = x + width;
            (Interval::new(lo, hi), f64::clamp(lo + share * width, lo, hi))
        })
}

/// True if `value + rest`, a number that f64 does not hold, is inside.
fn holds(bounds: Interval, value: f64, rest: f64) -> bool {
    (bounds.lo() - value) <= rest && (bounds.hi() - value) >= rest
}

/// The rounding error of a + b (Knuth).
fn lost(a: f64, b: f64) -> f64 {
    let s = a + b;
    let back = s - a;
    (a - (s - back)) + (b - back)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, rng_seed: proptest::test_runner::RngSeed::Fixed(11), ..ProptestConfig::default() })]

    #[test]
    fn arithmetic_holds_the_exact_result((x, a) in interval(), (y, b) in interval()) {
        prop_assert!(holds(x + y, a + b, lost(a, b)));
        prop_assert!(holds(x - y, a - b, lost(a, -b)));
        prop_assert!(holds(x * y, a * b, a.mul_add(b, -(a * b))));
        prop_assert!(holds(x.sqr(), a * a, a.mul_add(a, -(a * a))) && x.sqr().lo() >= 0.0);
        if b != 0.0 {
            let q = a / b;
            prop_assert!(holds(x / y, q, (-q).mul_add(b, a) / b));
        }
        if x.lo() > 0.0 {
            let s = a.sqrt();
            prop_assert!(holds(x.sqrt(), s, (-s).mul_add(s, a) / (2.0 * s)));
        }
        prop_assert!((-x).contains(-a) && x.abs().contains(a.abs()) && x.hull(y).contains(a) && x.hull(y).contains(b));
        prop_assert!(x.contains(x.mid()) && x.mag() >= a.abs());
    }

    /// Values, and the Taylor coefficients as far as dual numbers know them.
    #[test]
    fn functions_of_one_number((x, a) in interval()) {
        for &f in Function::ALL {
            let bounds = Series::variable(x, ONE, ORDER + 1).call(f);
            let exact = crate::numbers::real::Real(crate::numbers::real::Dual3_64::new(a, 1.0, 0.0, 0.0)).call(f).0;
            inside(&bounds, [exact.re, exact.v1, exact.v2, exact.v3], &format!("{f:?} of {x:?} at {a}"))?;
        }
        for n in [-3, -1, 0, 1, 2, 5, 8] {
            let exact = crate::numbers::real::Real(crate::numbers::real::Dual3_64::new(a, 1.0, 0.0, 0.0)).powi(n).0;
            let bounds = Series::variable(x, ONE, ORDER + 1).powi(n);
            inside(&bounds, [exact.re, exact.v1, exact.v2, exact.v3], &format!("power {n} of {x:?} at {a}"))?;
        }
    }

    /// By its coefficients in the middle and over all of the interval a function is bounded, one
    /// that rises hardly wider than by its values.
    #[test]
    fn taylor_has_its_remainder(middle in -3.0..3.0_f64, half in 0.01..0.4_f64, share in -1.0..1.0_f64) {
        for &f in Function::ALL {
            let along = |x: Interval| Series::variable(x, Interval::from(half), ORDER + 1).call(f);
            let at = along(Interval::from(middle));
            let over = along(Interval::new(middle - half, middle + half));
            let value = crate::numbers::real::Real(middle + share * half).call(f).0;
            let bounds = taylor(&at, &over);
            prop_assert!(!value.is_finite() || bounds.contains(value), "{f:?} at {middle} + {share} of {half}: {value} is not in {bounds:?}");
            if f == Function::Exp {
                prop_assert!(bounds.radius() < 1.2 * over.at(0).radius());
            }
        }
    }

    /// Along a line in both numbers.
    #[test]
    fn functions_of_two_numbers((x, a) in interval(), (y, b) in interval(), v in -1.0..1.0, w in -1.0..1.0) {
        for &f in Function2::ALL {
            let along = |x: Interval, v: f64| Series::variable(x, Interval::from(v), ORDER + 1);
            let mut bounds = along(x, v).call2(f, along(y, w));
            let dual = |a: f64, v: f64| crate::numbers::real::Real(crate::numbers::real::Dual3_64::new(a, v, 0.0, 0.0));
            let exact = dual(a, v).call2(f, dual(b, w)).0;
            if !bounds.turns().is_none() {
                // across the cut angles go on: those below it are a whole turn less
                prop_assert!(f == Function2::Atan2);
                let turned = exact.re + if exact.re < 0.0 { 2.0 * std::f64::consts::PI } else { 0.0 };
                inside(&bounds, [turned, exact.v1, exact.v2, exact.v3], &format!("{f:?} of {x:?} and {y:?} at {a}, {b}"))?;
                bounds = bounds.call(Function::Cos);
                prop_assert!(bounds.value().contains(exact.re.cos()));
                continue;
            }
            inside(&bounds, [exact.re, exact.v1, exact.v2, exact.v3], &format!("{f:?} of {x:?} and {y:?} at {a}, {b}"))?;
        }
    }

    /// Two ways to compute the same number give intervals that meet, and neither is much wider: so
    /// bounds are of the function itself and not of a neighbour.
    #[test]
    fn identities(a in 0.05..1.4_f64) {
        let x = Interval::from(a);
        let same = [
            (x.sin().sqr() + x.cos().sqr(), ONE),
            (x.sin() / x.cos(), x.tan()),
            (x.sin().asin(), x),
            (x.cos().acos(), x),
            (x.tan().atan(), x),
            (x.sin().atan2(x.cos()).0, x),
            (x.exp().ln(), x),
            (x.exp() - ONE, x.exp_m1()),
            ((x + ONE).ln(), x.ln_1p()),
            (x.cosh().sqr() - x.sinh().sqr(), ONE),
            (x.sinh() / x.cosh(), x.tanh()),
            (x.sinh().asinh(), x),
            (x.cosh().acosh(), x),
            (x.tanh().atanh(), x),
            (x.cbrt().powi(3), x),
            (x.sqrt().sqr(), x),
            (x.powf(Interval::from(1.5)).sqr(), x.powi(3)),
        ];
        for (k, (one, other)) in same.into_iter().enumerate() {
            prop_assert!(one.meets(other) && one.radius() < 1e-11 && other.radius() < 1e-11, "identity {k} at {a}: {one:?} {other:?}");
        }
    }
}

/// Value and derivatives, as far as both know them, f64's own rounding allowed for.
fn inside(bounds: &Series, exact: [f64; 4], what: &str) -> Result<(), TestCaseError> {
    for (k, (value, factorial)) in
        exact.into_iter().zip([1.0, 1.0, 2.0, 6.0]).enumerate().take(bounds.len())
    {
        let known = bounds.at(k) * Interval::from(factorial);
        if !value.is_finite() {
            break;
        }
        let slack = if k == 0 { 0.0 } else { 1e-11 * (known.mag() + value.abs()) };
        prop_assert!(
            value >= known.lo() - slack && value <= known.hi() + slack,
            "derivative {k} of {what}: {value} is not in {known:?}"
        );
    }
    Ok(())
}

/// Where a function has no value nothing is known; where it jumps, neither.
#[test]
fn edges() {
    let over = |lo: f64, hi: f64| Series::variable(Interval::new(lo, hi), ONE, ORDER + 1);
    let known = |f: Function, lo: f64, hi: f64| over(lo, hi).call(f).len();
    let full = ORDER + 1;
    assert_eq!(
        [
            known(Function::Sqrt, -0.1, 1.0),
            known(Function::Sqrt, 0.0, 1.0),
            known(Function::Sqrt, 0.1, 1.0)
        ],
        [0, 1, full]
    );
    assert_eq!(
        [
            known(Function::Ln, 0.0, 1.0),
            known(Function::Asin, 0.0, 1.1),
            known(Function::Acosh, 0.9, 2.0)
        ],
        [0, 0, 0]
    );
    assert_eq!(
        [
            known(Function::Tan, 1.5, 1.6),
            known(Function::Tan, 1.6, 4.7),
            known(Function::Tan, 1.6, 4.8)
        ],
        [0, full, 0]
    );
    assert_eq!(
        [
            known(Function::Floor, 0.9, 1.1),
            known(Function::Floor, 1.0, 1.9),
            known(Function::Signum, -0.1, 0.1)
        ],
        [0, full, 0]
    );
    assert_eq!(
        [
            known(Function::Abs, -0.1, 0.1),
            known(Function::Abs, 0.0, 0.1),
            known(Function::Cbrt, -0.1, 0.1)
        ],
        [2, full, 1]
    );
    assert_eq!(
        (ONE / Interval::new(-1.0, 1.0), ONE / Interval::new(0.0, 1.0), ONE / ZERO),
        (ALL, ALL, ALL)
    );
    assert_eq!((Series::constant(ONE) / over(-1.0, 1.0)).len(), 0);
    // √0, |0| of numbers that do not move are constants
    assert!(
        Series::constant(ZERO).call(Function::Sqrt).is_constant()
            && Series::constant(ZERO).call2(Function2::Hypot, Series::constant(ZERO)).is_constant()
    );
    let x = Interval::new(-2.0, -1.0);
    let y = Interval::new(-0.1, 0.1);
    let (angle, across) = y.atan2(x);
    assert!(across && angle.contains(std::f64::consts::PI) && angle.hi() < 3.3 && angle.lo() > 3.0);
    assert_eq!(y.atan2(Interval::new(-0.1, 0.1)).0, ALL);
    let straight = Interval::new(0.0, 0.1).atan2(x);
    assert!(!straight.1 && straight.0.contains(std::f64::consts::PI));
    // a whole turn, and more, has all values; half a turn one extreme
    assert_eq!(Interval::new(0.0, 7.0).sin(), UNIT);
    assert_eq!(Interval::new(1e300, 1e300).sin(), UNIT);
    assert!(
        Interval::new(0.0, 3.0).sin().hi() == 1.0 && Interval::new(0.0, 3.0).sin().lo() < 1e-15
    );
    assert!(
        Interval::new(-1.0, 1.0).cos().hi() == 1.0 && Interval::new(2.0, 4.0).cos().lo() == -1.0
    );
    assert_eq!(Interval::from(f64::NAN), ALL);
    assert_eq!((Interval::from(f64::INFINITY), ALL.powi(3), ALL.sin()), (ALL, ALL, UNIT));
    assert!((ALL + ONE).lo() == f64::NEG_INFINITY && ALL * ZERO == ZERO && (ALL - ALL) == ALL);
}

/// Of an angle known up to whole turns, multiples by whole numbers are known in the same way, and
/// its sine exactly; nothing else is known.
#[test]
fn angles_up_to_whole_turns() {
    let y = Series::variable(Interval::new(-0.01, 0.01), ONE, ORDER + 1);
    let angle = y.call2(Function2::Atan2, Series::constant(-ONE));
    assert_eq!(angle.turns(), Turns::ONE);
    let thrice = angle.plus(0.5).times(-3.0) + angle.times(6.0);
    assert_eq!(
        (angle.times(-3.0).turns(), thrice.turns()),
        (Turns { unit: 3, most: 3 }, Turns { unit: 3, most: 9 })
    );
    assert_eq!(
        (angle.times(0.5).len(), (angle * angle).len(), angle.times(0.0).turns()),
        (0, 0, Turns::NONE)
    );
    assert!(
        thrice.call(Function::Sin).len() > 1
            && thrice.call(Function::Exp).len() == 0
            && (angle / angle).len() == 0
    );
    assert!(angle.call2(Function2::Max, angle).len() == 0);
    let units = |n: f64, m: f64| (angle.times(n) + angle.times(m)).turns().unit;
    assert_eq!([units(6.0, 3.0), units(3.0, 6.0), units(4.0, 6.0), units(5.0, 3.0)], [3, 3, 2, 1]);
    // Only whole multiples of whole turns are whole turns, and those that are counted.
    let turns = |factor: f64| angle.times(3.0).times(factor).len();
    assert_eq!(
        [turns(1.5), turns(0.4), turns(1.0 / 3.0), turns(1e7), turns(2.0)],
        [0, 0, 0, 0, ORDER + 1]
    );
    let about = Series::constant(Interval::new(1.0, 3.0));
    assert_eq!(
        [(angle * about).len(), (about * angle).len(), (angle * (y + Series::number(2.0))).len()],
        [0; 3]
    );
    assert_eq!(
        [
            (Series::number(2.0) / angle).len(),
            (angle / Series::number(2.0)).len(),
            angle.chain(&[[0.0, 1.0]; 3]).len()
        ],
        [0; 3]
    );
    assert_eq!(angle.values(), [f64::NEG_INFINITY, f64::INFINITY]);
}
