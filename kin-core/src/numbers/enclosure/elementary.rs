//! The elementary functions over an interval. Where a function has no value for some of the numbers, nothing
//! is known ([`ALL`]).

use kin_graph::functions::{acosh, atanh};

use super::interval::{ALL, ALLOWED, Interval, ONE, PI, UNIT, down};

/// Of angles larger than this sine, cosine and tangent are allowed an error that is so many times as large:
/// glibc takes so many turns off them that its cosine of 5.3e255, which is 4.7e-19, is off by 7 units in the
/// last place; no f64 is nearer to a multiple of a quarter turn.   \[rad\]
pub(crate) const LARGE: f64 = 1e5;
pub(crate) const MORE: f64 = 8.0;

/// A bound below the function whose computed value is y.
fn below(y: f64) -> f64 {
    below_by(y, ALLOWED)
}

/// A bound above it.
fn above(y: f64) -> f64 {
    -below(-y)
}

fn below_by(y: f64, allowed: f64) -> f64 {
    down(y - allowed * f64::EPSILON * y.abs() - f64::MIN_POSITIVE)
}

impl Interval {
    /// An increasing function; nothing is known beyond the numbers that it is defined for, where f gives
    /// none.
    fn rising(self, f: fn(f64) -> f64) -> Self {
        Interval::new(below(f(self.lo())), above(f(self.hi())))
    }

    /// f over it, f being sin or cos, whose largest values stand at `peak` + 4k quarters of a turn.
    fn wave(self, f: fn(f64) -> f64, peak: f64) -> Self {
        if !self.is_finite() {
            return UNIT;
        }
        // as wide as the quarters are known: of large numbers everything is among them
        let quarters = self / (PI * Interval::from(0.5));
        // whether a number peak + 4k is among the quarters
        let has = |peak: f64| ((quarters.lo() - peak) / 4.0).ceil() <= (quarters.hi() - peak) / 4.0;
        let (a, b, allowed) = (f(self.lo()), f(self.hi()), self.allowed_of_angles());
        let hi = if has(peak) { 1.0 } else { (-below_by(-a.max(b), allowed)).min(1.0) };
        let lo = if has(peak + 2.0) { -1.0 } else { below_by(a.min(b), allowed).max(-1.0) };
        Interval::new(lo, hi)
    }

    pub(crate) fn sin(self) -> Self {
        self.wave(f64::sin, 1.0)
    }

    pub(crate) fn cos(self) -> Self {
        self.wave(f64::cos, 0.0)
    }

    pub(crate) fn tan(self) -> Self {
        let quarters = self / (PI * Interval::from(0.5));
        let has_pole = ((quarters.lo() - 1.0) / 2.0).ceil() <= (quarters.hi() - 1.0) / 2.0;
        if has_pole {
            return ALL;
        }
        let allowed = self.allowed_of_angles();
        Interval::new(below_by(self.lo().tan(), allowed), -below_by(-self.hi().tan(), allowed))
    }

    fn allowed_of_angles(self) -> f64 {
        if self.mag() > LARGE { MORE * ALLOWED } else { ALLOWED }
    }

    pub(crate) fn asin(self) -> Self {
        self.rising(f64::asin)
    }

    pub(crate) fn acos(self) -> Self {
        (-self).rising(|x| (-x).acos())
    }

    pub(crate) fn atan(self) -> Self {
        self.rising(f64::atan)
    }

    pub(crate) fn sinh(self) -> Self {
        self.rising(f64::sinh)
    }

    pub(crate) fn cosh(self) -> Self {
        let size = self.abs().rising(f64::cosh);
        size.common(Interval::new(1.0, f64::INFINITY)).unwrap_or(ALL)
    }

    pub(crate) fn tanh(self) -> Self {
        self.rising(f64::tanh)
    }

    pub(crate) fn asinh(self) -> Self {
        self.rising(f64::asinh)
    }

    pub(crate) fn acosh(self) -> Self {
        self.rising(acosh)
    }

    pub(crate) fn atanh(self) -> Self {
        self.rising(atanh)
    }

    pub(crate) fn exp(self) -> Self {
        let y = self.rising(f64::exp);
        Interval::new(y.lo().max(0.0), y.hi())
    }

    pub(crate) fn exp_m1(self) -> Self {
        self.rising(f64::exp_m1)
    }

    pub(crate) fn ln(self) -> Self {
        self.rising(f64::ln)
    }

    pub(crate) fn ln_1p(self) -> Self {
        self.rising(f64::ln_1p)
    }

    pub(crate) fn cbrt(self) -> Self {
        self.rising(f64::cbrt)
    }

    /// xᵃ for x > 0.
    pub(crate) fn powf(self, a: Self) -> Self {
        if self.lo() > 0.0 { (a * self.ln()).exp() } else { ALL }
    }

    /// √(x² + y²)
    pub(crate) fn hypot(self, other: Self) -> Self {
        (self.sqr() + other.sqr()).sqrt()
    }

    /// The angle of (x, y), self being y, over a box without the origin. Over one that reaches across the
    /// negative x-axis angles go on beyond π and the second result is true: those of points below the axis
    /// are a whole turn less.
    pub(crate) fn atan2(self, x: Self) -> (Self, bool) {
        let y = self;
        if x.contains(0.0) && y.contains(0.0) {
            return (ALL, false);
        }
        let cut = x.hi() < 0.0 && y.lo() < 0.0 && y.hi() >= 0.0;
        // turned by half a turn the box is on the right, where no cut is
        let angle = |y: f64, x: f64| if cut { (-y).atan2(-x) } else { y.atan2(x) };
        // a zero y below the axis belongs to it: its sign says nothing
        let corner = |y: f64, x: f64| angle(if y == 0.0 { 0.0 } else { y }, x);
        let all =
            [corner(y.lo(), x.lo()), corner(y.lo(), x.hi()), corner(y.hi(), x.lo()), corner(y.hi(), x.hi())];
        let (lo, hi) =
            all.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), a| (lo.min(a), hi.max(a)));
        let around = Interval::new(below(lo), above(hi));
        (if cut { around + PI } else { around }, cut)
    }

    /// f over it, f being constant between jumps; `None` where it jumps.
    pub(crate) fn step(self, f: fn(f64) -> f64) -> Option<Self> {
        let (a, b) = (f(self.lo()), f(self.hi()));
        (a == b).then(|| Interval::from(a))
    }

    /// xⁿ
    pub(crate) fn powi(self, n: u32) -> Self {
        match n {
            0 => ONE,
            1 => self,
            _ if n.is_multiple_of(2) => self.sqr().powi(n / 2),
            _ if !self.is_finite() => ALL,
            _ if self.lo() >= 0.0 => self * self.powi(n - 1),
            _ if self.hi() <= 0.0 => -(-self).powi(n),
            _ => {
                Interval::new(Interval::from(self.lo()).powi(n).lo(), Interval::from(self.hi()).powi(n).hi())
            }
        }
    }
}
