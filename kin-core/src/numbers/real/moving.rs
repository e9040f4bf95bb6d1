//! Adds two marks to the scalars of num-dual: the directions along which a number changes, and the
//! growth of its values.

use std::fmt::{self, Display};
use std::ops::{Add, Deref, Mul, Neg, Sub};

use super::dual::{Dual, Growth, sealed};

/// A number of num-dual that knows along which directions it changes.
///
/// [`Real`](super::Real) explains the rule for constant numbers.
#[derive(Clone, Copy, Debug)]
pub struct Moving<T> {
    number: T,
    /// Bits 0 and 1 (`DIRECTIONS`): the directions that move the number. Bits 2 and 3 (`BURSTS`,
    /// `POLES`): its growth.
    marks: u8,
}

/// The bits of the two directions.
const DIRECTIONS: u8 = 3;
/// `BURSTS`: the number grows like an exponential. `POLES`: it may be infinite at a pole, where a
/// function of it may jump.
const BURSTS: u8 = 4;
const POLES: u8 = 8;

/// A number with a first derivative; the parts are `re`, `eps`.
pub type Dual64 = Moving<num_dual::Dual64>;
/// A number with two derivatives along one direction; the parts are `re`, `v1`, `v2`.
pub type Dual2_64 = Moving<num_dual::Dual2_64>;
/// A number with three derivatives along one direction; the parts are `re`, `v1`, `v2`, `v3`.
pub type Dual3_64 = Moving<num_dual::Dual3_64>;
/// A number with derivatives along two directions; the parts are `re`, `eps1`, `eps2`, `eps1eps2`.
pub type HyperDual64 = Moving<num_dual::HyperDual64>;

/// Gives access to the parts of the number by their names.
impl<T> Deref for Moving<T> {
    type Target = T;

    #[inline]
    fn deref(&self) -> &T {
        &self.number
    }
}

impl<T> Moving<T> {
    /// Returns the bits of [`Moving::marks`].
    pub(crate) fn marks(&self) -> u8 {
        self.marks
    }

    /// Returns the number with the growth bits of `marks` and its present direction bits.
    pub(crate) fn with_growth_of(self, marks: u8) -> Self {
        Moving { marks: (self.marks & DIRECTIONS) | (marks & !DIRECTIONS), ..self }
    }
}

impl<T: Display> Display for Moving<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Display::fmt(&self.number, f)
    }
}

macro_rules! operators {
    ($($op:ident::$f:ident),*) => {$(
        impl<T: $op<Output = T>> $op for Moving<T> {
            type Output = Self;

            // A result moves along a direction if one of both operands does, whatever the
            // operation.
            #[inline]
            #[allow(clippy::suspicious_arithmetic_impl)]
            fn $f(self, other: Self) -> Self {
                Moving { number: self.number.$f(other.number), marks: self.marks | other.marks }
            }
        }

        impl<T: $op<f64, Output = T>> $op<f64> for Moving<T> {
            type Output = Self;

            #[inline]
            fn $f(self, other: f64) -> Self {
                Moving { number: self.number.$f(other), ..self }
            }
        }
    )*};
}

operators!(Add::add, Sub::sub, Mul::mul);

impl<T: Neg<Output = T>> Neg for Moving<T> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Moving { number: -self.number, ..self }
    }
}

