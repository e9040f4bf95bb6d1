//! Numbers over lanes, with f64's names: what tapes compute with.
//!
//! A number is two registers: what is found out once for all lanes (which step comes next, where
//! its numbers stand, which function is called) then serves twice as many times, and two chains of
//! operations run side by side.

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

    /// The same number in every lane.
    #[inline(always)]
    pub fn splat(simd: S, x: f64) -> Self {
        Wide::new(simd, [simd.splat_f64s(x); 2])
    }

    /// Another number, the same in every lane.
    #[inline(always)]
    pub fn all(self, x: f64) -> Self {
        Wide::splat(self.0, x)
    }

    /// How many lanes there are.
    pub const LANES: usize = 2 * S::F64_LANES;

    /// The numbers, lane by lane.
    #[inline(always)]
    pub fn as_slice(&self) -> &[f64] {
        bytemuck::cast_slice(&self.1)
    }

    /// The numbers, lane by lane, to be written.
    #[inline(always)]
    pub fn as_mut_slice(&mut self) -> &mut [f64] {
        bytemuck::cast_slice_mut(&mut self.1)
    }

    /// a b + c, rounded once.
    #[inline(always)]
    pub fn mul_add(self, b: Self, c: Self) -> Self {
        Wide::new(self.0, both!(self.0, mul_add_e_f64s, self.1, b.1, c.1))
    }

    /// c − a b, rounded once.
    #[inline(always)]
    pub fn negative_mul_add(self, b: Self, c: Self) -> Self {
        Wide::new(self.0, both!(self.0, negate_mul_add_e_f64s, self.1, b.1, c.1))
    }

    /// √x
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Wide::new(self.0, both!(self.0, sqrt_f64s, self.1))
    }

    /// |x|
    #[inline(always)]
    pub fn abs(self) -> Self {
        Wide::new(self.0, both!(self.0, abs_f64s, self.1))
    }

    /// The larger one; of a NaN and a number one of the two.
    #[inline(always)]
    pub(crate) fn or_larger(self, other: Self) -> Self {
        Wide::new(self.0, both!(self.0, max_f64s, self.1, other.1))
    }

    /// The larger one; the other one of a NaN.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        self.ge(other).select(self, other.equal(other).select(other, self))
    }

    /// The smaller one; the other one of a NaN.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        self.le(other).select(self, other.equal(other).select(other, self))
    }

    /// xⁿ
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

    /// A function of one number, lane by lane.
    #[inline(always)]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut result = self;
        result.as_mut_slice().iter_mut().for_each(|x| *x = f(*x));
        result
    }

    /// A function of two numbers, lane by lane.
    #[inline(always)]
    pub fn map2(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut result = self;
        result.as_mut_slice().iter_mut().zip(other.as_slice()).for_each(|(x, y)| *x = f(*x, *y));
        result
    }

    /// The condition that is kept as 1 or 0.
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

            /// True if the numbers differ; a NaN differs from everything.
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
    /// True if the numbers are equal.
    equal equal_f64s;
}

impl<S: Level> Mask<S> {
    /// The same in every lane.
    #[inline(always)]
    pub fn splat(simd: S, condition: bool) -> Self {
        Wide::splat(simd, f64::from(u8::from(condition))).is_true()
    }

    /// `a` where it is true, else `b`.
    #[inline(always)]
    pub fn select(self, a: Wide<S>, b: Wide<S>) -> Wide<S> {
        Wide::new(self.0, both!(self.0, select_f64s, self.1, a.1, b.1))
    }

    /// True if it is true in some lane.
    #[inline(always)]
    pub fn any(self) -> bool {
        self.0.first_true_m64s(self.0.or_m64s(self.1[0], self.1[1])) < S::F64_LANES
    }

    /// True if it is true in a lane.
    pub fn lane(self, lane: usize) -> bool {
        self.as_numbers().as_slice().get(lane).is_some_and(|x| *x != 0.0)
    }

    /// 1 where it is true, else 0.
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
