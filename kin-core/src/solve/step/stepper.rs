//! Implements the step-by-step solver: Newton's method from a prediction, and a test that the step
//! stays on its branch.

use super::advance::{Asked, Effort, Stepping, advance};
use super::predictor::{Last, Predictor};
use crate::coordinates::units::Units;
use crate::numbers::padded::{self, Padded};
use crate::outcome::error::{Result, UnfollowedReason};
use crate::solve::follow::{Check, Objection, SingularPosition};
use crate::solve::newton::{Failure, Newton, Outcome, Steps, first_position, largest};
use crate::solve::options::{Follow, SolverOptions};
use crate::system::System;

/// If a step in which nothing moves by more than this fails its test, it leads past a singular
/// position. \[-\]
pub(super) const SHORT: f64 = 0.05;

/// The same limit for a step of this share of the requested step, in which hardly anything moves.
/// \[-\]
const AT_REST: f64 = 1.0 / 64.0;

/// The last solved time and its point, with workspace buffers to continue.
pub(in crate::solve) struct Stepper<'a> {
    pub newton: Newton<'a>,
    /// The last time with a solution and its position, to which a failure returns.
    pub(super) last: Option<f64>,
    pub(super) q: Padded,
    /// The position of the last failure.
    pub(super) failed: Padded,
    pub(super) predictor: Predictor,
    /// The smallest pivot of C_q at the first time.   \[-\]
    pub first_pivot: Option<f64>,
    /// True if all present numbers are still those of the last solution.
    pub(super) untouched: bool,
    /// The test of each step; `None` if the options disable it.
    pub(super) check: Option<Check>,
    /// The singular positions since the last time, and the number of earlier bifurcations.
    pub passed: Vec<SingularPosition>,
    pub(super) bifurcations: usize,
    pub(super) effort: Effort,
}

/// The reason why a step of time failed.
pub(in crate::solve) enum Trouble {
    Failed(Failure),
    Objected(Objection),
}

impl<'a> Stepper<'a> {
    pub fn new(system: &'a System, options: &'a SolverOptions) -> Self {
        let n = system.n_coordinates();
        Stepper {
            newton: Newton::new(system, options),
            last: None,
            q: Padded::new(n, 0.0),
            failed: Padded::new(n, 0.0),
            predictor: Predictor::new(n),
            first_pivot: None,
            untouched: false,
            check: (options.follow != Follow::Unchecked).then(|| Check::new(system)),
            passed: Vec::new(),
            bifurcations: 0,
            effort: Effort::new(n, options.effort),
        }
    }

    /// Returns the stepper of the same equations in another copy of the system.
    #[inline(always)]
    pub(super) fn on<'b>(self, system: &'b System, options: &'b SolverOptions) -> Stepper<'b> {
        let Stepper {
            newton,
            last,
            q,
            failed,
            predictor,
            first_pivot,
            untouched,
            check,
            passed,
            bifurcations,
            effort,
        } = self;
        let newton = newton.on(system, options);
        Stepper {
            newton,
            last,
            q,
            failed,
            predictor,
            first_pivot,
            untouched,
            check,
            passed,
            bifurcations,
            effort,
        }
    }

    /// Solves at time t, from the guess or from the last solved time.
    pub fn reach(&mut self, t: f64) -> Result<Outcome> {
        self.newton.steps_before = self.newton.steps;
        let outcome = match self.last {
            None => {
                let outcome = first_position::assemble(&mut self.newton, t)?;
                self.first_pivot = Some(self.newton.linear.smallest_pivot());
                self.check.iter_mut().for_each(|check| check.accept(&self.newton));
                outcome
            }
            Some(from) => {
                self.effort.grant();
                advance(self, Asked { from, to: t })?
            }
        };
        (self.last, self.untouched) = (Some(t), true);
        self.newton.linear.confirm();
        Ok(Outcome { iterations: self.newton.steps - self.newton.steps_before, ..outcome })
    }

    /// Returns the shortest step of time.
    fn shortest(&self, asked: Asked) -> f64 {
        match self.check {
            None => self.newton.options.smallest_step(asked.from, asked.to),
            Some(_) => asked.shortest(),
        }
    }

    /// Returns true if a step has the minimum length. Then Newton's steps are damped.
    #[cold]
    fn is_last_resort(&self, h: f64, asked: Asked) -> bool {
        self.check.is_none() && h.abs() <= self.shortest(asked)
    }

    /// Returns how far anything moves in a step h from the last solution to `target`: by its
    /// velocities, and by drivers, which may have been at rest.
    #[cold]
    pub(super) fn moved(&mut self, h: f64, target: f64) -> f64 {
        let newton = &mut self.newton;
        let rates = newton.qd.iter().zip(&newton.qdd).zip(newton.shares());
        let by_rates = largest(
            rates.map(|((qd, qdd), share)| (h * qd).abs().max((0.5 * h * h * qdd).abs()) * share),
        );
        let known = newton.linearize(target).is_ok() && newton.linear.factor();
        newton.linear.solve();
        let driven = if known {
            padded::largest_share(newton.linear.whole_solution(), newton.shares().whole())
        } else {
            0.0
        };
        newton.linear.revoke();
        by_rates.max(driven)
    }