/// Implements [`Dual`] for a number with the part `re` and the listed parts, from its chain rules
/// and its quotient rule. `q` is the real part of the quotient.
macro_rules! dual {
    (
        $number:ident [$($part:ident),*] at rest |$r:ident| $rest:expr,
        chain |$x:ident, $f:ident| $chain:expr,
        scaled |$sx:ident, $sf:ident| $scaled:expr,
        quotient |$a:ident, $b:ident, $q:ident| $quotient:expr
    ) => {
        impl Moving<num_dual::$number> {
            /// Creates a constant number.
            #[inline]
            pub fn from_re(re: f64) -> Self {
                Moving { number: num_dual::$number::from_re(re), marks: 0 }
            }

            #[inline]
            fn moved(self, [re, $($part),*]: [f64; 1 $(+ { let _ = stringify!($part); 1 })*]) -> Self {
                Moving { number: num_dual::$number::new(re, $($part),*), ..self }
            }
        }

        impl sealed::Sealed for Moving<num_dual::$number> {}

        impl Dual for Moving<num_dual::$number> {
            #[inline]
            fn value(&self) -> f64 {
                self.re
            }

            #[inline]
            fn constant(x: f64) -> Self {
                Self::from_re(x)
            }

            #[inline]
            fn is_constant(&self) -> bool {
                self.marks & DIRECTIONS == 0
            }

            #[inline]
            fn is_at_rest(&self) -> bool {
                let $r = self;
                $rest
            }

            #[inline]
            fn with_value(self, x: f64) -> Self {
                Moving { number: num_dual::$number { re: x, ..self.number }, ..self }
            }

            #[inline]
            fn chain(self, $f: [f64; 4]) -> Self {
                let $x = self;
                if self.is_flat(&$f) { Self::from_re($f[0]) } else { self.moved($chain) }
            }

            #[inline]
            fn chain_scaled(self, $sf: [f64; 4]) -> Self {
                let $sx = self;
                if self.is_flat(&$sf) { Self::from_re($sf[0]) } else { self.moved($scaled) }
            }

            #[inline]
            fn quotient(self, $b: Self) -> Self {
                let $a = self;
                let $q = self.re / $b.re;
                let pole = if $b.is_constant() { 0 } else { POLES };
                let marks = self.marks | $b.marks | pole;
                if marks & DIRECTIONS == 0 || ($b.has_overflowed() && $q.is_finite()) {
                    return Self::from_re($q);
                }
                Moving { marks, ..self }.moved($quotient)
            }

            #[inline]
            fn growing(self, growth: Growth) -> Self {
                let marks = match growth {
                    Growth::Bounded => self.marks & DIRECTIONS,
                    Growth::Bursting => self.marks | BURSTS,
                    Growth::Logarithmic => (self.marks & !BURSTS) | POLES,
                    Growth::Pole => self.marks | POLES,
                    Growth::BurstingPole => self.marks | BURSTS | POLES,
                };
                Moving { marks, ..self }
            }
        }

        impl Moving<num_dual::$number> {
            /// Returns true if a function with these derivatives gives a constant: the number is
            /// constant, or it has overflowed and the function is finite there.
            #[inline]
            fn is_flat(&self, f: &[f64; 4]) -> bool {
                self.is_constant() || (self.has_overflowed() && f[0].is_finite())
            }

            /// Returns true if the number is too large for an f64 and is not at a pole.
            #[inline]
            fn has_overflowed(&self) -> bool {
                self.re.is_infinite() && self.marks & (BURSTS | POLES) == BURSTS
            }
        }
    };
}

dual! { Dual64 [eps] at rest |x| x.eps == 0.0,
    chain |x, f| [f[0], x.eps * f[1]],
    scaled |x, f| [f[0], x.eps * f[1]],
    quotient |a, b, q| [q, (a.eps - q * b.eps) / b.re]
}

dual! { Dual2_64 [v1, v2] at rest |x| x.v1 == 0.0,
    chain |x, f| [f[0], x.v1 * f[1], x.v2 * f[1] + x.v1 * f[2] * x.v1],
    scaled |x, f| {
        let u1 = x.v1 * f[1];
        [f[0], u1, x.v2 * f[1] + u1 * f[2] * u1]
    },
    quotient |a, b, q| {
        let q1 = (a.v1 - q * b.v1) / b.re;
        [q, q1, (a.v2 - 2.0 * q1 * b.v1 - q * b.v2) / b.re]
    }
}

dual! { Dual3_64 [v1, v2, v3] at rest |x| x.v1 == 0.0,
    chain |x, f| {
        let bent = x.v1 * f[2];
        let second = x.v2 * f[1] + bent * x.v1;
        [f[0], x.v1 * f[1], second, x.v3 * f[1] + 3.0 * (bent * x.v2) + x.v1 * f[3] * x.v1 * x.v1]
    },
    scaled |x, f| {
        let [u1, u2, u3] = [x.v1, x.v2, x.v3].map(|v| v * f[1]);
        let bent = u1 * f[2];
        [f[0], u1, u2 + bent * u1, u3 + 3.0 * (bent * u2) + u1 * f[3] * u1 * u1]
    },
    quotient |a, b, q| {
        let q1 = (a.v1 - q * b.v1) / b.re;
        let q2 = (a.v2 - 2.0 * q1 * b.v1 - q * b.v2) / b.re;
        [q, q1, q2, (a.v3 - 3.0 * (q2 * b.v1 + q1 * b.v2) - q * b.v3) / b.re]
    }
}

