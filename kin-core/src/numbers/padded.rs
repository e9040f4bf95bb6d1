//! Stores vectors in groups of four, and implements the loops over vectors that every step uses.
//!
//! No loop has a remainder, because for a short vector a remainder takes more time than the work
//! itself.

use std::ops::{Deref, DerefMut};

use wide::f64x4;

use super::lanes::lanewise::misses;

/// Four numbers that are computed together.
pub(crate) type Quad = [f64; 4];

/// A vector of n numbers in groups of four; the numbers beyond n stay zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Padded {
    n: usize,
    quads: Vec<Quad>,
}

impl Padded {
    /// Makes n numbers of value x.
    pub(crate) fn new(n: usize, x: f64) -> Self {
        let mut all = Padded { n, quads: vec![[0.0; 4]; n.div_ceil(4)] };
        all.fill(x);
        all
    }

    /// Returns all numbers, with the zeros at the end.
    pub(crate) fn whole(&self) -> &[Quad] {
        &self.quads
    }

    pub(crate) fn whole_mut(&mut self) -> &mut [Quad] {
        &mut self.quads
    }
}

impl From<&[f64]> for Padded {
    fn from(numbers: &[f64]) -> Self {
        let mut all = Padded::new(numbers.len(), 0.0);
        all.copy_from_slice(numbers);
        all
    }
}

impl Deref for Padded {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.quads.as_flattened()[..self.n]
    }
}

impl DerefMut for Padded {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.quads.as_flattened_mut()[..self.n]
    }
}

