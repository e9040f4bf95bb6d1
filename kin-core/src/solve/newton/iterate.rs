//! Newton's iteration: one loop for a single position and for more equations than coordinates.

mod greater;
pub(super) mod single;

use super::options::{SolverOptions, Stop};
use crate::system::stop;

/// The end of an iteration whose correction is within the tolerance.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Ending {
    /// A position.
    Found,
    /// None: the equations are not met.
    Failed,
    /// An equation jumps with the last correction, so the iteration goes on from the other branch.
    Jumped,
}

/// A position that is looked for by Newton's steps.
pub(super) trait Iterating {
    /// Evaluates C and C_q at the point in hand, and factors C_q where it has changed; true where
    /// both can be worked with.
    fn look(&mut self) -> bool;

    /// max |C_i|, rows as they are written.
    fn residual(&self) -> f64;

    /// Solves C_q dq = −C.
    fn solve(&mut self);

    /// The largest of the next correction, each coordinate against its size; infinite where it is
    /// not finite.
    fn correction(&self) -> f64;

    /// The same where rounding of large coordinates, which is no error, is allowed for
    /// ([`stop::share`]).
    fn correction_but_for_rounding(&self, tolerance: f64) -> f64;

    /// True where C = 0 holds to the tolerance, each row by its own measure.
    fn is_met(&mut self, tolerance: f64) -> bool;

    /// True where C = 0 holds and a correction that no longer shrinks is rounding of coordinates
    /// that are far from zero.
    fn rests(&mut self, correction: f64, tolerance: f64) -> bool;

    /// True if an equation has jumped or passed a kink with the last step: then the correction may
    /// have grown by that.
    fn has_changed_branch(&mut self) -> bool;

    /// The iteration has converged with a correction in hand, which costs nothing any more.
    fn end(&mut self) -> Ending;

    /// q += dq, or less of it; true where that could be done.
    fn step(&mut self, correction: f64) -> bool;
}

/// Newton's method; true where it ends at a position, whose matrix is factored then. Corrections
/// must shrink if the start is `near`.
#[inline(always)]
pub(super) fn newton<I: Iterating>(point: &mut I, options: &SolverOptions, near: bool) -> bool {
    let mut previous = f64::INFINITY;
    // Where only residuals count and steps are taken as they come, nobody asks for corrections.
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
            // Not a number is beyond the tolerance too.
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