dual! { HyperDual64 [eps1, eps2, eps1eps2] at rest |x| x.eps1 == 0.0 && x.eps2 == 0.0,
    chain |x, f| {
        let [first, second] = x.each(f[1]);
        let mixed = if x.marks & DIRECTIONS == DIRECTIONS { x.eps1eps2 * f[1] + x.eps1 * f[2] * x.eps2 } else { 0.0 };
        [f[0], first, second, mixed]
    },
    scaled |x, f| {
        let [first, second] = x.each(f[1]);
        let mixed = if x.marks & DIRECTIONS == DIRECTIONS { x.eps1eps2 * f[1] + first * f[2] * second } else { 0.0 };
        [f[0], first, second, mixed]
    },
    quotient |a, b, q| {
        let q1 = (a.eps1 - q * b.eps1) / b.re;
        let q2 = (a.eps2 - q * b.eps2) / b.re;
        [q, q1, q2, (a.eps1eps2 - q1 * b.eps2 - q2 * b.eps1 - q * b.eps1eps2) / b.re]
    }
}

impl Dual64 {
    /// Creates a number that changes along the direction with the slope `eps`. The number is not
    /// constant, even if `eps` is 0.
    #[inline]
    pub fn new(re: f64, eps: f64) -> Self {
        Moving { number: num_dual::Dual64::new(re, eps), marks: 1 }
    }
}

impl Dual2_64 {
    /// Creates a number that changes along the direction, from its value and its first two
    /// derivatives.
    #[inline]
    pub fn new(re: f64, v1: f64, v2: f64) -> Self {
        Moving { number: num_dual::Dual2_64::new(re, v1, v2), marks: 1 }
    }

    /// Creates a number as [`Dual2_64::new`] does if `moves` is true, otherwise the constant `re`.
    #[inline]
    pub fn moving_where(moves: bool, re: f64, v1: f64, v2: f64) -> Self {
        if moves { Self::new(re, v1, v2) } else { Self::from_re(re) }
    }
}

impl Dual3_64 {
    /// Creates a number that changes along the direction, from its value and its first three
    /// derivatives.
    #[inline]
    pub fn new(re: f64, v1: f64, v2: f64, v3: f64) -> Self {
        Moving { number: num_dual::Dual3_64::new(re, v1, v2, v3), marks: 1 }
    }
}

impl HyperDual64 {
    /// Creates a number that changes along both directions, from its value, its two slopes and the
    /// mixed second derivative.
    pub fn new(re: f64, eps1: f64, eps2: f64, eps1eps2: f64) -> Self {
        Moving { number: num_dual::HyperDual64::new(re, eps1, eps2, eps1eps2), marks: 3 }
    }

    /// Creates a number that changes only along the first direction, with the slope `rate`.
    pub fn along_first(re: f64, rate: f64) -> Self {
        Moving { number: num_dual::HyperDual64::new(re, rate, 0.0, 0.0), marks: 1 }
    }

    /// Creates a number that changes only along the second direction, with the slope `rate`.
    pub fn along_second(re: f64, rate: f64) -> Self {
        Moving { number: num_dual::HyperDual64::new(re, 0.0, rate, 0.0), marks: 2 }
    }

