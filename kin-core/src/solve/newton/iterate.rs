//! Newton's iteration: one loop for a single position, for more equations than coordinates, and for several
//! cases in lanes, each of which ends by itself.

pub(super) mod single;

use super::options::{Options, Stop};
use crate::numbers::lanes::lanewise::{Answer, Judged, Lanewise};
use crate::system::stop;

/// A position that is looked for by Newton's steps, or one in each lane.
pub(super) trait Iterating {
    /// f64, or one number a lane.
    type Number: Judged;

    /// Evaluates C and C_q at the point in hand, and factors C_q where it has changed; true where both can be
    /// worked with, of those lanes that are still `open` and of those that are `done`.
    fn look(&mut self, open: Own<Self>, done: Own<Self>) -> [Own<Self>; 2];

    /// max |C_i|, rows as they are written.
    fn residual(&self) -> Self::Number;

    /// Solves C_q dq = −C.
    fn solve(&mut self);

    /// The largest of the next correction, each coordinate against its size; infinite where it is not finite.
    fn correction(&self) -> Self::Number;

    /// The same where rounding of large coordinates, which is no error, is allowed for ([`stop::share`]).
    fn correction_but_for_rounding(&self, tolerance: f64) -> Self::Number;

    /// True where C = 0 holds to the tolerance, each row by its own measure; the answer counts only where it
    /// is `asked`.
    fn is_met(&mut self, tolerance: f64, asked: Own<Self>) -> Own<Self>;

    /// The iteration has converged there with a correction in hand, which costs nothing any more; true where
    /// the position is one.
    fn end(&mut self, converged: Own<Self>) -> Own<Self>;

    /// q += dq, or less of it, where it is open; true where that could be done.
    fn step(&mut self, open: Own<Self>, correction: Self::Number) -> Own<Self>;
}

/// One answer a lane.
type Own<I> = <<I as Iterating>::Number as Judged>::Answer;

/// Newton's method where it is `wanted`; true where it ends at a position, whose matrix is factored then.
/// Corrections must shrink if the start is `near`. `one` is any number.
#[inline(always)]
pub(super) fn newton<I: Iterating>(
    point: &mut I,
    options: &Options,
    near: bool,
    (wanted, one): (Own<I>, I::Number),
) -> Own<I> {
    let (mut open, mut done, mut previous) = (wanted, wanted & !wanted, one.all(f64::INFINITY));
    // Where only residuals count and steps are taken as they come, nobody asks for corrections.
    let is_asked = options.rescue || matches!(options.stop, Stop::Converged { .. });
    let mut iteration = 0;
    loop {
        [open, done] = point.look(open, done);
        if let Stop::ResidualOnly(bound) = options.stop {
            let met = open & point.residual().below(one.all(bound));
            (done, open) = (done | met, open & !met);
        }
        if !open.any() {
            return done;
        }
        point.solve();
        let mut correction = previous;
        if is_asked {
            let tolerance = options.tolerance();
            correction = point.correction();
            let within = correction.at_most(one.all(tolerance));
            if (!within).any() {
                correction = correction.where_or(within, point.correction_but_for_rounding(tolerance));
            }
            if matches!(options.stop, Stop::Converged { .. }) {
                let [asked, stalled] = stop::ends(correction, previous, tolerance);
                let asked = open & asked;
                let met = if asked.any() { point.is_met(tolerance, asked) } else { asked };
                let converged = (asked & met) | (open & stalled);
                if converged.any() {
                    (done, open) = (done | point.end(converged), open & !converged);
                }
            }
            if near {
                open = open & !correction.above(previous);
            }
        }
        if !open.any() || iteration == options.max_iterations {
            return done;
        }
        previous = correction.where_or(open, previous);
        open = point.step(open, correction);
        if !open.any() {
            return done;
        }
        iteration += 1;
    }
}
