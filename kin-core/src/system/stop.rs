//! The stop rule of Newton's method and what rounding it allows, over any number: plain steps, redundant
//! mechanisms, several cases in lanes and programs all ask it here.

use crate::numbers::lanes::lanewise::{Answer, Judged, Lanewise};

/// A correction that stalls above this share of its coordinate is no rounding but a singular
/// position.   \[-\]
pub(crate) const STALL: f64 = 1e-9;

/// Quad roundings of a number in units of the tolerance: a number that large may be off by that much.
pub(crate) fn rounding(tolerance: f64) -> f64 {
    4.0 * f64::EPSILON / tolerance
}

/// True where the position is found: C = 0 is met and the next correction within the tolerance, or that has
/// stalled. `met` is asked only where the first says nothing yet.
#[inline(always)]
pub(crate) fn is_converged<N: Judged>(
    correction: N,
    previous: N,
    tolerance: f64,
    open: N::Answer,
    met: impl FnOnce() -> N::Answer,
) -> N::Answer {
    let (within, stalled) =
        (correction.at_most(correction.all(tolerance)), has_stalled(correction, previous));
    if (open & within & !stalled).any() { (within & met()) | stalled } else { stalled }
}

/// Newton's steps shrink by squares: one this short that has stopped shrinking is rounding, and no more can
/// be had.
#[inline(always)]
pub(crate) fn has_stalled<N: Judged>(correction: N, previous: N) -> N::Answer {
    correction.above(correction.all(0.5) * previous) & correction.at_most(correction.all(STALL))
}

/// The largest share of a correction, `plain` if that is within the tolerance; elsewhere rounding of large
/// coordinates, which is no error, is allowed for: the largest [`share`].
#[inline(always)]
pub(crate) fn largest_share<N: Judged>(plain: N, tolerance: f64, allowed_for: impl FnOnce() -> N) -> N {
    let within = plain.at_most(plain.all(tolerance));
    if (!within).any() { plain.where_or(within, allowed_for()) } else { plain }
}

/// |dq| of a coordinate against its size, with `rounding` of it allowed for.
#[inline(always)]
pub(crate) fn share<N: Lanewise>(dq: N, q: N, size: N, rounding: N) -> N {
    dq.abs() / rounding.mul_add(q.abs(), size)
}

/// How far each row may be off: by the tolerance of its norm, and by what rounding of q makes,
/// Σ_j |∂C_i/∂q_j q_j| ε.
pub(crate) fn allowances<N: Lanewise>(
    tolerance: f64,
    norms: &[N],
    entries: impl Iterator<Item = (usize, usize, N)>,
    q: &[N],
    allowed: &mut Vec<N>,
) {
    allowed.clear();
    allowed.extend(norms.iter().map(|norm| norm.all(tolerance) * *norm));
    for (row, column, value) in entries {
        let share = value.all(tolerance * rounding(tolerance));
        allowed[row] = allowed[row] + share * (value * q[column]).abs();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::lanes::{Lanes, Level, Wide, WithLevel};

    /// Corrections and those before them, with what the rule says where C is met and where it is not.
    const CASES: [(f64, f64, [bool; 2]); 7] = [
        (1e-14, 1e-7, [true, false]),
        (1e-13, 1e-7, [true, false]),
        (2e-13, 1e-7, [false, false]),
        (2e-13, 3e-13, [true, true]),
        (0.9e-9, 1e-9, [true, true]),
        (1.1e-9, 1.2e-9, [false, false]),
        (f64::NAN, 1.0, [false, false]),
    ];

    struct InLanes;

    impl WithLevel for InLanes {
        type Output = ();

        fn run<S: Level>(self, simd: S) {
            for (k, met) in [true, false].into_iter().enumerate() {
                let lanes = Wide::<S>::LANES;
                for cases in CASES.chunks(lanes) {
                    let (mut correction, mut previous) = (Wide::splat(simd, 1.0), Wide::splat(simd, 1.0));
                    for (lane, case) in cases.iter().enumerate() {
                        (correction.as_mut_slice()[lane], previous.as_mut_slice()[lane]) = (case.0, case.1);
                    }
                    let all = crate::numbers::lanes::Mask::splat(simd, true);
                    let met = || crate::numbers::lanes::Mask::splat(simd, met);
                    let found = is_converged(correction, previous, 1e-13, all, met);
                    for (lane, case) in cases.iter().enumerate() {
                        assert_eq!(found.lane(lane), case.2[k], "{case:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_number_and_a_lane_stop_by_the_same_rule() {
        for (correction, previous, expected) in CASES {
            let found = [true, false].map(|met| is_converged(correction, previous, 1e-13, true, || met));
            assert_eq!(found, expected, "{correction} after {previous}");
        }
        assert!(Lanes::Best.dispatch(InLanes).is_ok() || cfg!(not(target_arch = "x86_64")));
    }

    #[test]
    fn rounding_of_a_large_number_is_allowed_for() {
        let mut allowed = Vec::new();
        allowances(1e-13, &[2.0, 1.0], [(0, 1, 3.0), (0, 0, -1.0)].into_iter(), &[1e4, 1e6], &mut allowed);
        let expected = [2e-13 + 4.0 * f64::EPSILON * (3e6 + 1e4), 1e-13];
        assert!(allowed.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 1e-12 * b), "{allowed:?}");
        let rounding = rounding(1e-13);
        assert!(largest_share(1e-9, 1e-13, || share(1e-9, 1e6, 1.0, rounding)) < 1e-12);
        assert!(largest_share(1e-9, 1e-13, || share(1e-9, 0.0, 1.0, rounding)) == 1e-9);
    }
}
