//! Defines an interface for single numbers and for lanes of numbers, so that a rule for both is
//! written once.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use wide::f64x4;

use super::{Level, Mask, Wide};

/// A number that formulas are written over: f64, four of them in a vector, or one in each lane.
pub(crate) trait Lanewise:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Another number, the same in every lane.
    fn all(self, x: f64) -> Self;

    /// |x|
    fn abs(self) -> Self;

    /// a b + c, rounded once where that is as fast.
    fn mul_add(self, b: Self, c: Self) -> Self;
}

/// A number that rules are asked about, which answer for each lane by itself.
pub(crate) trait Judged: Lanewise {
    /// `bool`, or one in each lane.
    type Answer: Answer;

    /// <
    fn below(self, other: Self) -> Self::Answer;

    /// ≤
    fn at_most(self, other: Self) -> Self::Answer;

    /// >
    fn above(self, other: Self) -> Self::Answer;

    /// `self` where that is so, else `other`.
    fn where_or(self, so: Self::Answer, other: Self) -> Self;
}

/// A number that whole programs compute with.
pub(crate) trait Computed: Judged + Neg<Output = Self> {
    /// a b + c, rounded once.
    fn fused(self, b: Self, c: Self) -> Self;

    /// c − a b, rounded once.
    fn fused_less(self, b: Self, c: Self) -> Self;

    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);

    /// √x
    fn sqrt(self) -> Self;

    /// The larger one; the other one of a NaN.
    fn max(self, other: Self) -> Self;

    /// The smaller one; the other one of a NaN.
    fn min(self, other: Self) -> Self;

    /// The larger one; of a NaN and a number one of the two.
    fn or_larger(self, other: Self) -> Self;

    /// xⁿ
    fn powi(self, n: i32) -> Self;

    /// Functions of one number, lane by lane.
    fn map_to<const K: usize>(self, f: impl Fn(f64) -> [f64; K]) -> [Self; K];

    /// A function of two numbers, lane by lane.
    fn map2(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self;

    /// True if the numbers are equal.
    fn equals(self, other: Self) -> Self::Answer;

    /// The number of a lane.
    fn lane(self, lane: usize) -> f64;

    /// 1 where that is so, else 0.
    #[inline(always)]
    fn one_where(self, so: Self::Answer) -> Self {
        self.all(1.0).where_or(so, self.all(0.0))
    }
}

/// The answer of a rule.
pub(crate) trait Answer:
    Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// True if it is so in some lane.
    fn any(self) -> bool;
}

impl Answer for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
}

impl<S: Level> Answer for Mask<S> {
    #[inline(always)]
    fn any(self) -> bool {
        self.any()
    }
}

impl Lanewise for f64 {
    #[inline(always)]
    fn all(self, x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
}

impl Judged for f64 {
    type Answer = bool;

    #[inline(always)]
    fn below(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> bool {
        self <= other
    }

    #[inline(always)]
    fn above(self, other: Self) -> bool {
        self > other
    }

    #[inline(always)]
    fn where_or(self, so: bool, other: Self) -> Self {
        if so { self } else { other }
    }
}

impl Computed for f64 {
    #[inline(always)]
    fn fused(self, b: Self, c: Self) -> Self {
        f64::mul_add(self, b, c)
    }

    #[inline(always)]
    fn fused_less(self, b: Self, c: Self) -> Self {
        f64::mul_add(-self, b, c)
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        f64::max(self, other)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        f64::min(self, other)
    }

    #[inline(always)]
    fn or_larger(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn powi(self, n: i32) -> Self {
        f64::powi(self, n)
    }

    #[inline(always)]
    fn map_to<const K: usize>(self, f: impl Fn(f64) -> [f64; K]) -> [Self; K] {
        f(self)
    }

    #[inline(always)]
    fn map2(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        f(self, other)
    }

    #[inline(always)]
    fn equals(self, other: Self) -> bool {
        self == other
    }

    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }
}

impl Lanewise for f64x4 {
    #[inline(always)]
    fn all(self, x: f64) -> Self {
        f64x4::splat(x)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
}

impl<S: Level> Lanewise for Wide<S> {
    #[inline(always)]
    fn all(self, x: f64) -> Self {
        self.all(x)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self.mul_add(b, c)
    }
}

impl<S: Level> Judged for Wide<S> {
    type Answer = Mask<S>;

    #[inline(always)]
    fn below(self, other: Self) -> Mask<S> {
        self.lt(other)
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Mask<S> {
        self.le(other)
    }

    #[inline(always)]
    fn above(self, other: Self) -> Mask<S> {
        self.gt(other)
    }

    #[inline(always)]
    fn where_or(self, so: Mask<S>, other: Self) -> Self {
        so.select(self, other)
    }
}

impl<S: Level> Computed for Wide<S> {
    #[inline(always)]
    fn fused(self, b: Self, c: Self) -> Self {
        self.mul_add(b, c)
    }

    #[inline(always)]
    fn fused_less(self, b: Self, c: Self) -> Self {
        self.negative_mul_add(b, c)
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        self.sin_cos()
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.max(other)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.min(other)
    }

    #[inline(always)]
    fn or_larger(self, other: Self) -> Self {
        self.or_larger(other)
    }

    #[inline(always)]
    fn powi(self, n: i32) -> Self {
        self.powi(n)
    }

    #[inline(always)]
    fn map_to<const K: usize>(self, f: impl Fn(f64) -> [f64; K]) -> [Self; K] {
        let mut all = [self; K];
        for (lane, x) in self.as_slice().iter().enumerate() {
            all.iter_mut().zip(f(*x)).for_each(|(wide, number)| wide.as_mut_slice()[lane] = number);
        }
        all
    }

    #[inline(always)]
    fn map2(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        self.map2(other, f)
    }

    #[inline(always)]
    fn equals(self, other: Self) -> Mask<S> {
        self.equal(other)
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.as_slice()[lane]
    }
}

/// h q̇ + ½ h² q̈, by which a coordinate goes on from one end of a step h; `half` is ½ h, or −½ h
/// from the later end.
#[inline(always)]
pub(crate) fn gone<N: Lanewise>(h: N, half: N, [qd, qdd]: [N; 2]) -> N {
    h * half.mul_add(qdd, qd)
}

/// By how much the ends of a step h, each with q, q̇, q̈, miss one another, as one leads to the
/// other and back, and how far they are apart.
#[inline(always)]
pub(crate) fn misses<N: Lanewise>(h: N, [q, qd, qdd]: [N; 3], [r, rd, rdd]: [N; 3]) -> [N; 3] {
    let half = h.all(0.5) * h;
    let apart = r - q;
    [apart - gone(h, half, [qd, qdd]), apart - gone(h, h.all(-1.0) * half, [rd, rdd]), apart]
}
