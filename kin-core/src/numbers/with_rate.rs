//! Adds a derivative with respect to time to numbers of any kind, by the rules of the list of
//! functions.
//!
//! A nested number has derivatives of higher order.

use std::ops::{Add, Div, Mul, Neg, Sub};

use kin_graph::{Comparison, Function, Function2, Number, rules};

/// A number with its derivative with respect to time; the rate is `None` for a number that does not
/// move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WithRate<N> {
    pub x: N,
    pub rate: Option<N>,
}

impl<N: Number> WithRate<N> {
    /// Returns f(self), from f and f′ at the number.
    pub(crate) fn chain(self, f: N, slope: impl FnOnce() -> N) -> Self {
        WithRate { x: f, rate: self.rate.map(|rate| slope() * rate) }
    }

    /// Returns x with the sum of two parts of the rate.
    fn with(x: N, parts: [Option<N>; 2]) -> Self {
        let [a, b] = parts;
        let rate = match (a, b) {
            (Some(a), Some(b)) => Some(a + b),
            (a, b) => a.or(b),
        };
        WithRate { x, rate }
    }
}

impl<N: Number> Neg for WithRate<N> {
    type Output = Self;

    fn neg(self) -> Self {
        WithRate { x: -self.x, rate: self.rate.map(|rate| -rate) }
    }
}

impl<N: Number> Add for WithRate<N> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        WithRate::with(self.x + other.x, [self.rate, other.rate])
    }
}

impl<N: Number> Sub for WithRate<N> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        WithRate::with(self.x - other.x, [self.rate, other.rate.map(|rate| -rate)])
    }
}

impl<N: Number> Mul for WithRate<N> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let parts = [
            self.rate.map(|rate| rate * other.x.clone()),
            other.rate.map(|rate| rate * self.x.clone()),
        ];
        WithRate::with(self.x * other.x, parts)
    }
}

fn product<N: Number>(a: N, b: N) -> N {
    a * b
}

impl<N: Number> Div for WithRate<N> {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let x = self.x / other.x.clone();
        let parts = [
            self.rate.map(|rate| rate / other.x.clone()),
            other.rate.map(|rate| -product(x.clone(), rate / other.x.clone())),
        ];
        WithRate::with(x, parts)
    }
}

impl<N: Number> Number for WithRate<N> {
    type Condition = N::Condition;

    fn constant(x: f64) -> Self {
        WithRate { x: N::constant(x), rate: None }
    }

    fn call(self, f: Function) -> Self {
        let x = self.x.clone().call(f);
        let at = self.x.clone();
        let value = x.clone();
        self.chain(x, || rules::slope(f, at, value))
    }

    fn call2(self, f: Function2, other: Self) -> Self {
        let x = self.x.clone().call2(f, other.x.clone());
        if self.rate.is_none() && other.rate.is_none() {
            return WithRate { x, rate: None };
        }
        let (by_self, by_other) = rules::slopes(f, self.x, other.x, x.clone());
        WithRate::with(
            x,
            [self.rate.map(|rate| by_self * rate), other.rate.map(|rate| by_other * rate)],
        )
    }

    fn powi(self, n: i32) -> Self {
        let x = self.x.clone().powi(n);
        let at = self.x.clone();
        match n {
            0 => WithRate { x, rate: None },
            _ => self.chain(x, || N::constant(f64::from(n)) * at.powi(n.saturating_sub(1))),
        }
    }

    fn compare(comparison: Comparison, a: &Self, b: &Self) -> Self::Condition {
        N::compare(comparison, &a.x, &b.x)
    }

    fn select(condition: &Self::Condition, a: Self, b: Self) -> Self {
        // A missing rate counts as zero if the other side moves.
        let rate = match (a.rate, b.rate) {
            (None, None) => None,
            (a, b) => {
                let some = |rate: Option<N>| rate.unwrap_or_else(|| N::constant(0.0));
                Some(N::select(condition, some(a), some(b)))
            }
        };
        WithRate { x: N::select(condition, a.x, b.x), rate }
    }

    fn of_condition(condition: &Self::Condition) -> Self {
        WithRate { x: N::of_condition(condition), rate: None }
    }

    fn holds(&self) -> Self::Condition {
        self.x.holds()
    }
}
