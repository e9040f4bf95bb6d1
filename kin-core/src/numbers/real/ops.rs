//! Implements the operators of [`Real`] with itself and with `f64`, by value and by reference, and
//! comparisons of real parts.

use std::cmp::Ordering;
use std::iter::{Product, Sum};
use std::ops::{
    Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign,
};

use super::{Dual, Real};

/// Implements `a ∘ b` by value and by reference on either side; all types are `Copy`.
macro_rules! by_ref {
    ([$($generics:tt)*] $op:ident::$f:ident, $l:ty, $r:ty => $out:ty, |$a:ident, $b:ident| $e:expr) => {
        impl<$($generics)*> $op<$r> for $l {
            type Output = $out;

            #[inline]
            fn $f(self, $b: $r) -> $out {
                let $a = self;
                $e
            }
        }

        impl<$($generics)*> $op<&$r> for $l {
            type Output = $out;

            #[inline]
            fn $f(self, b: &$r) -> $out {
                $op::$f(self, *b)
            }
        }

        impl<$($generics)*> $op<$r> for &$l {
            type Output = $out;

            #[inline]
            fn $f(self, b: $r) -> $out {
                $op::$f(*self, b)
            }
        }

        impl<$($generics)*> $op<&$r> for &$l {
            type Output = $out;

            #[inline]
            fn $f(self, b: &$r) -> $out {
                $op::$f(*self, *b)
            }
        }
    };
}
pub(crate) use by_ref;

/// Implements `a ∘= b` through `a ∘ b`, with b by value and by reference.
macro_rules! assign {
    ([$($generics:tt)*] $op:ident::$f:ident by $base:ident::$g:ident, $l:ty, $r:ty) => {
        impl<$($generics)*> $op<$r> for $l {
            #[inline]
            fn $f(&mut self, b: $r) {
                *self = $base::$g(*self, b);
            }
        }

        impl<$($generics)*> $op<&$r> for $l {
            #[inline]
            fn $f(&mut self, b: &$r) {
                *self = $base::$g(*self, *b);
            }
        }
    };
}
pub(crate) use assign;

macro_rules! operator {
    ($op:ident::$f:ident, $assign:ident::$g:ident, |$a:ident, $b:ident| $both:expr, $right:expr, $left:expr) => {
        by_ref!([D: Dual] $op::$f, Real<D>, Real<D> => Real<D>, |$a, $b| $both);
        by_ref!([D: Dual] $op::$f, Real<D>, f64 => Real<D>, |$a, $b| $right);
        by_ref!([D: Dual] $op::$f, f64, Real<D> => Real<D>, |$a, $b| $left);
        assign!([D: Dual] $assign::$g by $op::$f, Real<D>, Real<D>);
        assign!([D: Dual] $assign::$g by $op::$f, Real<D>, f64);
    };
}

// Each line gives the operator on two numbers, on a number and an f64, and on an f64 and a number.
operator!(Add::add, AddAssign::add_assign, |a, b| Real(a.0 + b.0), Real(a.0 + b), Real(b.0 + a));
operator!(Sub::sub, SubAssign::sub_assign, |a, b| Real(a.0 - b.0), Real(a.0 - b), Real(-b.0 + a));
operator!(Mul::mul, MulAssign::mul_assign, |a, b| Real(a.0 * b.0), Real(a.0 * b), Real(b.0 * a));
operator!(
    Div::div,
    DivAssign::div_assign,
    |a, b| quotient(a, b),
    quotient(a, b.into()),
    quotient(a.into(), b)
);
operator!(
    Rem::rem,
    RemAssign::rem_assign,
    |a, b| remainder(a, b),
    remainder(a, b.into()),
    remainder(a.into(), b)
);

/// Returns a/b. The quotient of two constants is a constant, even if it is not finite.
#[inline]
fn quotient<D: Dual>(a: Real<D>, b: Real<D>) -> Real<D> {
    Real(a.0.quotient(b.0))
}

/// Returns a % b = a − n b with the whole number n = trunc(a/b); n is constant except at jumps.
fn remainder<D: Dual>(a: Real<D>, b: Real<D>) -> Real<D> {
    a.less_whole(b, a.value() % b.value())
}

impl<D: Dual> Real<D> {
    /// Returns a − n b with the whole number n that makes the value `rest`. The function computes n
    /// from `rest`, because a/b may round across a whole number.
    pub(super) fn less_whole(self, b: Self, rest: f64) -> Self {
        let n = ((self.value() - rest) / b.value()).round();
        let reduced = if b.is_constant() { self } else { self - b * n };
        reduced.with_value(rest)
    }
}

impl<D: Dual> Neg for Real<D> {
    type Output = Real<D>;

    #[inline]
    fn neg(self) -> Real<D> {
        Real(-self.0)
    }
}

impl<D: Dual> Neg for &Real<D> {
    type Output = Real<D>;

    #[inline]
    fn neg(self) -> Real<D> {
        -*self
    }
}

macro_rules! fold {
    ($fold:ident::$f:ident, $start:expr, $op:path) => {
        impl<D: Dual> $fold for Real<D> {
            fn $f<I: Iterator<Item = Self>>(numbers: I) -> Self {
                numbers.fold(Self::from($start), $op)
            }
        }

        impl<'a, D: Dual> $fold<&'a Real<D>> for Real<D> {
            fn $f<I: Iterator<Item = &'a Self>>(numbers: I) -> Self {
                numbers.copied().$f()
            }
        }

        impl<D: Dual> $fold<f64> for Real<D> {
            fn $f<I: Iterator<Item = f64>>(numbers: I) -> Self {
                Self::from(numbers.$f::<f64>())
            }
        }

        impl<'a, D: Dual> $fold<&'a f64> for Real<D> {
            fn $f<I: Iterator<Item = &'a f64>>(numbers: I) -> Self {
                Self::from(numbers.$f::<f64>())
            }
        }
    };
}

