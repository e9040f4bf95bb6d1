//! Implements the stop rule of Newton's method and its allowance for rounding, for any type of
//! number.
//!
//! The step-by-step solver, redundant mechanisms and compiled programs share this rule.

use crate::numbers::lanes::lanewise::Judged;

/// A correction that stalls above this share of its coordinate is not rounding but a singular
/// position. \[-\]
pub(crate) const STALL: f64 = 1e-9;

/// Pivots below this value belong to a singular position, which Newton's method does not reach.
/// \[-\]
const SMALLEST: f64 = 1e-3;

/// Returns the rounding of a number in units of the tolerance: four times the rounding of one
/// operation.
pub(crate) fn rounding(tolerance: f64) -> f64 {
    4.0 * f64::EPSILON / tolerance
}

/// Returns true if a correction has stopped shrinking. Newton's steps shrink quadratically, so a
/// short correction that no longer shrinks is rounding.
///
/// The rule takes no closure, because LLVM compiles a call that remains without the machine's
/// instructions.
#[inline(always)]
pub(crate) fn has_stalled<N: Judged>(correction: N, previous: N) -> N::Answer {
    correction.above(correction.all(0.5) * previous) & correction.at_most(correction.all(STALL))
}

/// Returns the largest correction that is rounding of q itself. If the equations are satisfied and
/// a correction no longer shrinks, Newton's method cannot do better far from the origin or near a
/// singular position. q is in units of its sizes; pivots below [`SMALLEST`] count as [`SMALLEST`].
/// \[-\]
pub(crate) fn resting(q: &[f64], sizes: &[f64], pivot: f64) -> f64 {
    let farthest = q.iter().zip(sizes).fold(0.0_f64, |most, (q, size)| most.max((q / size).abs()));
    16.0 * f64::EPSILON * farthest / pivot.clamp(SMALLEST, 1.0)
}

/// Returns |dq| of a coordinate relative to its size, after an allowance of `rounding` times the
/// coordinate.
#[inline(always)]
pub(crate) fn share(dq: f64, q: f64, size: f64, rounding: f64) -> f64 {
    dq.abs() / (rounding * q.abs() + size)
}

/// Returns the allowance of each row: the tolerance of its norm plus the effect of rounding of q,
/// Σ_j |∂C_i/∂q_j q_j| ε.
#[inline(always)]
pub(crate) fn allowances(
    tolerance: f64,
    norms: &[f64],
    entries: impl Iterator<Item = (usize, usize, f64)>,
    q: &[f64],
    allowed: &mut Vec<f64>,
) {
    allowed.clear();
    allowed.extend(norms.iter().map(|norm| tolerance * norm));
    for (row, column, value) in entries {
        allowed[row] += tolerance * rounding(tolerance) * (value * q[column]).abs();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::lanes::{Lanes, Level, Wide, WithLevel};

    /// Corrections and those before them, with whether they have stalled.
    const CASES: [(f64, f64, bool); 7] = [
        (1e-14, 1e-7, false),
        (2e-13, 1e-7, false),
        (2e-13, 4e-13, false),
        (2e-13, 3e-13, true),
        (0.9e-9, 1e-9, true),
        (1.1e-9, 1.2e-9, false),
        (f64::NAN, 1.0, false),
    ];

    struct InLanes;

    impl WithLevel for InLanes {
        type Output = ();

        fn run<S: Level>(self, simd: S) {
            for cases in CASES.chunks(Wide::<S>::LANES) {
                let mut correction = Wide::splat(simd, 1.0);
                let mut previous = Wide::splat(simd, 1.0);
                for (lane, case) in cases.iter().enumerate() {
                    (correction.as_mut_slice()[lane], previous.as_mut_slice()[lane]) =
                        (case.0, case.1);
                }
                let stalled = has_stalled(correction, previous);
                for (lane, case) in cases.iter().enumerate() {
                    assert_eq!(stalled.lane(lane), case.2, "{case:?}");
                }
            }
        }
    }

    #[test]
    fn a_number_and_a_lane_stop_by_the_same_rule() {
        for (correction, previous, expected) in CASES {
            assert_eq!(
                has_stalled(correction, previous),
                expected,
                "{correction} after {previous}"
            );
        }
        assert!(Lanes::Best.dispatch(InLanes).is_ok() || cfg!(not(target_arch = "x86_64")));
    }

    #[test]
    fn rounding_of_a_large_number_is_allowed_for() {
        let mut allowed = Vec::new();
        allowances(
            1e-13,
            &[2.0, 1.0],
            [(0, 1, 3.0), (0, 0, -1.0)].into_iter(),
            &[1e4, 1e6],
            &mut allowed,
        );
        let expected = [2e-13 + 4.0 * f64::EPSILON * (3e6 + 1e4), 1e-13];
        assert!(
            allowed.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 1e-12 * b),
            "{allowed:?}"
        );
        let rounding = rounding(1e-13);
        assert!(share(1e-9, 1e6, 1.0, rounding) < 1e-12 && share(1e-9, 0.0, 1.0, rounding) == 1e-9);
    }
}
