//! Implements functions of two numbers.
//!
//! The second argument is a [`Real`](super::Real) or an `f64`, as `impl Into<Real<D>>`.

use kin_graph::{Function2, rules};

use super::functions::atan_slopes;
use super::{Dual, Growth, Real};

/// Pairs composed by hand, which is faster or keeps more digits than the definitions of the list.
struct Composed;

impl Composed {
    fn atan2<D: Dual>(y: Real<D>, x: Real<D>) -> Real<D> {
        let angle = y.value().atan2(x.value());
        if y.is_constant() && x.is_constant() {
            return Real::constant(angle);
        }
        let flat = x.value().abs() >= y.value().abs();
        let ratio = if flat { y / x } else { -(x / y) };
        let [d, dd, ddd] = atan_slopes(ratio.value());
        Real(ratio.chain([angle, d, dd, ddd]).0.growing(Growth::Bounded))
    }

    fn hypot<D: Dual>(x: Real<D>, y: Real<D>) -> Real<D> {
        let length = x.value().hypot(y.value());
        if x.is_constant() && y.is_constant() {
            return Real::constant(length);
        }
        if length == 0.0 {
            return x.singular() + y.singular();
        }
        let (large, small) = if x.value().abs() >= y.value().abs() { (x, y) } else { (y, x) };
        let ratio = small / large;
        (large.abs() * (ratio * ratio + 1.0).sqrt()).with_value(length)
    }

    fn powf<D: Dual>(base: Real<D>, n: Real<D>) -> Real<D> {
        let x = base.value();
        let c = n.value();
        // At x = 0 the tangents of n drop out, as xⁿ ln x → 0; where they do not, at whole n, a
        // factor 0 meets 0⁻¹ and gives NaN. Falling powers, and those of large numbers: no lower
        // power is too small for a number.
        if n.is_constant() && (c < 0.0 || x.abs() > 1.0) {
            return base.power(x.powf(c), c);
        }
        if n.is_constant() || x == 0.0 && c > 0.0 {
            let slope = |k: f64, factor: f64| {
                if factor == 0.0 && n.is_constant() { 0.0 } else { factor * x.powf(c - k) }
            };
            let power = base.chain([
                x.powf(c),
                slope(1.0, c),
                slope(2.0, c * (c - 1.0)),
                slope(3.0, c * (c - 1.0) * (c - 2.0)),
            ]);
            return power.growing_as_power(c);
        }
        (n * base.ln()).chain([x.powf(c); 4]).growing_as_power(-5.0)
    }

    #[inline]
    fn max<D: Dual>(x: Real<D>, y: Real<D>) -> Real<D> {
        if x >= y || y.is_nan() { x } else { y }
    }

    #[inline]
    fn min<D: Dual>(x: Real<D>, y: Real<D>) -> Real<D> {
        if x <= y || y.is_nan() { x } else { y }
    }

    fn rem_euclid<D: Dual>(x: Real<D>, y: Real<D>) -> Real<D> {
        x.less_whole(y, x.value().rem_euclid(y.value()))
    }

    fn div_euclid<D: Dual>(x: Real<D>, y: Real<D>) -> Real<D> {
        Real::constant(x.value().div_euclid(y.value()))
    }
}

