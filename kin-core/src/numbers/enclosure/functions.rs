//! Evaluates functions on series, from the differential equation y′ = f′(x) x′ of each function
//! (Moore, ch. 11).
//!
//! Kin derives most functions from their rules in the list. Functions whose rules refer to one
//! another, or whose rules take several times as long, have hand-written code.

use kin_graph::{Function, Function2, Number, rules};

use super::interval::{Interval, ONE, ZERO};
use super::series::{ORDER, Series, Turns, UNKNOWN};

impl Series {
    /// Returns (sin x, cos x), from s′ = c x′, c′ = −s x′.
    pub(crate) fn sin_cos(self) -> (Series, Series) {
        // Whole turns do not change sine and cosine.
        self.pair(Function::Sin, Function::Cos, -ONE)
    }

    /// Returns (sinh x, cosh x), from s′ = c x′, c′ = s x′.
    fn hyperbolic(self) -> (Series, Series) {
        self.pair(Function::Sinh, Function::Cosh, ONE)
    }

    /// Returns the solution of s′ = c x′, c′ = `sign` s x′.
    fn pair(self, s: Function, c: Function, sign: Interval) -> (Series, Series) {
        let x = self;
        let len = self.len();
        let mut sines = [ZERO; ORDER + 1];
        let mut cosines = [ZERO; ORDER + 1];
        (sines[0], cosines[0]) = (x.value().call(s), x.value().call(c));
        for k in 1..len {
            (sines[k], cosines[k]) = (x.slope_times(&cosines, k), sign * x.slope_times(&sines, k));
        }
        (Series::of(&sines, len), Series::of(&cosines, len))
    }

    /// Returns eˣ with the bounds `value` of its values, from y′ = y x′.
    fn exponential(self, value: Interval) -> Series {
        Series::recurring(value, self.len(), |k, y| self.slope_times(y, k))
    }

    /// Returns f(x) with the bounds `value` of its values, from the rule for its slope. If the rule
    /// uses f(x) itself, the function computes one coefficient after the other.
    fn by_rule(self, f: Function, value: Interval) -> Series {
        let slope = rules::slope(f, self, UNKNOWN);
        if slope.is_constant() && slope.value() == ZERO {
            return Series::constant(value);
        }
        if slope.len() > 0 {
            return self.integral(value, &slope);
        }
        (2..=self.len()).fold(Series::of(&[value], 1), |y, len| {
            let slope = rules::slope(f, self.cut(len - 1), y);
            self.cut(len).integral(value, &slope)
        })
    }

    /// Returns xᵃ with the bounds `value` of its values, from x y′ = a y x′.
    fn power(self, value: Interval, a: Interval) -> Series {
        let x0 = self.value();
        let len = self.len();
        // At zero a power has values, but no derivatives.
        let len = if x0.contains(0.0) { len.min(1) } else { len };
        Series::recurring(value, len, |k, y| {
            let term = |j: usize| (a * whole(k - j) - whole(j)) * self.at(k - j) * y[j];
            (k.saturating_sub(self.degree())..k).map(term).fold(ZERO, |sum, term| sum + term)
                / (whole(k) * x0)
        })
    }

    /// Returns xⁿ.
    pub fn powi(self, n: i32) -> Series {
        match n.unsigned_abs() {
            _ if n < 0 => n.checked_neg().map_or(UNKNOWN, |n| self.powi(n).recip()),
            0 => Series::constant(ONE),
            n if n.is_multiple_of(2) => self.sqr().powi((n / 2) as i32),
            n => (self * self.powi((n - 1) as i32)).with_value(self.value().powi(n)),
        }
    }

    /// |x|; over 0 its slope is between that of −x and that of x.
    fn size(self) -> Series {
        let x = self.value();
        if x.lo() >= 0.0 {
            self
        } else if x.hi() <= 0.0 {
            -self
        } else {
            self.hull(&-self).with_value(x.abs()).cut(2)
        }
    }

    /// Returns a function that is constant between jumps.
    fn step(self, f: fn(f64) -> f64) -> Series {
        self.value().step(f).map_or(UNKNOWN, Series::constant)
    }

    /// Returns f of the series.
    pub(crate) fn call(self, f: Function) -> Series {
        let x = self;
        if x.is_open() && !matches!(f, Function::Sin | Function::Cos) {
            return UNKNOWN;
        }
        let value = x.value().call(f);
        let y = match f {
            Function::Sin => x.sin_cos().0,
            Function::Cos => x.sin_cos().1,
            Function::Sinh => x.hyperbolic().0,
            Function::Cosh => x.hyperbolic().1,
            Function::Exp => x.exponential(value),
            Function::Exp2 => (x * Series::logarithm_of(2.0)).exponential(value),
            Function::ExpM1 => x.exponential(x.value().call(Function::Exp)).with_value(value),
            Function::Sqrt => x.power(value, Interval::from(0.5)),
            Function::Cbrt => x.power(value, whole(1) / whole(3)),
            Function::Abs => x.size(),
            _ => x.by_rule(f, value),
        };
        y.as_result(x.is_constant())
    }

