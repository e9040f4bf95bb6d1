//! The sweep: from one time to the next with prediction, in smaller steps of time where that is needed.

use super::predictor::{Last, Predictor};
use super::watch::Watch;
use super::{Failure, Newton, Options, Outcome, Steps, assembly, redundant};
use crate::error::{Error, Result};
use crate::fours::Fours;
use crate::motion::Motion;
use crate::system::System;

/// A step of time is halved at most this often before the sweep gives up.
const HALVINGS: i32 = 12;

/// Position, velocity and acceleration at each of the times.
pub(crate) fn run(system: &System, times: &[f64], options: &Options) -> Result<Motion> {
    options.check()?;
    check(times)?;
    if redundant::is_redundant(system) {
        return redundant::run(system, times, options);
    }
    let mut motion = Motion::new(system, times.len());
    let (mut sweep, mut watch) = (Sweep::new(system, options), Watch::default());
    for &t in times {
        let reached = sweep.reach(t).and_then(|outcome| Ok((outcome, watch.look(&sweep.newton, t)?)));
        match reached {
            Ok((outcome, crossed)) => motion.push(t, &sweep.newton, outcome, crossed),
            Err(error) => return Err(error.with_motion(motion).explained(system)),
        }
    }
    match sweep.newton.meant() {
        Ok(()) => Ok(motion),
        Err(error) => Err(error.with_motion(motion)),
    }
}

/// Times must be finite and strictly increasing or strictly decreasing.
pub(crate) fn check(times: &[f64]) -> Result<()> {
    let fail = |reason: String| Err(Error::InvalidTimes { reason });
    if times.is_empty() {
        return fail("there are none".to_string());
    }
    if let Some((k, t)) = times.iter().enumerate().find(|(_, t)| !t.is_finite()) {
        return fail(format!("number {k} is {t}; give finite times"));
    }
    let backwards = times.len() > 1 && times[1] < times[0];
    match times.windows(2).position(|pair| pair[0] == pair[1] || (pair[1] < pair[0]) != backwards) {
        Some(k) => fail(format!("{} is followed by {}; give times that only increase, or only decrease", times[k], times[k + 1])),
        None => Ok(()),
    }
}

/// The last solved time, its point, and the means to go on from it.
struct Sweep<'a> {
    newton: Newton<'a>,
    /// The last time with a solution, and its position, which a failure goes back to.
    last: Option<f64>,
    q: Fours,
    predictor: Predictor,
    /// Whether everything in hand is that of the last solution.
    untouched: bool,
}

impl<'a> Sweep<'a> {
    fn new(system: &'a System, options: &'a Options) -> Self {
        let n = system.n_coordinates();
        Sweep { newton: Newton::new(system, options), last: None, q: Fours::new(n, 0.0), predictor: Predictor::new(n), untouched: false }
    }

    /// Solves at time t, from the guess or from the last solved time.
    fn reach(&mut self, t: f64) -> Result<Outcome> {
        self.newton.steps_before = self.newton.steps;
        let outcome = match self.last {
            None => assembly::assemble(&mut self.newton, t)?,
            Some(from) => self.advance(from, t)?,
        };
        (self.last, self.untouched) = (Some(t), true);
        Ok(Outcome { iterations: self.newton.steps - self.newton.steps_before, ..outcome })
    }

    /// From one solved time to the next, in one step if that works.
    fn advance(&mut self, from: f64, to: f64) -> Result<Outcome> {
        let smallest = (to - from).abs() * 0.5_f64.powi(HALVINGS);
        let (mut t, mut h) = (from, to - from);
        loop {
            let target = if (to - t).abs() <= h.abs() * 1.001 { to } else { t + h };
            self.keep();
            match self.step(target - t, target, h.abs() <= smallest) {
                Ok(outcome) => {
                    self.settle(target - t, outcome);
                    self.newton.rates().map_err(|failure| self.newton.error(failure, target, Some(t)))?;
                    if target == to {
                        return Ok(outcome);
                    }
                    t = target;
                    h *= 2.0;
                }
                Err(failure) => {
                    if !self.newton.options.rescue || h.abs() <= smallest {
                        return Err(self.newton.error(failure, target, Some(t)));
                    }
                    self.newton.q.copy_from_slice(&self.q);
                    self.untouched = false;
                    h *= 0.5;
                }
            }
        }
    }

    /// The position in hand becomes the last one; a prediction writes all of the next anew.
    fn keep(&mut self) {
        if self.newton.options.predict {
            std::mem::swap(&mut self.q, &mut self.newton.q);
        } else if self.newton.options.rescue {
            self.q.copy_from_slice(&self.newton.q);
        }
    }

    /// One step of time by Newton steps from the prediction; damped from the last solution if it is the last resort.
    fn step(&mut self, h: f64, target: f64, last_resort: bool) -> std::result::Result<Outcome, Failure> {
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
            Err(_) if last_resort && newton.options.rescue => {
                newton.q.copy_from_slice(&self.q);
                newton.solve(target, Steps::Damped)
            }
            result => result,
        }
    }

    /// A step h has succeeded; the rates in hand are still those of the time before.
    fn settle(&mut self, h: f64, outcome: Outcome) {
        self.untouched = true;
        let newton = &mut self.newton;
        if !newton.options.predict {
            return;
        }
        if outcome.iterations > 0 {
            let last = Last { q: &self.q, qd: &newton.qd, qdd: &newton.qdd };
            self.predictor.compare(h, last, &newton.q, &newton.sizes);
        }
        self.predictor.advance(h, &mut newton.qd, &mut newton.qdd);
    }
}
