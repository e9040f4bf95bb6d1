//! Positions on a step: one rule chooses the branch, whatever the guess was.
//!
//! Newton's method ends within rounding of the exact position. Where a coordinate rests on a step
//! of an equation, that rounding decides the branch, and it depends on the guess: on the engine, on
//! the grid, on other coordinates. So of branches that are right to rounding the one with the
//! greater choices is taken: a whole number that is met counts as reached, a condition that is met
//! counts as true.

use crate::solve::newton::Newton;
use crate::system::stop;

/// A coordinate may be off by this share of its size beside rounding of itself: what the stop rule
/// leaves. \[-\]
const OFF: f64 = 1e-13;

/// Shares of that by which a coordinate is moved over a step, the smallest first.   \[-\]
const SHARES: [f64; 3] = [0.25, 0.5, 1.0];

/// Rounds at most: a coordinate that one step gives may rest on the next step.
const ROUNDS: usize = 8;

/// Newton steps at most from one branch to the next.
const STEPS: usize = 24;

/// A row that was met may be off by this many times the allowed amount where its coordinates are
/// moved over a step.   \[-\]
const HELD: f64 = 2.0;

/// A position on a step, on the branch with the greater choices.
struct Greater {
    q: Vec<f64>,
    /// The constraints whose choices are greater there, with all choices of each of them.
    choices: Vec<(usize, Vec<f64>)>,
}

impl Newton<'_> {
    /// Goes from the position in hand to the branch with the greater choices as long as there is
    /// one that is right to rounding; true if the matrix of the position in hand is factored.
    #[cold]
    pub(in crate::solve::newton) fn take_greater_choices(&mut self, t: f64) -> bool {
        for _ in 0..ROUNDS {
            let Some(greater) = self.greater(t) else { return true };
            let kept = self.q.to_vec();
            self.q.copy_from_slice(&greater.q);
            if !(self.settle(t) && self.has_choices(t, &greater)) {
                return self.return_to(&kept, t);
            }
        }
        true
    }

    /// The position in hand with coordinates moved by rounding such that constraints make greater
    /// choices, the first constraint's before those of the next, if there are any.
    fn greater(&mut self, t: f64) -> Option<Greater> {
        let system = self.system;
        let mut q = self.q.to_vec();
        let mut changed = Vec::new();
        let equations = system.equations();
        let mut all = self.choices_at(t, &q, None);
        for &number in equations.jumping() {
            let mut here = self.choices_at(t, &q, Some(number));
            if here.is_empty() {
                continue;
            }
            for column in self.columns(number) {
                let off = OFF * (stop::rounding(OFF) * q[column].abs() + self.sizes[column]);
                for moved in SHARES.into_iter().flat_map(|share| [share * off, -share * off]) {
                    let kept = std::mem::replace(&mut q[column], self.q[column] + moved);
                    let there = self.choices_at(t, &q, Some(number));
                    if there > here {
                        let others = self.choices_at(t, &q, None);
                        if others > all {
                            (all, here) = (others, there);
                            changed.push(number);
                            break;
                        }
                    }
                    q[column] = kept;
                }
            }
        }
        changed.dedup();
        let choices: Vec<(usize, Vec<f64>)> = changed
            .into_iter()
            .map(|number| (number, self.choices_at(t, &q, Some(number))))
            .collect();
        self.instant_at(t, false);
        (!choices.is_empty()).then_some(Greater { q, choices })
    }

    /// The coordinates that a constraint reads.
    fn columns(&self, number: usize) -> Vec<usize> {
        let constraint = &self.system.equations().blocks[number].constraint;
        let arguments = constraint.arguments();
        let all = arguments.iter().flat_map(|argument| self.system.layout().columns(argument));
        let mut columns: Vec<usize> = all.flatten().collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }

    /// Newton's method from there, rows that are met being left as they are: coordinates that were
    /// moved by rounding stay where they are. False if it does not end.
    fn settle(&mut self, t: f64) -> bool {
        let mut allowed = Vec::new();
        for _ in 0..STEPS {
            if self.linearize(t).is_err() || !self.linear.factor() {
                return false;
            }
            self.allow(OFF, &mut allowed);
            let mut met = true;
            for (own, allowed) in self.linear.rhs_mut().iter_mut().zip(&allowed) {
                let is_met = own.abs() <= HELD * allowed;
                *own = if is_met { 0.0 } else { *own };
                met &= is_met;
            }
            if met {
                return true;
            }
            self.linear.solve();
            self.correct();
            self.steps += 1;
        }
        false
    }

    /// True if constraints make the choices that were looked for.
    fn has_choices(&mut self, t: f64, greater: &Greater) -> bool {
        let q = self.q.to_vec();
        greater
            .choices
            .iter()
            .all(|(number, choices)| self.choices_at(t, &q, Some(*number)) == *choices)
    }

    /// All choices of a constraint, or of all of them, at a position that the instant is set to.
    fn choices_at(&mut self, t: f64, q: &[f64], number: Option<usize>) -> Vec<f64> {
        let equations = self.system.equations();
        if self.instant.t() != t {
            equations.set_time(t, &mut self.instant);
        }
        equations.set_position(q, &mut self.instant);
        let mut choices = Vec::new();
        match number {
            Some(number) => {
                equations.choices_of(&equations.blocks[number], &self.instant, &mut choices)
            }
            None => equations.choices(&self.instant, &mut choices),
        }
        choices
    }
}