    /// Makes one step of time by Newton steps from the prediction; as a last resort by damped steps
    /// from the last solution.
    #[inline(always)]
    fn step(&mut self, h: f64, target: f64, asked: Asked) -> std::result::Result<Outcome, Failure> {
        let newton = &mut self.newton;
        let steps = if newton.options.rescue { Steps::Near } else { Steps::Full };
        let result = if newton.options.predict {
            let last = Last { q: &self.q, qd: &newton.qd, qdd: &newton.qdd };
            self.predictor.predict(h, last, &mut newton.q);
            newton.solve(target, steps)
        } else if self.untouched {
            newton.solve_on(target, steps)
        } else {
            newton.solve(target, steps)
        };
        match result {
            Err(_) if self.newton.options.rescue && self.is_last_resort(h, asked) => {
                self.newton.q.copy_from_slice(&self.q);
                self.newton.solve(target, Steps::Damped)
            }
            result => result,
        }
    }

    /// Returns true if velocities of earlier times are needed.
    #[inline(always)]
    fn remembers(&self) -> bool {
        self.newton.options.predict || self.check.is_some()
    }

    /// Records that a step h has succeeded. The present velocities still belong to the earlier time
    /// and become the past.
    #[inline(always)]
    fn settle(&mut self, h: f64, outcome: Outcome) {
        self.untouched = true;
        if !self.remembers() {
            return;
        }
        let newton = &mut self.newton;
        if newton.options.predict && outcome.iterations > 0 {
            let last = Last { q: &self.q, qd: &newton.qd, qdd: &newton.qdd };
            self.predictor.compare(h, last, &newton.q, &newton.sizes);
        }
        self.predictor.advance(h, &mut newton.qd, &mut newton.qdd);
    }
}

impl Stepping for Stepper<'_> {
    type Trouble = Trouble;

    /// Makes the present position the last one. A prediction overwrites all of the next one.
    #[inline(always)]
    fn keep(&mut self) {
        if self.newton.options.predict {
            std::mem::swap(&mut self.q, &mut self.newton.q);
        } else {
            padded::copy(self.q.whole_mut(), self.newton.q.whole());
        }
    }

    /// Makes and tests one step of time with its velocities. After a failure the present velocities
    /// are those before the step.
    #[inline(always)]
    fn attempt(
        &mut self,
        h: f64,
        target: f64,
        asked: Asked,
    ) -> std::result::Result<Outcome, Trouble> {
        let outcome = self.step(h, target, asked).map_err(Trouble::Failed)?;
        self.settle(h, outcome);
        let remembers = self.remembers();
        let newton = &mut self.newton;
        let judged = newton.rates().map_err(Trouble::Failed).and_then(|()| {
            let Some(check) = &mut self.check else { return Ok(()) };
            let [qd, qdd] = self.predictor.before();
            check.judge(newton, h, [&self.q, qd, qdd]).map_err(Trouble::Objected)
        });
        if judged.is_err() && remembers {
            self.predictor.retreat(&mut newton.qd, &mut newton.qdd);
        }
        judged.map(|()| outcome)
    }

    #[inline(always)]
    fn confirm(&mut self) {
        self.newton.linear.confirm();
    }

    /// Restores the last solution and discards everything found beyond it.
    #[cold]
    fn go_back(&mut self) {
        self.failed.copy_from_slice(&self.newton.q);
        self.newton.q.copy_from_slice(&self.q);
        self.newton.linear.revoke();
        self.untouched = false;
    }

    /// Returns true if steps of time to `target` that are shorter than this will not help, from the
    /// coordinates that move in it.
    fn is_short(&mut self, h: f64, target: f64, asked: Asked, trouble: &Trouble) -> bool {
        let shortest = self.shortest(asked);
        if self.check.is_none() {
            return !self.newton.options.rescue || h.abs() <= shortest;
        }
        let unseen = match trouble {
            // Shorter steps always help.
            Trouble::Objected(Objection::Long | Objection::Hidden) => f64::INFINITY,
            Trouble::Objected(Objection::Missed(off)) => *off,
            _ => 0.0,
        };
        let moved = self.moved(h, target).max(unseen);
        // If everything is at rest, velocities say little.
        let moves = moved >= 0.1 * SHORT || h.abs() <= AT_REST * asked.whole();
        (moved <= SHORT && moves) || h.abs() <= shortest
    }

    fn give_up(
        &mut self,
        trouble: Trouble,
        t: f64,
        target: f64,
        goal: f64,
        asked: Asked,
    ) -> Result<Outcome> {
        self.pass(trouble, t, target, goal, asked)
    }

    fn effort(&mut self) -> &mut Effort {
        &mut self.effort
    }

    fn objection(trouble: &Trouble) -> Option<UnfollowedReason> {
        match trouble {
            Trouble::Objected(objection) => objection.of_branches(),
            Trouble::Failed(_) => None,
        }
    }

    fn units(&self) -> &Units {
        self.newton.system.unit_words()
    }
}
