//! Defines second-order numbers that record where they ceased to be finite.
//!
//! Kin uses these numbers to evaluate an equation again after a failure.
//!
//! A number that is not finite carries the index of the *fault* that caused it. Kin records a fault
//! where an operation on finite numbers gives a number that is not finite. A fault belongs to the
//! innermost user expression that ends next ([`ended`], which `#[constraint]` emits).

use std::cell::RefCell;
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

use super::Dual2_64;
use super::dual::{Dual, Growth, sealed};

/// Faults that are kept: loops make no more of them.
const MOST_FAULTS: usize = 10_000;
/// How many coordinates are told apart; the last bit is that of the time.
pub(crate) const TIME: u32 = 63;

/// A number with two derivatives along one direction, and the origin of the number.
#[derive(Clone, Copy, Debug)]
pub struct Traced {
    number: Dual2_64,
    /// For value, first and second derivative: the number of the fault that made it, or one before
    /// it, not finite, counted from 1.
    faults: [u32; 3],
    /// The coordinates behind it, one bit each.
    inputs: u64,
}

/// An operation that made something not finite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fault {
    /// The expression that contains the operation.
    pub expression: Option<usize>,
    /// The index of the part that is not finite: 0 for the value, 1 for the first and 2 for the
    /// second derivative.
    pub part: usize,
    pub value: f64,
    pub operands: [Option<f64>; 2],
    pub inputs: u64,
}

thread_local! {
    static FAULTS: RefCell<Vec<Fault>> = const { RefCell::new(Vec::new()) };
}

/// Runs an equation; what `row` selects of its numbers, and the fault that made it not finite up to
/// derivative number `part`.
pub(crate) fn fault_of(part: usize, run: impl FnOnce() -> Option<Traced>) -> Option<Fault> {
    FAULTS.with_borrow_mut(Vec::clear);
    let number = run()?;
    let fault = number.faults.iter().take(part + 1).find(|fault| **fault != 0)?;
    FAULTS.with_borrow_mut(|faults| std::mem::take(faults).get(*fault as usize - 1).copied())
}

/// An expression has been computed: what faults are new belong to it.
pub(crate) fn ended(expression: usize) {
    FAULTS.with_borrow_mut(|faults| {
        let new = faults.iter_mut().rev().take_while(|fault| fault.expression.is_none());
        new.for_each(|fault| fault.expression = Some(expression));
    });
}

fn noted(fault: Fault) -> u32 {
    FAULTS.with_borrow_mut(|faults| {
        if faults.len() < MOST_FAULTS {
            faults.push(fault);
        }
        faults.len() as u32
    })
}

impl Traced {
    /// A coordinate (or the time) with its rate along the direction, if that moves it.
    pub(crate) fn input(value: f64, rate: Option<f64>, bit: u32) -> Self {
        let number = rate.map_or(Dual2_64::from_re(value), |rate| Dual2_64::new(value, rate, 0.0));
        Traced { number, faults: [0; 3], inputs: 1 << bit.min(TIME) }
    }

    /// The result of an operation.
    fn made(number: Dual2_64, operands: &[&Traced]) -> Self {
        let mut made = Traced {
            number,
            faults: [0; 3],
            inputs: operands.iter().fold(0, |all, operand| all | operand.inputs),
        };
        let mut known = 0;
        for (part, x) in [number.re, number.v1, number.v2].into_iter().enumerate() {
            if known == 0 && !x.is_finite() {
                known = operands
                    .iter()
                    .map(|operand| operand.faults[part])
                    .find(|fault| *fault != 0)
                    .unwrap_or_else(|| {
                        let value = |k: usize| operands.get(k).map(|operand| operand.number.re);
                        noted(Fault {
                            expression: None,
                            part,
                            value: number.re,
                            operands: [value(0), value(1)],
                            inputs: made.inputs,
                        })
                    });
            }
            made.faults[part] = known;
        }
        made
    }

    fn unary(self, number: Dual2_64) -> Self {
        Traced::made(number, &[&self])
    }

    fn binary(self, other: Self, number: Dual2_64) -> Self {
        Traced::made(number, &[&self, &other])
    }
}

impl sealed::Sealed for Traced {}

impl Dual for Traced {
    const TRACED: bool = true;

    fn value(&self) -> f64 {
        self.number.re
    }

    fn constant(x: f64) -> Self {
        Traced::made(Dual2_64::constant(x), &[])
    }

    fn is_constant(&self) -> bool {
        self.number.is_constant()
    }

    fn is_at_rest(&self) -> bool {
        self.number.is_at_rest()
    }

    fn with_value(self, x: f64) -> Self {
        self.unary(self.number.with_value(x))
    }

    fn still(self) -> Self {
        Traced { number: self.number.still(), faults: [self.faults[0]; 3], ..self }
    }

    fn chain(self, f: [f64; 4]) -> Self {
        self.unary(self.number.chain(f))
    }

    fn chain_scaled(self, f: [f64; 4]) -> Self {
        self.unary(self.number.chain_scaled(f))
    }

    fn quotient(self, b: Self) -> Self {
        self.binary(b, self.number.quotient(b.number))
    }

    fn growing(self, growth: Growth) -> Self {
        Traced { number: self.number.growing(growth), ..self }
    }
}

macro_rules! operators {
    ($($op:ident::$f:ident;)*) => {$(
        impl $op for Traced {
            type Output = Traced;

            fn $f(self, other: Traced) -> Traced {
                self.binary(other, $op::$f(self.number, other.number))
            }
        }

        impl $op<f64> for Traced {
            type Output = Traced;

            fn $f(self, other: f64) -> Traced {
                $op::$f(self, Traced { number: Dual2_64::constant(other), faults: [0; 3], inputs: 0 })
            }
        }
    )*};
}

operators! {
    Add::add;
    Sub::sub;
    Mul::mul;
}

impl Neg for Traced {
    type Output = Traced;

    fn neg(self) -> Traced {
        self.unary(-self.number)
    }
}

impl fmt::Display for Traced {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.number, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::real::Real;

    fn x(value: f64) -> Real<Traced> {
        Real(Traced::input(value, Some(1.0), 0))
    }

    #[test]
    fn fault_is_the_one_that_the_result_comes_from() {
        let fault = fault_of(0, || {
            let x = x(0.0);
            let harmless = (1.0 / x).atan();
            ended(7);
            let y = (x - 1.0).sqrt();
            ended(8);
            let z = harmless + y;
            ended(9);
            Some(z.0)
        });
        let fault = fault.unwrap();
        assert_eq!(
            (fault.expression, fault.part, fault.operands[0], fault.inputs),
            (Some(8), 0, Some(-1.0), 1)
        );
    }

    #[test]
    fn slope_alone_is_a_fault_of_its_own() {
        let run = || Some((x(0.0).sqrt() + 1.0).0);
        assert!(fault_of(0, run).is_none());
        assert_eq!(fault_of(1, run).unwrap().part, 1);
        assert_eq!(fault_of(2, || Some(x(0.0).powf(1.5).0)).unwrap().part, 2);
    }
}
