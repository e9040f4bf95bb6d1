//! Functions of one variable: each line a value and three exact derivatives.

use std::f64::consts::{LN_2, LN_10};

use kin_graph::functions::{acosh, atanh};

use super::{Dual, Real};

/// Methods from lines `name(x) = [f, f′, f″, f‴];`.
macro_rules! functions {
    ($($(#[$doc:meta])* $name:ident($x:ident) = $f:expr;)*) => {
        impl<D: Dual> Real<D> {$(
            $(#[$doc])*
            #[inline]
            pub fn $name(self) -> Self {
                let $x = self.value();
                self.chain($f)
            }
        )*}
    };
}

/// Methods that are constant between jumps.
macro_rules! steps {
    ($($(#[$doc:meta])* $name:ident;)*) => {
        impl<D: Dual> Real<D> {$(
            $(#[$doc])*
            #[inline]
            pub fn $name(self) -> Self {
                Real(self.0.still()).with_value(self.value().$name())
            }
        )*}
    };
}

/// Methods that ask about the real part.
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

functions! {
    /// sin x, x in rad.
    sin(x) = { let (s, c) = x.sin_cos(); [s, c, -s, -c] };
    /// cos x, x in rad.
    cos(x) = { let (s, c) = x.sin_cos(); [c, -s, -c, s] };
    /// tan x, x in rad.
    tan(x) = { let t = x.tan(); let d = 1.0 + t * t; [t, d, 2.0 * t * d, d * (2.0 + 6.0 * t * t)] };
    /// arcsin x in \[−π/2, π/2\] rad; infinite slope at ±1, NaN beyond.
    asin(x) = { let [d, dd, ddd] = arc_slopes(x); [x.asin(), d, dd, ddd] };
    /// arccos x in \[0, π\] rad; infinite slope at ±1, NaN beyond.
    acos(x) = { let [d, dd, ddd] = arc_slopes(x); [x.acos(), -d, -dd, -ddd] };
    /// arctan x in (−π/2, π/2) rad.
    atan(x) = { let [d, dd, ddd] = atan_slopes(x); [x.atan(), d, dd, ddd] };
    /// sinh x.
    sinh(x) = { let (s, c) = (x.sinh(), x.cosh()); [s, c, s, c] };
    /// cosh x.
    cosh(x) = { let (s, c) = (x.sinh(), x.cosh()); [c, s, c, s] };
    /// tanh x.
    tanh(x) = { let (t, d) = (x.tanh(), x.cosh().powi(-2)); [t, d, -2.0 * t * d, d * (4.0 - 6.0 * d)] };
    /// arsinh x.
    asinh(x) = { let d = x.hypot(1.0).recip(); let d2 = d * d; [x.asinh(), d, -x * d * d2, d * d2 * (2.0 - 3.0 * d2)] };
    /// arcosh x ≥ 0; infinite slope at 1, NaN below.
    acosh(x) = {
        let d = ((x - 1.0).sqrt() * (x + 1.0).sqrt()).recip();
        let d2 = d * d;
        [acosh(x), d, -x * d * d2, d * d2 * (2.0 + 3.0 * d2)]
    };
    /// artanh x; infinite at ±1, NaN beyond.
    atanh(x) = { let d = ((1.0 - x) * (1.0 + x)).recip(); [atanh(x), d, 2.0 * x * d * d, (6.0 * x * x + 2.0) * d * d * d] };
    /// eˣ.
    exp(x) = [x.exp(); 4];
    /// 2ˣ.
    exp2(x) = { let p = x.exp2(); [p, p * LN_2, p * (LN_2 * LN_2), p * (LN_2 * LN_2 * LN_2)] };
    /// eˣ − 1, exact near 0.
    exp_m1(x) = { let p = x.exp(); [x.exp_m1(), p, p, p] };
    /// ln x; −∞ at 0, NaN below.
    ln(x) = { let r = x.recip(); [x.ln(), r, -r * r, 2.0 * r * r * r] };
    /// ln(1 + x), exact near 0; −∞ at −1, NaN below.
    ln_1p(x) = { let r = (1.0 + x).recip(); [x.ln_1p(), r, -r * r, 2.0 * r * r * r] };
    /// log₂ x; −∞ at 0, NaN below.
    log2(x) = { let (r, d) = (x.recip(), (x * LN_2).recip()); [x.log2(), d, -d * r, 2.0 * d * r * r] };
    /// log₁₀ x; −∞ at 0, NaN below.
    log10(x) = { let (r, d) = (x.recip(), (x * LN_10).recip()); [x.log10(), d, -d * r, 2.0 * d * r * r] };
    /// √x; infinite slope at 0 unless x is constant, NaN below.
    sqrt(x) = { let s = x.sqrt(); let d = 0.5 / s; let dd = -0.5 * d / x; [s, d, dd, -1.5 * dd / x] };
    /// ∛x of the sign of x; infinite slope at 0 unless x is constant.
    cbrt(x) = { let c = x.cbrt(); let d = (3.0 * c * c).recip(); let dd = -2.0 / 3.0 * d / x; [c, d, dd, -5.0 / 3.0 * dd / x] };
    /// 1/x; ±∞ at 0.
    recip(x) = { let r = x.recip(); let r2 = r * r; [r, -r2, 2.0 * r * r2, -6.0 * r2 * r2] };
    /// |x|; slope 1 at 0 and −0.
    abs(x) = [x.abs(), if x >= 0.0 { 1.0 } else { -1.0 }, 0.0, 0.0];
    /// x − trunc x, of the sign of x; slope 1.
    fract(x) = [x.fract(), 1.0, 0.0, 0.0];
    /// From degrees to radians: π/180 x.
    to_radians(x) = [x.to_radians(), 1f64.to_radians(), 0.0, 0.0];
    /// From radians to degrees: 180/π x.
    to_degrees(x) = [x.to_degrees(), 1f64.to_degrees(), 0.0, 0.0];
}

steps! {
    /// 1 for x ≥ +0, −1 for x ≤ −0, NaN for NaN; slope 0.
    signum;
    /// The largest whole number ≤ x; slope 0.
    floor;
    /// The smallest whole number ≥ x; slope 0.
    ceil;
    /// The nearest whole number, halves away from 0; slope 0.
    round;
    /// The whole part, towards 0; slope 0.
    trunc;
}

questions! {
    /// Whether the real part is finite.
    is_finite;
    /// Whether the real part is ±∞.
    is_infinite;
    /// Whether the real part is NaN.
    is_nan;
    /// Whether the real part has a minus sign, −0 included.
    is_sign_negative;
    /// Whether the real part has no minus sign, +0 included.
    is_sign_positive;
}

impl<D: Dual> Real<D> {
    /// (sin x, cos x), x in rad.
    #[inline]
    pub fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value().sin_cos();
        (self.chain([s, c, -s, -c]), self.chain([c, -s, -c, s]))
    }

    /// xⁿ; x⁰ = 1 everywhere, x¹ has slope 1 at 0, and a negative power is infinite at 0.
    #[inline]
    pub fn powi(self, n: i32) -> Self {
        let (x, c) = (self.value(), f64::from(n));
        let slope = |k: i32, factor: f64| if factor == 0.0 { 0.0 } else { factor * x.powi(n.saturating_sub(k)) };
        self.chain([x.powi(n), slope(1, c), slope(2, c * (c - 1.0)), slope(3, c * (c - 1.0) * (c - 2.0))])
    }
}

/// Three derivatives of arcsin: (1 − x²)^(−1/2), x (…)^(−3/2), (1 + 2x²) (…)^(−5/2).
#[inline]
fn arc_slopes(x: f64) -> [f64; 3] {
    let w = (1.0 - x) * (1.0 + x);
    let d = w.sqrt().recip();
    [d, x * d / w, (1.0 + 2.0 * x * x) * d / (w * w)]
}

/// Three derivatives of arctan: w = 1/(1 + x²), −2 x w², (6 − 8w) w², finite for every x.
#[inline]
pub(super) fn atan_slopes(x: f64) -> [f64; 3] {
    let w = (1.0 + x * x).recip();
    [w, -2.0 * x * w * w, (6.0 - 8.0 * w) * w * w]
}

#[cfg(test)]
mod tests {
    use num_dual::{Dual3_64, Dual64};

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
