//! Defines the numbers with which [`crate::evaluate`] can evaluate a graph.
//!
//! Each type of number implements the operations of the graph.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::{Comparison, Function, Function2};

/// A type of number with which Kin can evaluate an equation: f64, a number with derivatives, an
/// interval, a series, a vector of numbers.
pub trait Number:
    Clone
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    /// The result of comparing two such numbers.
    type Condition: Condition;

    /// The number that does not move.
    fn constant(x: f64) -> Self;

    /// A decimal beside the nearest f64, and whether it is above that.
    fn decimal(nearest: f64, above: bool) -> Self {
        let _ = above;
        Self::constant(nearest)
    }

    /// ln x of a constant, as well as it is known.
    fn logarithm_of(x: f64) -> Self {
        Self::constant(x.ln())
    }

    /// f(self)
    fn call(self, f: Function) -> Self;

    /// f(self, other)
    fn call2(self, f: Function2, other: Self) -> Self;

    /// selfⁿ
    fn powi(self, n: i32) -> Self;

    /// self · self, where it is known that both factors are the same number.
    fn squared(self) -> Self {
        self.clone() * self
    }

    /// self · other + c, rounded once where the number can.
    fn fma(self, other: Self, c: Self) -> Self {
        self * other + c
    }

    /// How both compare.
    fn compare(comparison: Comparison, a: &Self, b: &Self) -> Self::Condition;

    /// `a` where the condition holds, else `b`.
    fn select(condition: &Self::Condition, a: Self, b: Self) -> Self;

    /// 1 where the condition holds, else 0: as conditions are handed to the user's own functions.
    fn of_condition(condition: &Self::Condition) -> Self;

    /// The condition that it is not 0: as conditions come from the user's own functions.
    fn holds(&self) -> Self::Condition;
}

/// A condition that is true, false, or, for numbers that represent many values, undecided.
pub trait Condition: Clone {
    fn known(holds: bool) -> Self;
    fn and(self, other: Self) -> Self;
    fn or(self, other: Self) -> Self;
    fn negated(self) -> Self;
}

impl Condition for bool {
    fn known(holds: bool) -> Self {
        holds
    }

    fn and(self, other: Self) -> Self {
        self && other
    }

    fn or(self, other: Self) -> Self {
        self || other
    }

    fn negated(self) -> Self {
        !self
    }
}

/// A condition on numbers that represent many values: it may be true for some values and false for
/// others.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Possibly {
    /// True if the condition is false for all values.
    pub never: bool,
    /// True if the condition is true for all values.
    pub always: bool,
}

impl Condition for Possibly {
    fn known(holds: bool) -> Self {
        Possibly { never: !holds, always: holds }
    }

    fn and(self, other: Self) -> Self {
        Possibly { never: self.never || other.never, always: self.always && other.always }
    }

    fn or(self, other: Self) -> Self {
        Possibly { never: self.never && other.never, always: self.always || other.always }
    }

    fn negated(self) -> Self {
        Possibly { never: self.always, always: self.never }
    }
}

/// The operations on conditions of a [`Number`] that has one value, `$value`, by which it is
/// compared.
#[macro_export]
macro_rules! compared_by_value {
    ($value:expr) => {
        type Condition = bool;

        fn compare(comparison: $crate::Comparison, a: &Self, b: &Self) -> bool {
            let value: fn(&Self) -> f64 = $value;
            comparison.holds(&value(a), &value(b))
        }

        fn select(condition: &bool, a: Self, b: Self) -> Self {
            if *condition { a } else { b }
        }

        fn of_condition(condition: &bool) -> Self {
            <Self as $crate::Number>::constant(if *condition { 1.0 } else { 0.0 })
        }

        fn holds(&self) -> bool {
            let value: fn(&Self) -> f64 = $value;
            value(self) != 0.0
        }
    };
}

impl Number for f64 {
    compared_by_value!(|x| *x);

    fn constant(x: f64) -> Self {
        x
    }

    fn call(self, f: Function) -> Self {
        f.value()(self)
    }

    fn call2(self, f: Function2, other: Self) -> Self {
        f.value()(self, other)
    }

    fn powi(self, n: i32) -> Self {
        f64::powi(self, n)
    }

    fn fma(self, other: Self, c: Self) -> Self {
        self.mul_add(other, c)
    }
}