    /// Returns the result, with derivatives of 0 if the operands are constant.
    fn as_result(self, is_constant: bool) -> Series {
        match self.value().is_finite() {
            false => UNKNOWN,
            true if is_constant => Series::constant(self.value()).up_to(self.turns()),
            true => self,
        }
    }

    /// Returns f of this series and another one.
    pub(crate) fn call2(self, f: Function2, other: Series) -> Series {
        let a = self;
        let b = other;
        let y = match f {
            _ if a.is_open() || b.is_open() => UNKNOWN,
            Function2::Atan2 => a.atan2(b),
            Function2::Hypot => a.hypot(b),
            Function2::Powf => a.powf(b),
            Function2::Max => a.larger(b),
            Function2::Min => -(-a).larger(-b),
            Function2::Rem => a - b * (a / b).step(f64::trunc),
            Function2::DivEuclid => a.whole_quotient(b),
            _ => rules::definition_of_two(f, a, b).unwrap_or(UNKNOWN),
        };
        y.as_result(a.is_constant() && b.is_constant())
    }

    /// Returns the whole number n in a = n b + rest, 0 ≤ rest < |b|.
    fn whole_quotient(self, b: Series) -> Series {
        let quotient = self / b;
        if b.value().lo() > 0.0 { quotient.step(f64::floor) } else { quotient.step(f64::ceil) }
    }

    /// Returns the angle θ of (x, y), self being y, from θ′ = (x y′ − y x′)/(x² + y²). Across the
    /// negative x-axis the angle continues, and its bounds hold up to whole turns.
    fn atan2(self, x: Series) -> Series {
        let y = self;
        let (value, across) = y.value().atan2(x.value());
        if !value.is_finite() {
            return UNKNOWN;
        }
        let turns = if across { Turns::ONE } else { Turns::NONE };
        if x.is_constant() && y.is_constant() {
            return Series::constant(value).up_to(turns);
        }
        let r2 = x.sqr() + y.sqr();
        let along = y.integral(ZERO, &(x / r2));
        let across_slope = x.integral(ZERO, &(y / r2));
        (along - across_slope).with_value(value).up_to(turns)
    }

    fn hypot(self, other: Series) -> Series {
        if self.is_constant() && other.is_constant() {
            return Series::constant(self.value().hypot(other.value()));
        }
        (self.sqr() + other.sqr()).call(Function::Sqrt)
    }

    fn powf(self, a: Series) -> Series {
        if let Some(n) = a.as_number().filter(|n| n.fract() == 0.0 && n.abs() < 1e6) {
            return self.powi(n as i32);
        }
        if self.value().lo() <= 0.0 {
            return UNKNOWN;
        }
        match a.is_constant() {
            true => self.power(self.value().powf(a.value()), a.value()),
            false => (a * self.call(Function::Ln)).call(Function::Exp),
        }
    }

    /// Returns the larger of both; over a tie the slope lies between theirs.
    fn larger(self, other: Series) -> Series {
        let a = self.value();
        let b = other.value();
        if a.lo() >= b.hi() {
            self
        } else if b.lo() >= a.hi() {
            other
        } else {
            self.hull(&other)
                .with_value(Interval::new(a.lo().max(b.lo()), a.hi().max(b.hi())))
                .cut(2)
        }
    }
}

macro_rules! by_name {
    ($($(#[$doc:meta])* $name:ident = $function:ident;)*) => {
        impl Series {$(
            $(#[$doc])*
            #[must_use]
            pub fn $name(self) -> Series {
                self.call(Function::$function)
            }
        )*}
    };
}

by_name! {
    /// Returns sin x.
    sin = Sin;
    /// Returns cos x.
    cos = Cos;
    /// Returns tan x.
    tan = Tan;
    /// Returns arcsin x.
    asin = Asin;
    /// Returns arccos x.
    acos = Acos;
    /// Returns arctan x.
    atan = Atan;
    /// Returns sinh x.
    sinh = Sinh;
    /// Returns cosh x.
    cosh = Cosh;
    /// Returns tanh x.
    tanh = Tanh;
    /// Returns eˣ.
    exp = Exp;
    /// Returns ln x.
    ln = Ln;
    /// Returns √x.
    sqrt = Sqrt;
    /// Returns |x|.
    abs = Abs;
}

fn whole(k: usize) -> Interval {
    Interval::from(k as f64)
}