    /// Returns both rates times a slope; the product is 0 along a direction that does not move the
    /// number.
    #[inline]
    fn each(&self, slope: f64) -> [f64; 2] {
        let rate = |bit: u8, rate: f64| if self.marks & bit == 0 { 0.0 } else { rate * slope };
        [rate(1, self.eps1), rate(2, self.eps2)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CUBE: [f64; 4] = [8.0, 12.0, 12.0, 6.0];

    #[test]
    fn chain_is_the_composition_with_a_cube_at_two() {
        let x = Dual2_64::new(2.0, 0.3, 0.7);
        let y = Dual3_64::new(2.0, 0.3, 0.7, -0.2);
        let z = HyperDual64::new(2.0, 0.3, 0.5, 0.1);
        let fx = x.chain(CUBE);
        let fy = y.chain(CUBE);
        let fz = z.chain(CUBE);
        let gx = x * x * x;
        let gy = y * y * y;
        let gz = z * z * z;
        assert!((fx.v1 - gx.v1).abs() < 1e-14 && (fx.v2 - gx.v2).abs() < 1e-14);
        assert!((fy.v2 - gy.v2).abs() < 1e-14 && (fy.v3 - gy.v3).abs() < 1e-14);
        assert!((fz.eps2 - gz.eps2).abs() < 1e-14 && (fz.eps1eps2 - gz.eps1eps2).abs() < 1e-14);
        assert_eq!(Dual64::new(2.0, 0.5).chain(CUBE).eps, 6.0);
        assert_eq!(Dual::chain(2.0, CUBE), 8.0);
        // From f″/f′² and f‴/f′³.
        let scaled = [8.0, 12.0, 12.0 / 144.0, 6.0 / 1728.0];
        let sx = x.chain_scaled(scaled);
        let sy = y.chain_scaled(scaled);
        let sz = z.chain_scaled(scaled);
        assert!(
            (sx.v1 - gx.v1).abs() < 1e-14
                && (sx.v2 - gx.v2).abs() < 1e-14
                && (sy.v3 - gy.v3).abs() < 1e-14
        );
        assert!((sz.eps1 - gz.eps1).abs() < 1e-14 && (sz.eps1eps2 - gz.eps1eps2).abs() < 1e-14);
    }

    #[test]
    fn a_constant_stays_one_and_a_zero_tangent_is_a_number() {
        let infinite = [0.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
        let constant = Dual3_64::constant(0.0).chain(infinite);
        assert!(constant.v3 == 0.0 && constant.is_constant());
        let along_t = HyperDual64::along_second(0.0, 1.0).chain(infinite);
        assert_eq!((along_t.eps1, along_t.eps2, along_t.eps1eps2), (0.0, f64::INFINITY, 0.0));
        // A tangent that happens to be zero does not make the number a constant.
        let x = Dual3_64::new(0.0, 1.0, 0.0, 0.0);
        assert!((x * x).v1 == 0.0 && !(x * x).is_constant() && (x * x).chain(infinite).v1.is_nan());
        assert!(!(x - x).is_constant() && !Dual64::new(1.0, 0.0).is_constant());
        assert!(HyperDual64::along_first(0.0, 1.0).chain(infinite).eps2 == 0.0);
    }

    #[test]
    fn what_has_overflowed_is_flat_and_a_pole_is_not() {
        let infinite = Dual3_64::new(f64::INFINITY, f64::INFINITY, f64::INFINITY, f64::INFINITY);
        let large = infinite.growing(Growth::Bursting);
        let pole = infinite.growing(Growth::Pole);
        let bounded = [1.0, 0.0, 0.0, 0.0];
        let flat = large.chain(bounded);
        assert_eq!((flat.re, flat.v1, flat.v2, flat.v3), (1.0, 0.0, 0.0, 0.0));
        let zero = Dual3_64::new(2.0, 1.0, 1.0, 1.0).quotient(large);
        assert_eq!((zero.re, zero.v1, zero.v2, zero.v3), (0.0, 0.0, 0.0, 0.0));
        assert!(large.chain([f64::INFINITY; 4]).v1.is_infinite());
        let one = Dual3_64::new(1.0, 1.0, 1.0, 1.0);
        for singular in
            [pole, infinite, large * pole, large + one.quotient(Dual3_64::new(0.0, 1.0, 0.0, 0.0))]
        {
            assert!(singular.chain(bounded).v1.is_nan() && one.quotient(singular).v1.is_nan());
        }
        assert!(
            !pole.growing(Growth::Bounded).growing(Growth::Bursting).chain(bounded).v1.is_nan()
        );
    }

    #[test]
    fn quotient_times_divisor_is_the_dividend() {
        let a = Dual3_64::new(0.3, 1.0, -2.0, 0.5);
        let b = Dual3_64::new(1.7, 0.4, 0.6, -0.8);
        let p = a.quotient(b) * b;
        assert!(
            (p.re - a.re).abs() < 1e-15
                && (p.v1 - a.v1).abs() < 1e-15
                && (p.v2 - a.v2).abs() < 1e-15
                && (p.v3 - a.v3).abs() < 1e-14
        );
        let a = HyperDual64::new(0.3, 1.0, -2.0, 0.5);
        let b = HyperDual64::new(1.7, 0.4, 0.6, -0.8);
        let p = a.quotient(b) * b;
        assert!(
            (p.eps1 - a.eps1).abs() < 1e-15
                && (p.eps2 - a.eps2).abs() < 1e-15
                && (p.eps1eps2 - a.eps1eps2).abs() < 1e-15
        );
        let a = Dual2_64::new(0.3, 1.0, -2.0);
        let b = Dual2_64::new(1.7, 0.4, 0.6);
        let p = a.quotient(b) * b;
        assert!((p.v1 - a.v1).abs() < 1e-15 && (p.v2 - a.v2).abs() < 1e-15);
        assert_eq!(Dual64::new(1.0, 2.0).quotient(Dual64::constant(f64::INFINITY)).eps, 0.0);
    }
}