impl<'a> IntoIterator for &'a Padded {
    type Item = &'a f64;
    type IntoIter = std::slice::Iter<'a, f64>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// Sets x = −y; returns the largest |y|, or ∞ if a number is not finite.
#[inline]
pub(crate) fn oppose(x: &mut [Quad], y: &[Quad]) -> f64 {
    let mut seen = Seen::default();
    each_mut(x, y, |x, y| {
        let y = f64x4::new(*y);
        *x = (-y).to_array();
        seen.see(y);
    });
    seen.largest()
}

/// Returns the largest |x_i| · share_i over finite shares, or 0 if there is none; returns ∞ if a
/// number is not finite.
pub(crate) fn largest_share(x: &[Quad], shares: &[Quad]) -> f64 {
    let mut seen = Seen::default();
    each(x, shares, |four, shares| seen.see(f64x4::new(*four) * f64x4::new(*shares)));
    seen.largest()
}

/// Returns the largest |x_i|, or ∞ if a number is not finite.
pub(crate) fn largest(x: &[Quad]) -> f64 {
    let mut seen = Seen::default();
    x.iter().for_each(|four| seen.see(f64x4::new(*four)));
    seen.largest()
}

/// Returns true if |x_i| ≤ limit_i everywhere.
#[inline]
pub(crate) fn inside(x: &[Quad], limits: &[Quad]) -> bool {
    let mut all = f64x4::ZERO.simd_eq(f64x4::ZERO);
    each(x, limits, |four, limits| all &= f64x4::new(*four).abs().simd_le(f64x4::new(*limits)));
    all.all()
}

/// Sets x = y; returns true if all numbers are finite.
#[inline]
pub(crate) fn take(x: &mut [Quad], y: &[Quad]) -> bool {
    let mut odd = f64x4::ZERO;
    each_mut(x, y, |x, y| {
        *x = *y;
        odd += f64x4::new(*y) * f64x4::ZERO;
    });
    odd.reduce_add() == 0.0
}

/// Sets x = y.
pub(crate) fn copy(x: &mut [Quad], y: &[Quad]) {
    each_mut(x, y, |x, y| *x = *y);
}

/// Sets x += y.
#[inline]
pub(crate) fn add(x: &mut [Quad], y: &[Quad]) {
    each_mut(x, y, |x, y| *x = (f64x4::new(*x) + f64x4::new(*y)).to_array());
}

/// Returns how far q + h q̇ + ½ h² q̈ from either end of a step h is from the other end, weighted
/// by shares, and how far the ends are apart, weighted by `turns`; the largest of each. If a value
/// is NaN, the first result is NaN too, which the larger of two numbers alone would hide.
pub(crate) fn miss(
    h: f64,
    from: [&Padded; 3],
    to: [&Padded; 3],
    shares: &Padded,
    turns: &Padded,
) -> [f64; 2] {
    let h = f64x4::splat(h);
    let mut miss = f64x4::ZERO;
    let mut reach = f64x4::ZERO;
    let mut all = f64x4::ZERO;
    let [q, qd, qdd] = from.map(|x| x.whole().iter());
    let [r, rd, rdd] = to.map(|x| x.whole().iter());
    let ends = q.zip(qd).zip(qdd).zip(r).zip(rd).zip(rdd);
    for ((((((q, qd), qdd), r), rd), rdd), (share, turn)) in
        ends.zip(shares.whole().iter().zip(turns.whole()))
    {
        let [q, qd, qdd, r, rd, rdd, share, turn] =
            [q, qd, qdd, r, rd, rdd, share, turn].map(|four| f64x4::new(*four));
        let [forward, back, d] = misses(h, [q, qd, qdd], [r, rd, rdd]);
        miss = miss.fast_max(forward.abs().fast_max(back.abs()) * share);
        reach = reach.fast_max(d.abs() * turn);
        all += forward + back;
    }
    let [miss, reach] = [miss, reach].map(|most| most.to_array().into_iter().fold(0.0, f64::max));
    [if all.reduce_add().is_nan() { f64::NAN } else { miss }, reach]
}

/// Defines a loop over the groups of two vectors in parallel. Vectors of mechanisms are short. The
/// code therefore lists the cases of up to three groups, and of the remainder after blocks of four
/// groups: a loop that LLVM unrolls takes longer to begin and to end than to run.
macro_rules! walk {
    ($name:ident, $few:ident, $x:ty, $as_chunks:ident) => {
        #[inline(always)]
        fn $name<'a>(
            x: $x,
            y: &'a [Quad],
            mut see: impl FnMut(<$x as IntoIterator>::Item, &'a Quad),
        ) {
            if x.len() < 4 {
                return $few(x, y, see);
            }
            let (x, end) = x.$as_chunks::<4>();
            let (y, y_end) = y.as_chunks::<4>();
            for ([a, b, c, d], [p, q, r, s]) in x.into_iter().zip(y) {
                see(a, p);
                see(b, q);
                see(c, r);
                see(d, s);
            }
            $few(end, y_end, see);
        }

        #[inline(always)]
        fn $few<'a>(
            x: $x,
            y: &'a [Quad],
            mut see: impl FnMut(<$x as IntoIterator>::Item, &'a Quad),
        ) {
            match (x, y) {
                ([a, b, c], [p, q, r]) => {
                    see(a, p);
                    see(b, q);
                    see(c, r);
                }
                ([a, b], [p, q]) => {
                    see(a, p);
                    see(b, q);
                }
                ([a], [p]) => see(a, p),
                _ => {}
            }
        }
    };
}

walk!(each, few, &'a [Quad], as_chunks);
walk!(each_mut, few_mut, &'a mut [Quad], as_chunks_mut);

/// The largest numbers so far, and a number that is 0 while all numbers are finite.
#[derive(Default)]
struct Seen {
    largest: f64x4,
    odd: f64x4,
}

impl Seen {
    #[inline(always)]
    fn see(&mut self, four: f64x4) {
        self.largest = four.abs().fast_max(self.largest);
        self.odd += four * f64x4::ZERO;
    }

    #[inline(always)]
    fn largest(&self) -> f64 {
        let [a, b, c, d] = self.largest.to_array();
        let larger = |x: f64, y: f64| if x > y { x } else { y };
        if self.odd.reduce_add() == 0.0 {
            larger(larger(a, b), larger(c, d))
        } else {
            f64::INFINITY
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_counts() {
        for n in 0..12 {
            let all = |x: f64| Padded::new(n, x);
            let mut x = all(0.0);
            x.iter_mut().enumerate().for_each(|(k, x)| *x = 1.0 - 0.1 * k as f64);
            let x = x;
            let halves = all(0.5);
            let limits = all(5.0);
            let largest = |x: &Padded| oppose(all(0.0).whole_mut(), x.whole());
            let share = |x: &Padded| largest_share(x.whole(), halves.whole());
            assert_eq!((largest(&x), share(&x)), if n > 0 { (1.0, 0.5) } else { (0.0, 0.0) });
            assert!(inside(x.whole(), x.whole()));
            for k in 0..n {
                for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let mut x = x.clone();
                    x[k] = odd;
                    assert_eq!((largest(&x), share(&x)), (f64::INFINITY, f64::INFINITY));
                    assert!(
                        !inside(x.whole(), limits.whole())
                            && !take(all(0.0).whole_mut(), x.whole())
                    );
                }
                let mut x = x.clone();
                x[k] = -7.0;
                assert!(
                    largest(&x) == 7.0 && share(&x) == 3.5 && !inside(x.whole(), limits.whole())
                );
            }
            let mut sum = x.clone();
            let mut opposite = all(3.0);
            let mut taken = all(3.0);
            assert!(take(taken.whole_mut(), x.whole()) && taken == x);
            add(sum.whole_mut(), x.whole());
            oppose(opposite.whole_mut(), x.whole());
            assert!((0..n).all(|k| sum[k] == 2.0 * x[k] && opposite[k] == -x[k]));
        }
    }
}
