//! The sweep: from one time to the next with prediction, in smaller steps of time where that is needed.

use super::{Failure, Newton, Options, Outcome, Steps, assembly};
use crate::error::{Error, Result};
use crate::motion::Motion;
use crate::system::System;

/// A step of time is halved at most this often before the sweep gives up.
const HALVINGS: i32 = 12;

/// Position, velocity and acceleration at each of the times.
pub(crate) fn run(system: &System, times: &[f64], options: &Options) -> Result<Motion> {
    options.check()?;
    check(times)?;
    let mut motion = Motion::new(system, times.len());
    let mut sweep = Sweep::new(system, options);
    for &t in times {
        match sweep.reach(t) {
            Ok(outcome) => motion.push(t, &sweep.newton.q, &sweep.newton.qd, &sweep.newton.qdd, outcome),
            Err(error) => return Err(error.with_motion(motion)),
        }
    }
    Ok(motion)
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
    /// The last time with a solution.
    last: Option<f64>,
    q: Vec<f64>,
}

impl<'a> Sweep<'a> {
    fn new(system: &'a System, options: &'a Options) -> Self {
        Sweep { newton: Newton::new(system, options), last: None, q: vec![0.0; system.n_coordinates()] }
    }

    /// Solves at time t, from the guess or from the last solved time.
    fn reach(&mut self, t: f64) -> Result<Outcome> {
        self.newton.steps_before = self.newton.steps;
        let outcome = match self.last {
            None => assembly::assemble(&mut self.newton, t)?,
            Some(from) => self.advance(from, t)?,
        };
        self.last = Some(t);
        Ok(Outcome { iterations: self.newton.steps - self.newton.steps_before, ..outcome })
    }

    /// From one solved time to the next, in one step if that works.
    fn advance(&mut self, from: f64, to: f64) -> Result<Outcome> {
        let smallest = (to - from).abs() * 0.5_f64.powi(HALVINGS);
        let (mut t, mut h) = (from, to - from);
        loop {
            let target = if (to - t).abs() <= h.abs() * 1.001 { to } else { t + h };
            self.q.copy_from_slice(&self.newton.q);
            match self.step(target - t, target, h.abs() <= smallest) {
                Ok(outcome) => {
                    self.newton.rates(target).map_err(|failure| self.newton.error(failure, target, Some(t)))?;
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
                    h *= 0.5;
                }
            }
        }
    }

    /// One step of time by predicted Newton steps; damped from the last solution if it is the last resort.
    fn step(&mut self, h: f64, target: f64, last_resort: bool) -> std::result::Result<Outcome, Failure> {
        if self.newton.options.predict {
            self.predict(h);
        }
        let steps = if self.newton.options.rescue { Steps::Near } else { Steps::Full };
        match self.newton.solve(target, steps) {
            Err(_) if last_resort && self.newton.options.rescue => {
                self.newton.q.copy_from_slice(&self.q);
                self.newton.solve(target, Steps::Damped)
            }
            result => result,
        }
    }

    /// q + h q̇ + ½ h² q̈
    fn predict(&mut self, h: f64) {
        let newton = &mut self.newton;
        for ((q, qd), qdd) in newton.q.iter_mut().zip(&newton.qd).zip(&newton.qdd) {
            *q += h * (qd + 0.5 * h * qdd);
        }
    }
}
