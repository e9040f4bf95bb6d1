//! Tests steps of redundant mechanisms by prediction, because a rectangular matrix has no
//! determinant.

use super::Position;
use crate::numbers::padded;
use crate::solve::follow::{Lever, Objection, Span, misses_too_far, turns_too_far};
use crate::solve::options::Follow;
use crate::system::evaluate::Instant;

impl Position<'_> {
    /// Returns the objection to the step to `target`, if there is one. It rotates something too
    /// far, the prediction from one end misses the other by too much, or drivers may move further
    /// in between. The test uses no signs of determinants, because rectangular matrices have none.
    pub(super) fn objection(&mut self, target: f64) -> Option<Objection> {
        if self.options.follow == Follow::Unchecked {
            return None;
        }
        let from = self.t;
        let pivot = self.solver.smallest_pivot();
        let [qd, qdd] = self.predictor.before();
        let to = [&self.q, &self.qd, &self.qdd];
        let [miss, reach] =
            padded::miss(target - from, [&self.last, qd, qdd], to, &self.shares, &self.turns);
        if turns_too_far(reach) {
            return Some(Objection::Long);
        }
        if misses_too_far(miss, pivot) {
            return Some(Objection::Missed(miss));
        }
        let mut drive = self.drive.take()?;
        let equations = self.model.equations;
        let hides = !drive.ends_suffice(from, target, pivot) && {
            let mut lever = LeastSquaresLever {
                instant: equations.instant_at(target, &self.q),
                position: self,
            };
            drive.hides(Span { equations, from, to: target, pivot }, &mut lever)
        };
        self.drive = Some(drive);
        hides.then_some(Objection::Hidden)
    }
}

/// The present matrix as a lever, by least squares.
struct LeastSquaresLever<'d, 'a> {
    instant: Instant,
    position: &'d mut Position<'a>,
}

impl Lever for LeastSquaresLever<'_, '_> {
    fn instant(&self) -> &Instant {
        &self.instant
    }

    fn moved(&mut self, first: usize, b: &[f64]) -> f64 {
        let position = &mut *self.position;
        position.rhs.fill(0.0);
        position.rhs.iter_mut().skip(first).zip(b).for_each(|(place, b)| *place = *b);
        position.solve_for_rhs();
        padded::largest_share(position.x.whole(), position.shares.whole())
    }

    fn bend(&mut self) -> f64 {
        f64::INFINITY
    }

    fn turned(&self) -> f64 {
        f64::INFINITY
    }

    fn is_singular_within(&mut self, _: f64) -> bool {
        true
    }
}
