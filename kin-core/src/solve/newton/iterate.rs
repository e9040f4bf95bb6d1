//! Implements Newton's iteration in one loop, for single positions and for mechanisms with more
//! equations than coordinates.

use crate::solve::options::{SolverOptions, Stop};
use crate::system::stop;

/// The end of an iteration with a correction within the tolerance.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::solve) enum Ending {
    /// A position.
    Found,
    /// No position: the equations are not satisfied.
    Failed,
    /// An equation jumps with the last correction, so the iteration continues on the other branch.
    Jumped,
}

/// A position that Newton's steps search.
pub(in crate::solve) trait Iterating {
    /// Evaluates C and C_q at the present point, and factors C_q if it has changed. Returns true if
    /// both are usable.
    fn look(&mut self) -> bool;

    /// Returns max |C_i| of unscaled rows.
    fn residual(&self) -> f64;

    /// Solves C_q dq = −C.
    fn solve(&mut self);

    /// Returns the largest component of the next correction in units of the sizes, or infinity if
    /// it is not finite.
    fn correction(&self) -> f64;

    /// Returns that component with an allowance for rounding of large coordinates, which is no
    /// error ([`stop::share`]).
    fn correction_but_for_rounding(&self, tolerance: f64) -> f64;

    /// Returns true if C = 0 holds within the tolerance, each row relative to its norm.
    fn is_met(&mut self, tolerance: f64) -> bool;

    /// Returns true if C = 0 holds and a correction that no longer shrinks is rounding of
    /// coordinates far from zero.
    fn rests(&mut self, correction: f64, tolerance: f64) -> bool;

    /// Returns true if an equation has jumped with the last step. Then the correction may have
    /// grown.
    fn has_changed_branch(&mut self) -> bool;

    /// Ends the converged iteration. The last correction is already computed, so applying it is
    /// free.
    fn end(&mut self) -> Ending;

    /// Applies the correction, or a part of it. Returns true if that was possible.
    fn step(&mut self, correction: f64) -> bool;
}

/// Runs Newton's method. Returns true if it ends at a position, whose matrix is then factored.
/// Corrections must shrink if the start is `near`.
#[inline(always)]
pub(in crate::solve) fn newton<I: Iterating>(
    point: &mut I,
    options: &SolverOptions,
    near: bool,
) -> bool {
    let mut previous = f64::INFINITY;
    // If only residuals count and steps need no test, corrections are not needed.
    let is_asked = options.rescue || matches!(options.stop, Stop::Converged { .. });
    let mut iteration = 0;
    loop {
        if !point.look() {
            return false;
        }
        if let Stop::ResidualOnly(bound) = options.stop
            && point.residual() < bound
        {
            return true;
        }
        point.solve();
        let mut correction = previous;
        if is_asked {
            let tolerance = options.tolerance();
            correction = point.correction();
            // A NaN is beyond the tolerance too.
            let is_within = correction <= tolerance;
            if !is_within {
                correction = point.correction_but_for_rounding(tolerance);
            }
            if let Stop::Converged { .. } = options.stop {
                let stalled = stop::has_stalled(correction, previous)
                    || (near && correction > 0.5 * previous && point.rests(correction, tolerance));
                if stalled || (correction <= tolerance && point.is_met(tolerance)) {
                    match point.end() {
                        Ending::Jumped => {}
                        ending => return ending == Ending::Found,
                    }
                    previous = f64::INFINITY;
                    iteration += 1;
                    continue;
                }
            }
            if near && correction > previous && !point.has_changed_branch() {
                return false;
            }
        }
        if iteration == options.max_iterations || !point.step(correction) {
            return false;
        }
        previous = correction;
        iteration += 1;
    }
}
