//! Implements the functions of one variable in the list.
//!
//! The derivatives of most functions are hand-written; Kin derives the others from the rules of the
//! list.

use std::cmp::Ordering;
use std::f64::consts::{LN_2, LN_10};
use std::num::FpCategory;

use kin_graph::functions::{self, acosh, asinh, atanh};
use kin_graph::{Function, rules};

use super::{Dual, Dual2_64, Dual64, Growth, Real};

/// The target of both macros: a function written by hand below has precedence over the rule in
/// [`ByRule`]. The version by hand is faster or keeps more digits.
struct Composed;

/// Defines compositions from lines `name(x) = [f, f′, f″, f‴];`. For `chain_scaled`, which is for
/// functions that make large arguments small, the lines are `name(x) = [f, f′, f″/f′², f‴/f′³];`.
macro_rules! by_hand {
    ([$chain:ident] $($name:ident($x:ident) = $f:expr;)*) => {
        impl Composed {$(
            #[inline]
            fn $name<D: Dual>(u: D) -> D {
                let $x = u.value();
                u.$chain($f)
            }
        )*}
    };
}

/// Defines each function of the list as a method of numbers.
macro_rules! of_one {
    ($($(#[$doc:meta])* $variant:ident $method:ident $written:literal $entry:tt)*) => {
        /// The compositions by the rules of the list.
        // A function that is also written by hand does not call its rule.
        #[allow(dead_code)]
        trait ByRule {$(
            fn $method<D: Dual>(u: D) -> D {
                by_rule(Function::$variant, u)
            }
        )*}

        impl<D: Dual> Real<D> {$(
            $(#[$doc])*
            #[inline]
            pub fn $method(self) -> Self {
                const GROWTH: Option<Growth> = growth(Function::$variant);
                Real(Composed::$method(self.0)).noted(GROWTH)
            }
        )*}
    };
}

kin_graph::functions_of_one!(of_one);

impl ByRule for Composed {}

/// Returns f(u) from the rule for the slope of f: f″ is the slope of the rule along (u, y) = (x +
/// ε, f + f′ ε), f‴ its curvature along (x + ε, f + f′ ε + f″ ε²/2).
fn by_rule<D: Dual>(f: Function, u: D) -> D {
    let x = u.value();
    let value = f.value()(x);
    if u.is_constant() {
        return u.chain([value, 0.0, 0.0, 0.0]);
    }
    let first = rules::slope(f, Real(x), Real(value)).0;
    let bent = rules::slope(f, Real(Dual64::new(x, 1.0)), Real(Dual64::new(value, first)));
    if bent.is_constant() && first == 0.0 {
        return u.still().with_value(value); // constant between jumps
    }
    let second = bent.0.eps;
    let y = Dual2_64::new(value, first, second);
    let third = rules::slope(f, Real(Dual2_64::new(x, 1.0, 0.0)), Real(y)).0.v2;
    u.chain([value, first, second, third])
}

/// Returns the growth of the values of f, or `None` if the list records none.
const fn growth(f: Function) -> Option<Growth> {
    let facts = f.facts();
    match facts.growth {
        functions::Growth::Bounded => Some(Growth::Bounded),
        functions::Growth::Logarithmic => Some(Growth::Logarithmic),
        functions::Growth::Bursting => Some(Growth::Bursting),
        functions::Growth::Ordinary if facts.poles.is_empty() => None,
        functions::Growth::Ordinary => Some(Growth::Pole),
    }
}

/// Defines methods that test the real part.
macro_rules! questions {
    ($($(#[$doc:meta])* $name:ident;)*) => {
        impl<D: Dual> Real<D> {$(
            $(#[$doc])*
            #[inline]
            pub fn $name(self) -> bool {
                self.value().$name()
            }
        )*}
    };
}

by_hand! {
    [chain]
    sin(x) = { let (s, c) = x.sin_cos(); [s, c, -s, -c] };
    cos(x) = { let (s, c) = x.sin_cos(); [c, -s, -c, s] };
    tanh(x) = { let (t, d) = (x.tanh(), x.cosh().powi(-2)); [t, d, -2.0 * t * d, d * (4.0 - 6.0 * d)] };
    atan(x) = { let [d, dd, ddd] = atan_slopes(x); [x.atan(), d, dd, ddd] };
    asin(x) = { let [d, dd, ddd] = arc_slopes(x); [x.asin(), d, dd, ddd] };
    acos(x) = { let [d, dd, ddd] = arc_slopes(x); [x.acos(), -d, -dd, -ddd] };
    sinh(x) = { let (s, c) = (x.sinh(), x.cosh()); [s, c, s, c] };
    cosh(x) = { let (s, c) = (x.sinh(), x.cosh()); [c, s, c, s] };
    exp(x) = [x.exp(); 4];
    exp2(x) = { let p = x.exp2(); [p, p * LN_2, p * (LN_2 * LN_2), p * (LN_2 * LN_2 * LN_2)] };
    exp_m1(x) = { let p = x.exp(); [x.exp_m1(), p, p, p] };
    tan(x) = { let t = x.tan(); let d = 1.0 + t * t; [t, d, 2.0 * t * d, d * (2.0 + 6.0 * t * t)] };
    atanh(x) = { let d = ((1.0 - x) * (1.0 + x)).recip(); [atanh(x), d, 2.0 * x * d * d, (6.0 * x * x + 2.0) * d * d * d] };
    abs(x) = [x.abs(), if x >= 0.0 { 1.0 } else { -1.0 }, 0.0, 0.0];
}

by_hand! {
    [chain_scaled]
    asinh(x) = { let d = x.hypot(1.0).recip(); [asinh(x), d, -x * d, 2.0 - 3.0 * d * d] };
    acosh(x) = { let d = ((x - 1.0).sqrt() * (x + 1.0).sqrt()).recip(); [acosh(x), d, -x * d, 2.0 + 3.0 * d * d] };
    ln(x) = [x.ln(), x.recip(), -1.0, 2.0];
    ln_1p(x) = [x.ln_1p(), (1.0 + x).recip(), -1.0, 2.0];
    log2(x) = [x.log2(), (x * LN_2).recip(), -LN_2, 2.0 * LN_2 * LN_2];
    log10(x) = [x.log10(), (x * LN_10).recip(), -LN_10, 2.0 * LN_10 * LN_10];
    sqrt(x) = { let s = x.sqrt(); let r = s.recip(); [s, 0.5 * r, -r, 3.0 * r * r] };
    cbrt(x) = { let c = x.cbrt(); let r = c.recip(); [c, r * r / 3.0, -2.0 * r, 10.0 * r * r] };
}

questions! {
    /// Returns true if the real part is finite.
    is_finite;
    /// Returns true if the real part is ±∞.
    is_infinite;
    /// Returns true if the real part is NaN.
    is_nan;
    /// Returns true if the real part has a minus sign, −0 included.
    is_sign_negative;
    /// Returns true if the real part has no minus sign, +0 included.
    is_sign_positive;
    /// Returns true if the real part is neither 0, subnormal, infinite nor NaN.
    is_normal;
    /// Returns true if the real part is subnormal.
    is_subnormal;
}

impl<D: Dual> Real<D> {
    /// Converts degrees to radians: π/180 x.
    #[inline]
    pub fn to_radians(self) -> Self {
        self.chain([self.value().to_radians(), 1f64.to_radians(), 0.0, 0.0])
    }

    /// Converts radians to degrees: 180/π x.
    #[inline]
    pub fn to_degrees(self) -> Self {
        self.chain([self.value().to_degrees(), 1f64.to_degrees(), 0.0, 0.0])
    }

    /// Rounds to the nearest whole number, and a half to the even neighbour. The slope is 0.
    #[inline]
    pub fn round_ties_even(self) -> Self {
        Real(self.0.still()).with_value(self.value().round_ties_even())
    }

    /// Compares the real parts in the total order of f64, which orders NaN and distinguishes −0
    /// from +0.
    #[inline]
    pub fn total_cmp(&self, other: &Self) -> Ordering {
        self.value().total_cmp(&other.value())
    }

    /// Returns the category of the real part, such as normal, zero or infinite.
    #[inline]
    pub fn classify(self) -> FpCategory {
        self.value().classify()
    }

    /// Returns (sin x, cos x), with x in rad.
    #[inline]
    pub fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value().sin_cos();
        (
            self.chain([s, c, -s, -c]).growing(Growth::Bounded),
            self.chain([c, -s, -c, s]).growing(Growth::Bounded),
        )
    }

    /// Returns 1/x; the value at 0 is ±∞.
    #[inline]
    pub fn recip(self) -> Self {
        (Self::constant(1.0) / self).with_value(self.value().recip())
    }

    /// Returns xⁿ.
    ///
    /// x⁰ is 1 everywhere, x¹ has slope 1 at 0, and a negative power is infinite at 0.
    #[inline]
    pub fn powi(self, n: i32) -> Self {
        let x = self.value();
        let c = f64::from(n);
        if n < 0 {
            return self.power(x.powi(n), c);
        }
        let slope = |k: i32, factor: f64| {
            if factor == 0.0 { 0.0 } else { factor * x.powi(n.saturating_sub(k)) }
        };
        self.chain([
            x.powi(n),
            slope(1, c),
            slope(2, c * (c - 1.0)),
            slope(3, c * (c - 1.0) * (c - 2.0)),
        ])
        .growing_as_power(c)
    }

    /// Returns the number with the growth of an n-th power.
    #[inline]
    pub(super) fn growing_as_power(self, n: f64) -> Self {
        match (n < 0.0, n.abs() > 4.0) {
            (true, true) => self.growing(Growth::BurstingPole),
            (true, false) => self.growing(Growth::Pole),
            (false, true) => self.growing(Growth::Bursting),
            (false, false) => self,
        }
    }

    #[inline]
    fn growing(self, growth: Growth) -> Self {
        Real(self.0.growing(growth))
    }

    #[inline]
    fn noted(self, growth: Option<Growth>) -> Self {
        growth.map_or(self, |growth| self.growing(growth))
    }

    /// Returns xⁿ, whose value is y, as y (x/x₀)ⁿ about x₀ = x. No intermediate power of x
    /// overflows or underflows.
    pub(super) fn power(self, y: f64, n: f64) -> Self {
        let x = self.value();
        let slopes = [n, n * (n - 1.0), n * (n - 1.0) * (n - 2.0)];
        let power = if x == 0.0 || !x.is_finite() {
            self.chain([y, slopes[0] * y / x, slopes[1] * y / x / x, slopes[2] * y / x / x / x])
        } else {
            ((self / x).chain([1.0, slopes[0], slopes[1], slopes[2]]) * y).with_value(y)
        };
        power.growing_as_power(n)
    }
}

/// Returns three derivatives of arcsin: (1 − x²)^(−1/2), x (…)^(−3/2), (1 + 2x²) (…)^(−5/2).
#[inline]
fn arc_slopes(x: f64) -> [f64; 3] {
    let w = (1.0 - x) * (1.0 + x);
    let d = w.sqrt().recip();
    [d, x * d / w, (1.0 + 2.0 * x * x) * d / (w * w)]
}

/// Returns three derivatives of arctan, finite for every x: w = 1/(1 + x²), −2 (x w) w, (6 − 8w)
/// w².
#[inline]
pub(super) fn atan_slopes(x: f64) -> [f64; 3] {
    let w = (1.0 + x * x).recip();
    [w, -2.0 * (x * w) * w, (6.0 - 8.0 * w) * w * w]
}

#[cfg(test)]
mod tests {
    use crate::numbers::real::{Dual3_64, Dual64};

    use super::*;

    fn at(f: fn(Real<Dual64>) -> Real<Dual64>, x: f64) -> (f64, f64) {
        let y = f(Real(Dual64::new(x, 1.0))).0;
        (y.re, y.eps)
    }

    #[test]
    fn edges() {
        assert_eq!(at(|x| x.abs(), -0.0), (0.0, 1.0));
        assert!(at(|x| x.abs(), -0.0).0.is_sign_positive());
        assert_eq!(at(|x| x.powi(0), 0.0), (1.0, 0.0));
        assert_eq!(at(|x| x.powi(1), 0.0), (0.0, 1.0));
        assert_eq!(at(|x| x.sqrt(), 0.0), (0.0, f64::INFINITY));
        assert_eq!(at(|x| x.cbrt(), 0.0), (0.0, f64::INFINITY));
        assert_eq!(at(|x| x.fract(), 2.0), (0.0, 1.0));
        assert!(at(|x| x.sqrt(), -1.0).0.is_nan() && at(|x| x.acosh(), 0.5).0.is_nan());
        assert_eq!(at(|x| x.atan(), 1e200).1, 0.0);
        let flat = Real(Dual3_64::new(1e200, 1.0, 1.0, 1.0)).atan().0;
        assert_eq!((flat.v1, flat.v2, flat.v3), (0.0, 0.0, 0.0));
        let square = Real(Dual3_64::new(0.0, 1.0, 0.0, 0.0)).powi(2).0;
        assert_eq!((square.v1, square.v2, square.v3), (0.0, 2.0, 0.0));
    }
}
