//! Numbers of one case and of several side by side: a rule that is written over these is written once.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

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

/// h q̇ + ½ h² q̈, by which a coordinate goes on from one end of a step h; `half` is ½ h, or −½ h from the
/// later end.
#[inline(always)]
pub(crate) fn gone<N: Lanewise>(h: N, half: N, [qd, qdd]: [N; 2]) -> N {
    h * half.mul_add(qdd, qd)
}

/// By how much the ends of a step h, each with q, q̇, q̈, miss one another, as one leads to the other and
/// back, and how far they are apart.
#[inline(always)]
pub(crate) fn misses<N: Lanewise>(h: N, [q, qd, qdd]: [N; 3], [r, rd, rdd]: [N; 3]) -> [N; 3] {
    let (half, apart) = (h.all(0.5) * h, r - q);
    [apart - gone(h, half, [qd, qdd]), apart - gone(h, h.all(-1.0) * half, [rd, rdd]), apart]
}
