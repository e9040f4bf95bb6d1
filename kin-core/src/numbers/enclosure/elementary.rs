//! Evaluates functions over an interval.
//!
//! If a function has no value for some numbers of the interval, the result is [`ALL`].

use kin_graph::Function;
use kin_graph::functions::{ALLOWED, Place};

use super::interval::{ALL, Interval, ONE, PI, down};

/// Returns a lower bound of a function value that is computed as y with an error of `error` units
/// in the last place. If y overflows, the bound is below the largest number.
fn below(y: f64, error: f64) -> f64 {
    let y = y.min(f64::MAX);
    if error == 0.0 { y } else { down(y - error * f64::EPSILON * y.abs() - f64::MIN_POSITIVE) }
}

/// Returns an upper bound of a function value that is computed as y with the same error.
fn above(y: f64, error: f64) -> f64 {
    -below(-y, error)
}

impl Interval {
    /// Returns f over the interval, from the facts in the list: the values at both ends and at the
    /// extrema between them.
    pub(crate) fn call(self, f: Function) -> Self {
        let facts = f.facts();
        let [from, to] = facts.domain;
        let jumps = facts.jumps.is_some_and(|steps| steps(self.lo()) != steps(self.hi()));
        // At a pole where the domain ends, f is infinite, and monotone up to the pole.
        let is_within = |pole: &&Place| ![Place::At(from), Place::At(to)].contains(pole);
        let has_pole = facts.poles.iter().filter(is_within).any(|pole| self.passes(*pole));
        if self.lo() < from || self.hi() > to || jumps || has_pole {
            return ALL;
        }
        if f == Function::Sqrt {
            return self.sqrt(); // an operation of IEEE 754
        }
        let error = (facts.error)(self.mag());
        let turns =
            facts.extrema.iter().filter(|(place, _)| self.passes(*place)).map(|(_, value)| *value);
        let bounds = [self.lo(), self.hi()].map(f.value()).into_iter().chain(turns).map(|y| {
            // If f has no limit at an end of the line, all values are possible.
            if y.is_nan() { ALL } else { Interval::new(below(y, error), above(y, error)) }
        });
        let [least, most] = facts.range;
        bounds
            .reduce(Interval::hull)
            .and_then(|bounds| bounds.common(Interval::new(least, most)))
            .unwrap_or(ALL)
    }

    /// Returns true if a place, or one of a sequence of places, lies in the interval.
    pub(crate) fn passes(self, place: Place) -> bool {
        match place {
            Place::At(x) => self.contains(x),
            Place::Quarters { first, every } => {
                // The quotient is as wide as the quarters are known: for large numbers it contains
                // every place.
                let quarters = self / (PI * Interval::from(0.5));
                ((quarters.lo() - first) / every).ceil() <= (quarters.hi() - first) / every
            }
        }
    }

    /// Returns xᵃ for x > 0.
    pub(crate) fn powf(self, a: Self) -> Self {
        if self.lo() > 0.0 { (a * self.call(Function::Ln)).call(Function::Exp) } else { ALL }
    }

    /// Returns √(x² + y²).
    pub(crate) fn hypot(self, other: Self) -> Self {
        (self.sqr() + other.sqr()).sqrt()
    }

    /// Returns the angle of (x, y), self being y, over a box without the origin.
    ///
    /// If the box reaches across the negative x-axis, the angles continue beyond π and the second
    /// result is true: the angle of a point below the axis is then too large by a whole turn.
    pub(crate) fn atan2(self, x: Self) -> (Self, bool) {
        let y = self;
        if x.contains(0.0) && y.contains(0.0) {
            return (ALL, false);
        }
        let cut = x.hi() < 0.0 && y.lo() < 0.0 && y.hi() >= 0.0;
        // A rotation by half a turn moves the box to the right, where there is no cut.
        let angle = |y: f64, x: f64| if cut { (-y).atan2(-x) } else { y.atan2(x) };
        // A zero y counts as a point on the axis; its sign is ignored.
        let corner = |y: f64, x: f64| angle(if y == 0.0 { 0.0 } else { y }, x);
        let all = [
            corner(y.lo(), x.lo()),
            corner(y.lo(), x.hi()),
            corner(y.hi(), x.lo()),
            corner(y.hi(), x.hi()),
        ];
        let (lo, hi) = all
            .into_iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), a| (lo.min(a), hi.max(a)));
        let around = Interval::new(below(lo, ALLOWED), above(hi, ALLOWED));
        (if cut { around + PI } else { around }, cut)
    }

    /// Returns f over the interval, for an f that is constant between jumps; returns `None` if f
    /// jumps in the interval.
    pub(crate) fn step(self, f: fn(f64) -> f64) -> Option<Self> {
        let a = f(self.lo());
        let b = f(self.hi());
        (a == b).then(|| Interval::from(a))
    }

    /// Returns xⁿ.
    pub(crate) fn powi(self, n: u32) -> Self {
        match n {
            0 => ONE,
            1 => self,
            _ if n.is_multiple_of(2) => self.sqr().powi(n / 2),
            _ if !self.is_finite() => ALL,
            _ if self.lo() >= 0.0 => self * self.powi(n - 1),
            _ if self.hi() <= 0.0 => -(-self).powi(n),
            _ => Interval::new(
                Interval::from(self.lo()).powi(n).lo(),
                Interval::from(self.hi()).powi(n).hi(),
            ),
        }
    }
}
