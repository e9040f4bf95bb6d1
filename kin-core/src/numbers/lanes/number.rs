//! Implements the numbers over lanes with which tapes compute, under the method names of f64.
//!
//! A number consists of two registers. So the interpreter decodes a step once for twice as many
//! times, and two chains of operations run in parallel.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use pulp::bytemuck;

use super::Level;

/// 2⁵²: added to a whole number below 2³² it leaves that in the last bits.
const WHOLE: f64 = 4_503_599_627_370_496.0;

/// A whole number below 2³² as an integer. A cast, which minds all other numbers too, takes nine
/// instructions more for each time of a run.
#[inline(always)]
pub(crate) fn whole(x: f64) -> usize {
    (x + WHOLE).to_bits() as u32 as usize
}

/// One number for each lane.
#[derive(Clone, Copy)]
pub struct Wide<S: Level>(pub(super) S, pub(super) [S::f64s; 2], [S::Align; 0]);

/// One condition for each lane.
#[derive(Clone, Copy)]
pub struct Mask<S: Level>(pub(super) S, pub(super) [S::m64s; 2]);

/// An operation of `pulp` on both registers.
macro_rules! both {
    ($simd:expr, $function:ident, $($x:expr),+) => {
        [$simd.$function($($x[0]),+), $simd.$function($($x[1]),+)]
    };
}
pub(super) use both;

macro_rules! operator {
    ($($trait:ident $method:ident $function:ident;)*) => {$(
        impl<S: Level> $trait for Wide<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Wide::new(self.0, both!(self.0, $function, self.1, other.1))
            }
        }
    )*};
}

operator! {
    Add add add_f64s;
    Sub sub sub_f64s;
    Mul mul mul_f64s;
    Div div div_f64s;
}

impl<S: Level> Neg for Wide<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Wide::new(self.0, both!(self.0, neg_f64s, self.1))
    }
}

impl<S: Level> Wide<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, numbers: [S::f64s; 2]) -> Self {
        Wide(simd, numbers, [])
    }

    /// Creates a number with the same value in every lane.
    #[inline(always)]
    pub fn splat(simd: S, x: f64) -> Self {
        Wide::new(simd, [simd.splat_f64s(x); 2])
    }

    /// Returns a number with the value x in every lane.
    #[inline(always)]
    pub fn all(self, x: f64) -> Self {
        Wide::splat(self.0, x)
    }

    /// The number of lanes.
    pub const LANES: usize = 2 * S::F64_LANES;

    /// Returns the numbers, lane by lane.
    #[inline(always)]
    pub fn as_slice(&self) -> &[f64] {
        bytemuck::cast_slice(&self.1)
    }

    /// Returns the numbers, lane by lane, for writing.
    #[inline(always)]
    pub fn as_mut_slice(&mut self) -> &mut [f64] {
        bytemuck::cast_slice_mut(&mut self.1)
    }

    /// Returns a b + c, rounded once.
    #[inline(always)]
    pub fn mul_add(self, b: Self, c: Self) -> Self {
        Wide::new(self.0, both!(self.0, mul_add_e_f64s, self.1, b.1, c.1))
    }

    /// Returns c − a b, rounded once.
    #[inline(always)]
    pub fn negative_mul_add(self, b: Self, c: Self) -> Self {
        Wide::new(self.0, both!(self.0, negate_mul_add_e_f64s, self.1, b.1, c.1))
    }

    /// Returns √x.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Wide::new(self.0, both!(self.0, sqrt_f64s, self.1))
    }

    /// |x|Returns |x|.
    #[inline(always)]
    pub fn abs(self) -> Self {
        Wide::new(self.0, both!(self.0, abs_f64s, self.1))
    }

    /// The larger one; of a NaN and a number one of the two.
    #[inline(always)]
    pub(crate) fn or_larger(self, other: Self) -> Self {
        Wide::new(self.0, both!(self.0, max_f64s, self.1, other.1))
    }

    /// Returns the larger number; if one is NaN, returns the other.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        self.ge(other).select(self, other.equal(other).select(other, self))
    }

    /// Returns the smaller number; if one is NaN, returns the other.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        self.le(other).select(self, other.equal(other).select(other, self))
    }

    /// Returns xⁿ.
    #[inline(always)]
    pub fn powi(self, n: i32) -> Self {
        let mut left = n.unsigned_abs();
        let mut square = self;
        let mut power = Wide::splat(self.0, 1.0);
        while left > 0 {
            if left & 1 == 1 {
                power = power * square;
            }
            left >>= 1;
            if left > 0 {
                square = square * square;
            }
        }
        if n < 0 { Wide::splat(self.0, 1.0) / power } else { power }
    }

    /// Applies a function of one number, lane by lane.
    #[inline(always)]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut result = self;
        result.as_mut_slice().iter_mut().for_each(|x| *x = f(*x));
        result
    }

    /// Applies a function of two numbers, lane by lane.
    #[inline(always)]
    pub fn map2(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut result = self;
        result.as_mut_slice().iter_mut().zip(other.as_slice()).for_each(|(x, y)| *x = f(*x, *y));
        result
    }

    /// Returns the condition that this number stores as 1 or 0.
    #[inline(always)]
    pub fn is_true(self) -> Mask<S> {
        self.differ(Wide::splat(self.0, 0.0))
    }
}

