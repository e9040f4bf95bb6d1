//! Computes sine and cosine over lanes.
//!
//! Kin reduces x to [−π/4, π/4] with π/2 in three parts of 53 bits and fused multiply-adds (Cody
//! and Waite). Then Kin evaluates the polynomials of fdlibm's `__kernel_sin` and `__kernel_cos`.
//! The error is at most 2 units in the last place for |x| ≤ 1e8. For larger or non-finite x, and on
//! machines without fused multiply-add, Kin calls the functions of f64 lane by lane.

use super::Level;
use super::number::{Mask, Wide, both};

/// π/2 in three parts.
const PARTS: [f64; 3] =
    [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// Beyond this lanes go one by one.   \[rad\]
const LARGEST: f64 = 1e8;

/// 1.5 · 2⁵²: added to a number it leaves the nearest integer in the last bits.
const ROUND: f64 = 6_755_399_441_055_744.0;

const SIN: [f64; 6] = [
    1.589_690_995_211_55e-10,
    -2.505_076_025_340_686_3e-8,
    2.755_731_370_707_006_8e-6,
    -0.000_198_412_698_298_579_5,
    0.008_333_333_333_322_49,
    -0.166_666_666_666_666_32,
];

const COS: [f64; 6] = [
    -1.135_964_755_778_819_5e-11,
    2.087_572_321_298_175e-9,
    -2.755_731_435_139_066_3e-7,
    2.480_158_728_947_673e-5,
    -0.001_388_888_888_887_411,
    0.041_666_666_666_666_6,
];

impl<S: Level> Wide<S> {
    /// Returns (sin x, cos x).
    #[inline(always)]
    pub fn sin_cos(self) -> (Self, Self) {
        let simd = self.0;
        if S::IS_SCALAR {
            return (self.map(f64::sin), self.map(f64::cos));
        }
        let round = Wide::splat(simd, ROUND);
        let rounded = self.mul_add(Wide::splat(simd, std::f64::consts::FRAC_2_PI), round);
        let k = rounded - round;
        let mut r = self;
        for part in PARTS {
            r = k.negative_mul_add(Wide::splat(simd, part), r);
        }
        let z = r * r;
        let sin = (polynomial(SIN, z) * z).mul_add(r, r);
        // 1 − z/2 is off by its rounding, which is added back.
        let half = Wide::splat(simd, 0.5) * z;
        let one = Wide::splat(simd, 1.0);
        let most = one - half;
        let cos = most + (z * z).mul_add(polynomial(COS, z), (one - most) - half);
        // Sine and cosine change places in odd quarters and their signs in two of four.
        let quarter = both!(simd, transmute_u64s_f64s, rounded.1);
        let odd = has_bit(simd, quarter, 1);
        let back = has_bit(simd, quarter, 2);
        let left = has_bit(simd, both!(simd, add_u64s, quarter, [simd.splat_u64s(1); 2]), 2);
        let s = odd.select(cos, sin);
        let c = odd.select(sin, cos);
        let mut sin = back.select(-s, s);
        let mut cos = left.select(-c, c);
        let large = !self.abs().le(Wide::splat(simd, LARGEST));
        if large.any() {
            (sin, cos) =
                (large.select(self.map(f64::sin), sin), large.select(self.map(f64::cos), cos));
        }
        (sin, cos)
    }
}

/// c₀ z⁵ + … + c₅
#[inline(always)]
fn polynomial<S: Level>(c: [f64; 6], z: Wide<S>) -> Wide<S> {
    let mut sum = Wide::splat(z.0, c[0]);
    for c in &c[1..] {
        sum = sum.mul_add(z, Wide::splat(z.0, *c));
    }
    sum
}

#[inline(always)]
fn has_bit<S: Level>(simd: S, bits: [S::u64s; 2], bit: u64) -> Mask<S> {
    let bit = [simd.splat_u64s(bit); 2];
    Mask(simd, both!(simd, equal_u64s, both!(simd, and_u64s, bits, bit), bit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::lanes::{Lanes, Level, WithLevel};

    /// Sine and cosine of all the numbers.
    struct All<'a>(&'a [f64]);

    impl WithLevel for All<'_> {
        type Output = Vec<(f64, f64)>;

        fn run<S: Level>(self, simd: S) -> Self::Output {
            let of = |group: &[f64]| {
                let mut x = Wide::splat(simd, 0.0);
                x.as_mut_slice().iter_mut().zip(group).for_each(|(x, value)| *x = *value);
                let (sin, cos) = x.sin_cos();
                sin.as_slice()
                    .iter()
                    .copied()
                    .zip(cos.as_slice().iter().copied())
                    .take(group.len())
                    .collect::<Vec<_>>()
            };
            self.0.chunks(Wide::<S>::LANES).flat_map(of).collect()
        }
    }

    /// How many units in the last place of `expected` lie between the two.
    fn units(found: f64, expected: f64) -> f64 {
        let unit = f64::from_bits(expected.abs().to_bits() + 1) - expected.abs();
        (found - expected).abs() / unit
    }

    #[test]
    fn sine_and_cosine_are_within_two_units_everywhere() {
        let mut numbers: Vec<f64> =
            vec![0.0, -0.0, 1e-300, f64::MIN_POSITIVE, 1e8, -1e8, 1.000001e8, 1e22, 1e300];
        // Next to multiples of π/2, where most is lost.
        numbers.extend((-4000..4000).map(|k| f64::from(k) * std::f64::consts::FRAC_PI_2));
        numbers.extend(
            (1..4000).map(|k| f64::from(k) * 15_915.494_309_189_535 * std::f64::consts::FRAC_PI_2),
        );
        numbers.extend((0..40_000).map(|k| (f64::from(k) * 0.618_033_988_7).fract() * 20.0 - 10.0));
        numbers.extend(
            (0..10_000)
                .map(|k| 10.0_f64.powf((f64::from(k) * 0.618_033_988_7).fract() * 24.0 - 12.0)),
        );
        for lanes in [2, 4, 8] {
            let Ok(found) = Lanes::Only(lanes).dispatch(All(&numbers)) else { continue };
            for (x, (sin, cos)) in numbers.iter().zip(found) {
                assert!(
                    units(sin, x.sin()) <= 2.0 && units(cos, x.cos()) <= 2.0,
                    "{lanes} lanes, x = {x}: {sin} {cos}"
                );
            }
        }
    }

    #[test]
    fn what_has_no_sine_has_none_here() {
        for lanes in [2, 4, 8] {
            let Ok(found) =
                Lanes::Only(lanes).dispatch(All(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY]))
            else {
                continue;
            };
            assert!(found.iter().all(|(sin, cos)| sin.is_nan() && cos.is_nan()));
        }
    }
}