/// Each function of the list as a method of numbers; `%` is an operator.
macro_rules! of_two {
    ($($(#[$doc:meta])* $variant:ident $method:ident $written:literal $entry:tt)*) => {
        /// Compositions by the definitions of the list.
        // Those that are written by hand too are not called.
        #[allow(dead_code)]
        trait ByDefinition {$(
            fn $method<D: Dual>(x: Real<D>, y: Real<D>) -> Real<D> {
                by_definition(Function2::$variant, x, y)
            }
        )*}

        impl<D: Dual> Real<D> {
            $(of_two! { @ $method $(#[$doc])* })*
        }
    };
    (@ rem $($rest:tt)*) => {};
    (@ $method:ident $(#[$doc:meta])*) => {
        $(#[$doc])*
        #[inline]
        pub fn $method(self, other: impl Into<Self>) -> Self {
            Composed::$method(self, other.into())
        }
    };
}

kin_graph::functions_of_two!(of_two);

impl ByDefinition for Composed {}

/// f(x, y) by other functions, with f64's own value; of one that is neither defined nor written by
/// hand nothing but that value is known.
fn by_definition<D: Dual>(f: Function2, x: Real<D>, y: Real<D>) -> Real<D> {
    let value = f.value()(x.value(), y.value());
    if x.is_constant() && y.is_constant() {
        return Real::constant(value);
    }
    rules::definition_of_two(f, x, y).map_or(x.singular() + y.singular(), |z| z.with_value(value))
}

impl<D: Dual> Real<D> {
    /// Returns the logarithm of x to a base: ln x / ln base.
    pub fn log(self, base: impl Into<Self>) -> Self {
        self.ln() / base.into().ln()
    }

    /// Returns `self.max(low).min(high)`.
    ///
    /// The result is `self` if `self` equals an edge, NaN if `self` is NaN, and `high` if low >
    /// high.
    pub fn clamp(self, low: impl Into<Self>, high: impl Into<Self>) -> Self {
        if self.is_nan() { self } else { self.max(low).min(high) }
    }

    /// Returns self · a + b, with a value that is rounded once.
    pub fn mul_add(self, a: impl Into<Self>, b: impl Into<Self>) -> Self {
        let a = a.into();
        let b = b.into();
        (self * a + b).with_value(self.value().mul_add(a.value(), b.value()))
    }

    /// Returns |x| with the sign of `sign`, where −0 is negative.
    ///
    /// At x = ±0 the slope is the slope of the side x ≥ 0, as for [`Real::abs`].
    pub fn copysign(self, sign: impl Into<Self>) -> Self {
        let size = self.abs();
        if sign.into().is_sign_negative() { -size } else { size }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use crate::numbers::real::{Dual2_64, Dual3_64, Dual64, HyperDual64};

    use kin_graph::Number;

    use super::*;

    type First = Real<Dual64>;

    fn parts(x: First) -> (f64, f64) {
        (x.0.re, x.0.eps)
    }

    fn along(x: f64) -> First {
        Real(Dual64::new(x, 1.0))
    }

    fn third(x: f64) -> Real<Dual3_64> {
        Real(Dual3_64::new(x, 1.0, 0.0, 0.0))
    }

    #[test]
    fn a_pair_by_its_definition_is_the_one_by_hand() {
        let moving = |x: f64, v: f64| Real(Dual3_64::new(x, v, 0.25, -0.5));
        for (f, x, y) in [
            (Function2::Hypot, 0.75, -2.5),
            (Function2::Powf, 1.75, 0.6),
            (Function2::RemEuclid, 7.3, -2.0),
        ] {
            let x = moving(x, 1.0);
            let y = moving(y, -0.75);
            let by_hand = x.call2(f, y).0;
            let defined = by_definition(f, x, y).0;
            assert_eq!(by_hand.re, defined.re, "{f:?}");
            for (a, b) in
                [(by_hand.v1, defined.v1), (by_hand.v2, defined.v2), (by_hand.v3, defined.v3)]
            {
                assert!(
                    (a - b).abs() < 1e-13 * (1.0 + a.abs()),
                    "{f:?}: {a}, and {b} by its definition"
                );
            }
            assert_eq!(by_definition(f, Real(3.0), Real(2.0)).0, f.value()(3.0, 2.0));
        }
        assert!(
            by_definition(Function2::Max, along(1.0), along(2.0)).0.eps.is_nan(),
            "nothing is known of it"
        );
    }

    #[test]
    fn atan2_on_the_axes() {
        let zero = First::from(0.0);
        assert_eq!(parts(along(1.0).atan2(0.0)), (FRAC_PI_2, 0.0));
        assert_eq!(parts(First::from(2.0).atan2(along(0.0))), (FRAC_PI_2, -0.5));
        assert_eq!(parts(along(0.0).atan2(-2.0)), (PI, -0.5));
        assert_eq!(parts(along(-0.0).atan2(-2.0)), (-PI, -0.5));
        assert_eq!(parts(zero.atan2(0.0)), (0.0, 0.0));
        assert!(
            along(0.0).atan2(0.0).0.eps.is_nan() && along(0.0).atan2(along(0.0)).0.eps.is_nan()
        );
        // Around a circle at constant rate the angle has rate 1 and no second or mixed derivative.
        for k in 0..16 {
            let angle = FRAC_PI_2 / 4.0 * f64::from(k);
            let (s, c) = Real(Dual2_64::new(angle, 1.0, 0.0)).sin_cos();
            let back = s.atan2(c).0;
            assert!((back.v1 - 1.0).abs() < 1e-15 && back.v2.abs() < 1e-15);
            let (s, c) = Real(HyperDual64::new(angle, 1.0, 2.0, 0.0)).sin_cos();
            assert!(s.atan2(c).0.eps1eps2.abs() < 1e-15);
        }
    }

    #[test]
    fn hypot_near_and_far() {
        let near = along(3.0).hypot(4.0);
        assert!(near.value() == 5.0 && (near.0.eps - 0.6).abs() < 1e-15);
        assert_eq!(parts(along(0.0).hypot(-4.0)), (4.0, 0.0));
        assert_eq!(parts(First::from(0.0).hypot(0.0)), (0.0, 0.0));
        assert!(along(0.0).hypot(0.0).0.eps.is_nan());
        let far = along(3e200).hypot(4e200);
        assert!((far.value() - 5e200).abs() < 1e186 && (far.0.eps - 0.6).abs() < 1e-15);
        let bent = third(0.0).hypot(1.0).0;
        assert_eq!((bent.v1, bent.v2, bent.v3), (0.0, 1.0, 0.0));
    }

    #[test]
    fn powf_at_zero() {
        let x = third(0.0).powf(1.5).0;
        assert_eq!((x.re, x.v1, x.v2), (0.0, 0.0, f64::INFINITY));
        for (n, [re, v1, v2, v3]) in
            [(0.0, [1.0, 0.0, 0.0, 0.0]), (1.0, [0.0, 1.0, 0.0, 0.0]), (2.0, [0.0, 0.0, 2.0, 0.0])]
        {
            let x = third(0.0).powf(n).0;
            assert_eq!((x.re, x.v1, x.v2, x.v3), (re, v1, v2, v3));
        }
        assert_eq!(parts(along(0.0).powf(0.5)), (0.0, f64::INFINITY));
        assert_eq!(parts(along(-2.0).powf(3.0)), (-8.0, 12.0));
    }

    #[test]
    fn powf_of_a_variable_power() {
        assert_eq!(parts(along(0.0).powf(along(2.5))), (0.0, 0.0));
        assert_eq!(parts(First::from(0.0).powf(along(0.5))), (0.0, 0.0));
        let (value, slope) = parts(First::from(2.0).powf(along(3.0)));
        assert!(value == 8.0 && (slope - 8.0 * 2f64.ln()).abs() < 1e-15);
        assert!(
            !Real(Dual2_64::new(0.0, 1.0, 0.0))
                .powf(Real(Dual2_64::new(1.0, 1.0, 0.0)))
                .0
                .v2
                .is_finite()
        );
    }

    #[test]
    fn ties_take_self() {
        let a = Real(Dual64::new(1.0, 2.0));
        let b = Real(Dual64::new(1.0, 3.0));
        assert_eq!((a.max(b).0.eps, a.min(b).0.eps), (2.0, 2.0));
        assert_eq!((b.max(1.0).0.eps, b.min(1.0).0.eps, b.clamp(1.0, 1.0).0.eps), (3.0, 3.0, 3.0));
        assert_eq!(parts(a.max(f64::NAN)), (1.0, 2.0));
        assert_eq!(parts(First::from(f64::NAN).min(b)), (1.0, 3.0));
        assert!(First::from(f64::NAN).clamp(0.0, 1.0).is_nan());
        assert_eq!(parts(a.clamp(5.0, 3.0)), (3.0, 0.0));
    }

    #[test]
    fn remainders_signs_and_logarithms() {
        assert_eq!(parts(along(-7.0).rem_euclid(3.0)), (2.0, 1.0));
        assert_eq!(parts(First::from(-7.0).rem_euclid(along(3.0))), (2.0, 3.0));
        assert_eq!(parts(along(-7.0).div_euclid(3.0)), (-3.0, 0.0));
        assert_eq!(parts(along(2.0).copysign(-0.0)), (-2.0, -1.0));
        assert_eq!(parts(along(2.0).mul_add(3.0, along(1.0))), (7.0, 4.0));
        assert_eq!(along(8.0).log(2.0).value().to_bits(), 8f64.log(2.0).to_bits());
        assert!((First::from(8.0).log(along(2.0)).0.eps + 1.5 / 2f64.ln()).abs() < 1e-15);
    }
}
