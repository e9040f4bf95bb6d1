//! Implements Newton's iteration on all equations of a redundant mechanism.

use super::Position;
use crate::numbers::padded;
use crate::solve::newton::iterate::{Ending, Iterating};
use crate::system::stop;

/// A position that must satisfy all rows.
pub(super) struct Rows<'d, 'a> {
    pub position: &'d mut Position<'a>,
    pub t: f64,
    pub iterations: usize,
    /// The position before the last step, if an equation can jump.
    pub before: Vec<f64>,
}

impl Iterating for Rows<'_, '_> {
    fn look(&mut self) -> bool {
        self.position.steps += 1;
        self.position.factor(self.t).is_some()
    }

    fn residual(&self) -> f64 {
        self.position.point.c.iter().fold(0.0, |m, c| c.abs().max(m))
    }

    fn solve(&mut self) {
        let Position { rhs, point, .. } = &mut *self.position;
        rhs.iter_mut().zip(&point.c).for_each(|(rhs, c)| *rhs = -c);
        self.position.solve_for_rhs();
    }

    fn correction(&self) -> f64 {
        padded::largest_share(self.position.x.whole(), self.position.shares.whole())
    }

    fn correction_but_for_rounding(&self, _: f64) -> f64 {
        self.correction()
    }

    /// Rows that contradict each other a little keep a nonzero C, so C is checked at the end.
    fn is_met(&mut self, _: f64) -> bool {
        true
    }

    #[cold]
    fn rests(&mut self, correction: f64, _: f64) -> bool {
        let Position { q, measures, solver, .. } = &*self.position;
        correction <= stop::resting(q, &measures.sizes, solver.smallest_pivot())
    }

    #[cold]
    fn has_changed_branch(&mut self) -> bool {
        let Position { model, instant, q, .. } = &mut *self.position;
        let equations = model.equations;
        let [mut before, mut now] = [Vec::new(), Vec::new()];
        if self.before.is_empty() {
            return false;
        }
        equations.set_time(self.t, instant);
        for (q, list) in [(&self.before[..], &mut before), (&q[..], &mut now)] {
            equations.set_position(q, instant);
            equations.sides(instant, list);
        }
        before != now
    }

    fn end(&mut self) -> Ending {
        let position = &mut *self.position;
        let met = position.model.met(&position.point, &position.q, &position.measures, &|_| true);
        padded::add(position.q.whole_mut(), position.x.whole());
        if met && position.has_jumped(self.t) {
            position.q.iter_mut().zip(&position.x).for_each(|(q, dq)| *q -= dq);
        }
        if met { Ending::Found } else { Ending::Failed }
    }

    fn step(&mut self, _: f64) -> bool {
        let equations = self.position.model.equations;
        if !equations.jumping().is_empty() || !equations.switching().is_empty() {
            self.before.clear();
            self.before.extend_from_slice(&self.position.q);
        }
        padded::add(self.position.q.whole_mut(), self.position.x.whole());
        self.iterations += 1;
        true
    }
}
