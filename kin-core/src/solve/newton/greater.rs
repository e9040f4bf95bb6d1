//! Selects the branch of a position on a step by a rule that does not depend on the guess.
//!
//! Newton's method ends within rounding of the exact position. If a coordinate is on a step of an
//! equation, rounding decides the branch, and rounding depends on the guess, the engine, the grid
//! and other coordinates. If several branches are correct within rounding, Kin uses the branch with
//! the greater choices: a `floor` at an integer gives this integer, and a condition at equality is
//! true.

use super::Newton;
use crate::system::stop;

/// The permitted error of a coordinate from the stop rule, as a share of its size, in addition to
/// its rounding. \[-\]
const OFF: f64 = 1e-13;

/// The displacements of a coordinate over a step, as shares of that error, the smallest first.
/// \[-\]
const SHARES: [f64; 3] = [0.25, 0.5, 1.0];

/// The largest number of rounds: a coordinate that one step determines may be on the next step.
const ROUNDS: usize = 8;

/// The largest number of Newton steps from one branch to the next.
const STEPS: usize = 24;

/// The permitted residual of a satisfied row, as a multiple of its allowance, when its coordinates
/// move over a step. \[-\]
const HELD: f64 = 2.0;

/// A position on a step, on the branch with the greater choices.
struct Greater {
    q: Vec<f64>,
    /// The constraints with greater choices there, with all choices of each of them.
    choices: Vec<(usize, Vec<f64>)>,
}

impl Newton<'_> {
    /// Moves from the present position to the branch with the greater choices, as long as there is
    /// one that is correct within rounding. Returns true if the matrix of the present position is
    /// factored.
    #[cold]
    pub(in crate::solve) fn take_greater_choices(&mut self, t: f64) -> bool {
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

    /// Returns the present position with coordinates moved within rounding so that constraints make
    /// greater choices, the first constraint first. Returns `None` if there is no such position.
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

    /// Returns the coordinates of a constraint.
    fn columns(&self, number: usize) -> Vec<usize> {
        let constraint = &self.system.equations().blocks[number].constraint;
        let arguments = constraint.arguments();
        let all = arguments.iter().flat_map(|argument| self.system.layout().columns(argument));
        let mut columns: Vec<usize> = all.flatten().collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }

    /// Runs Newton's method from there. Satisfied rows are left alone, so coordinates that were
    /// moved within rounding stay. Returns false if it does not end.
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

    /// Returns true if constraints make the required choices.
    fn has_choices(&mut self, t: f64, greater: &Greater) -> bool {
        let q = self.q.to_vec();
        greater
            .choices
            .iter()
            .all(|(number, choices)| self.choices_at(t, &q, Some(*number)) == *choices)
    }

    /// Returns all choices of one constraint, or of all constraints, at a position to which it sets
    /// the instant.
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