fold!(Sum::sum, 0.0, Add::add);
fold!(Product::product, 1.0, Mul::mul);

macro_rules! compare {
    ([$($generics:tt)*] $l:ty, $r:ty, |$a:ident, $b:ident| $x:expr, $y:expr) => {
        impl<$($generics)*> PartialEq<$r> for $l {
            #[inline]
            fn eq(&self, $b: &$r) -> bool {
                let $a = self;
                $x == $y
            }
        }

        impl<$($generics)*> PartialOrd<$r> for $l {
            #[inline]
            fn partial_cmp(&self, $b: &$r) -> Option<Ordering> {
                let $a = self;
                $x.partial_cmp(&$y)
            }
        }
    };
}

compare!([D: Dual] Real<D>, Real<D>, |a, b| a.value(), b.value());
compare!([D: Dual] Real<D>, f64, |a, b| a.value(), *b);
compare!([D: Dual] f64, Real<D>, |a, b| *a, b.value());

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use crate::numbers::real::{Dual2_64, Dual64};

    use super::*;

    fn x() -> Real<Dual64> {
        Real(Dual64::new(3.0, 1.0))
    }

    fn parts(x: Real<Dual64>) -> (f64, f64) {
        (x.0.re, x.0.eps)
    }

    #[test]
    #[allow(clippy::op_ref)]
    fn mixed_forms_agree_by_value_and_by_reference() {
        let x = x();
        let y = Real(Dual64::new(2.0, -1.0));
        let c = 2.0;
        let constant = Real::from(c);
        macro_rules! agree {
            ($($op:tt)*) => {$(
                assert_eq!(parts(x $op constant), parts(x $op c));
                assert_eq!(parts(constant $op x), parts(c $op x));
                for other in [&x $op y, x $op &y, &x $op &y] {
                    assert_eq!(parts(x $op y), parts(other));
                }
                for other in [&x $op c, x $op &c, &x $op &c] {
                    assert_eq!(parts(x $op c), parts(other));
                }
                for other in [&c $op x, c $op &x, &c $op &x] {
                    assert_eq!(parts(c $op x), parts(other));
                }
            )*};
        }
        agree!(+ - * / %);
        assert_eq!(parts(-&x), (-3.0, -1.0));
        assert_eq!(parts(2.0 * x * PI), (3.0 * 2.0 * PI, 2.0 * PI));
    }

    #[test]
    fn assignments_take_numbers_and_f64() {
        let mut z = x();
        z += x();
        z -= &x();
        z *= 4.0;
        z /= &2.0;
        z *= x();
        z %= 5.0;
        assert_eq!(parts(z), (18.0 % 5.0, 12.0));
    }

    #[test]
    fn values_are_those_of_f64() {
        for (a, b) in [(1.0, 3.0), (0.1, 0.7), (-5.3, 1.9), (0.0, -2.0), (2.0, 2.0)] {
            let x = Real(Dual2_64::new(a, 1.0, 2.0));
            let y = Real(Dual2_64::new(b, -1.0, 0.5));
            for (dual, plain) in [
                (x / y, a / b),
                (x % y, a % b),
                (x - y, a - b),
                (a - y, a - b),
                (a / y, a / b),
                (x * b, a * b),
            ] {
                assert_eq!(dual.value().to_bits(), plain.to_bits());
            }
        }
    }

    #[test]
    fn remainder_keeps_its_slope_and_counts_the_divisor() {
        assert_eq!(parts(x() % 2.0), (1.0, 1.0));
        assert_eq!(parts(7.0 % x()), (1.0, -2.0));
        assert_eq!(parts(-7.0 % x()), (-1.0, 2.0));
        assert_eq!(parts(x() % f64::INFINITY), (3.0, 1.0));
        let third = Real(Dual64::new(0.1, 1.0));
        assert_eq!(parts(Real::from(0.3) % third).1, -2.0);
    }

    #[test]
    fn division_by_a_constant_zero_stays_constant() {
        let zero = Real::<Dual64>::from(0.0);
        let one = Real::<Dual64>::from(1.0);
        for infinite in [one / zero, 1.0 / zero + one, one / 0.0 * 2.0] {
            assert_eq!(parts(infinite), (f64::INFINITY, 0.0));
        }
        assert!(!(1.0 / Real(Dual64::new(0.0, 1.0))).0.eps.is_finite());
    }

    #[test]
    fn comparisons_look_at_real_parts() {
        assert!(
            x() == 3.0
                && 3.0 == x()
                && x() > 2.0
                && 2.0 < x()
                && x() == Real(Dual64::new(3.0, 0.0))
                && x() >= x()
        );
        assert!(x().partial_cmp(&f64::NAN).is_none());
    }

    #[test]
    fn sums_and_products() {
        let numbers = [x(), x(), Real::from(2.0)];
        assert_eq!(parts(numbers.iter().sum()), (8.0, 2.0));
        assert_eq!(parts(numbers.into_iter().product()), (18.0, 12.0));
    }
}
