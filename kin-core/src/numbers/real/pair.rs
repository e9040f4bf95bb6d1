//! Functions of two numbers. The second is a number or an `f64`, as `impl Into<Real<D>>`.

use super::functions::atan_slopes;
use super::{Dual, Growth, Real};

impl<D: Dual> Real<D> {
    /// The angle of the point (x, y) = (`x`, `self`) in (−π, π] rad, right on both axes; singular at (0, 0)
    /// unless both are constant.
    pub fn atan2(self, x: impl Into<Self>) -> Self {
        let (y, x) = (self, x.into());
        let angle = y.value().atan2(x.value());
        if y.is_constant() && x.is_constant() {
            return Self::constant(angle);
        }
        let flat = x.value().abs() >= y.value().abs();
        let ratio = if flat { y / x } else { -(x / y) };
        let [d, dd, ddd] = atan_slopes(ratio.value());
        Real(ratio.chain([angle, d, dd, ddd]).0.growing(Growth::Bounded))
    }

    /// √(x² + y²) without overflow; singular at (0, 0) unless both are constant.
    pub fn hypot(self, y: impl Into<Self>) -> Self {
        let (x, y) = (self, y.into());
        let length = x.value().hypot(y.value());
        if x.is_constant() && y.is_constant() {
            return Self::constant(length);
        }
        if length == 0.0 {
            return x.singular() + y.singular();
        }
        let (large, small) = if x.value().abs() >= y.value().abs() { (x, y) } else { (y, x) };
        let ratio = small / large;
        (large.abs() * (ratio * ratio + 1.0).sqrt()).with_value(length)
    }

    /// xⁿ. A constant n has slopes n xⁿ⁻¹, n (n − 1) xⁿ⁻², …, infinite at x = 0 where the power left is
    /// negative and its factor is not 0. A variable n needs x > 0, or x = 0 and n > 0.
    pub fn powf(self, n: impl Into<Self>) -> Self {
        let n = n.into();
        let (x, c) = (self.value(), n.value());
        // At x = 0 the tangents of n drop out, as xⁿ ln x → 0; where they do not, at whole n, a factor 0
        // meets 0⁻¹ and gives NaN. Falling powers, and those of large numbers: no lower power is too small
        // for a number.
        if n.is_constant() && (c < 0.0 || x.abs() > 1.0) {
            return self.power(x.powf(c), c);
        }
        if n.is_constant() || x == 0.0 && c > 0.0 {
            let slope = |k: f64, factor: f64| {
                if factor == 0.0 && n.is_constant() { 0.0 } else { factor * x.powf(c - k) }
            };
            let power = self.chain([
                x.powf(c),
                slope(1.0, c),
                slope(2.0, c * (c - 1.0)),
                slope(3.0, c * (c - 1.0) * (c - 2.0)),
            ]);
            return power.growing_as_power(c);
        }
        (n * self.ln()).chain([x.powf(c); 4]).growing_as_power(-5.0)
    }

    /// Logarithm of x to a base: ln x / ln base.
    pub fn log(self, base: impl Into<Self>) -> Self {
        self.ln() / base.into().ln()
    }

    /// The larger one; of two equal ones `self`; of a number and NaN the number.
    pub fn max(self, other: impl Into<Self>) -> Self {
        let other = other.into();
        if self >= other || other.is_nan() { self } else { other }
    }

    /// The smaller one; of two equal ones `self`; of a number and NaN the number.
    pub fn min(self, other: impl Into<Self>) -> Self {
        let other = other.into();
        if self <= other || other.is_nan() { self } else { other }
    }

    /// `self.max(low).min(high)`: `self` on both edges, NaN for NaN, `high` where low > high.
    pub fn clamp(self, low: impl Into<Self>, high: impl Into<Self>) -> Self {
        if self.is_nan() { self } else { self.max(low).min(high) }
    }

    /// self · a + b, the value rounded once.
    pub fn mul_add(self, a: impl Into<Self>, b: impl Into<Self>) -> Self {
        let (a, b) = (a.into(), b.into());
        (self * a + b).with_value(self.value().mul_add(a.value(), b.value()))
    }

    /// x − n y ≥ 0 with a whole number n, constant between jumps.
    pub fn rem_euclid(self, y: impl Into<Self>) -> Self {
        let y = y.into();
        self.less_whole(y, self.value().rem_euclid(y.value()))
    }

    /// The whole number n of [`rem_euclid`](Self::rem_euclid); slope 0.
    pub fn div_euclid(self, y: impl Into<Self>) -> Self {
        Self::constant(self.value().div_euclid(y.into().value()))
    }

    /// |x| with the sign of `sign`, −0 being negative there; at x = ±0 the slope is that of the side x ≥ 0, as for [`Real::abs`].
    pub fn copysign(self, sign: impl Into<Self>) -> Self {
        let size = self.abs();
        if sign.into().is_sign_negative() { -size } else { size }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use crate::numbers::real::{Dual2_64, Dual3_64, Dual64, HyperDual64};

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
    fn atan2_on_the_axes() {
        let zero = First::from(0.0);
        assert_eq!(parts(along(1.0).atan2(0.0)), (FRAC_PI_2, 0.0));
        assert_eq!(parts(First::from(2.0).atan2(along(0.0))), (FRAC_PI_2, -0.5));
        assert_eq!(parts(along(0.0).atan2(-2.0)), (PI, -0.5));
        assert_eq!(parts(along(-0.0).atan2(-2.0)), (-PI, -0.5));
        assert_eq!(parts(zero.atan2(0.0)), (0.0, 0.0));
        assert!(along(0.0).atan2(0.0).0.eps.is_nan() && along(0.0).atan2(along(0.0)).0.eps.is_nan());
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
            !Real(Dual2_64::new(0.0, 1.0, 0.0)).powf(Real(Dual2_64::new(1.0, 1.0, 0.0))).0.v2.is_finite()
        );
    }

    #[test]
    fn ties_take_self() {
        let (a, b) = (Real(Dual64::new(1.0, 2.0)), Real(Dual64::new(1.0, 3.0)));
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