macro_rules! comparison {
    ($($(#[$doc:meta])* $name:ident $function:ident;)*) => {
        impl<S: Level> Wide<S> {
            $(
                $(#[$doc])*
                #[inline(always)]
                pub fn $name(self, other: Self) -> Mask<S> {
                    Mask(self.0, both!(self.0, $function, self.1, other.1))
                }
            )*

            /// Returns true if the numbers differ; a NaN differs from every number.
            #[inline(always)]
            pub fn differ(self, other: Self) -> Mask<S> {
                !self.equal(other)
            }
        }
    };
}

comparison! {
    /// <
    lt less_than_f64s;
    /// ≤
    le less_than_or_equal_f64s;
    /// >
    gt greater_than_f64s;
    /// ≥
    ge greater_than_or_equal_f64s;
    /// Returns true if the numbers are equal.
    equal equal_f64s;
}

impl<S: Level> Mask<S> {
    /// Creates a condition with the same value in every lane.
    #[inline(always)]
    pub fn splat(simd: S, condition: bool) -> Self {
        Wide::splat(simd, f64::from(u8::from(condition))).is_true()
    }

    /// Returns `a` in lanes in which the condition is true, otherwise `b`.
    #[inline(always)]
    pub fn select(self, a: Wide<S>, b: Wide<S>) -> Wide<S> {
        Wide::new(self.0, both!(self.0, select_f64s, self.1, a.1, b.1))
    }

    /// Returns true if the condition is true in at least one lane.
    #[inline(always)]
    pub fn any(self) -> bool {
        self.0.first_true_m64s(self.0.or_m64s(self.1[0], self.1[1])) < S::F64_LANES
    }

    /// Returns the condition of one lane.
    pub fn lane(self, lane: usize) -> bool {
        self.as_numbers().as_slice().get(lane).is_some_and(|x| *x != 0.0)
    }

    /// Returns 1 in lanes in which the condition is true, otherwise 0.
    #[inline(always)]
    pub fn as_numbers(self) -> Wide<S> {
        self.select(Wide::splat(self.0, 1.0), Wide::splat(self.0, 0.0))
    }
}

impl<S: Level> BitAnd for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Mask(self.0, both!(self.0, and_m64s, self.1, other.1))
    }
}

impl<S: Level> BitOr for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Mask(self.0, both!(self.0, or_m64s, self.1, other.1))
    }
}

impl<S: Level> Not for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Mask(self.0, both!(self.0, not_m64s, self.1))
    }
}
