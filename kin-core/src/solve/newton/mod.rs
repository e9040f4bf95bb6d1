//! Solves C(q, t) = 0 by Newton's method at one time, and q̇ and q̈ with the matrix of the last
//! convergence check.
//!
//! The module `iterate` contains the iteration for mechanisms with as many equations as coordinates
//! (`single`) and for redundant mechanisms ([`crate::solve::redundant`]).

mod driven;
pub(crate) mod first_position;
mod greater;
pub(super) mod iterate;
mod rates;
mod report;
mod single;

use crate::linear::{Linear, RANK};
use crate::numbers::padded::{self, Padded};
use crate::solve::options::{SolverOptions, Stop};
use crate::system::System;
use crate::system::evaluate::{Bad, Instant};
use crate::system::{scale::Turned, stop};
use single::Single;

/// A position with a pivot below this value cannot be distinguished from a singular one. \[-\]
pub(crate) const DOUBTFUL: f64 = RANK;

/// Pivots of the recorded elimination differ from those of a complete one by less than this factor.
/// Below it the complete elimination decides. \[-\]
pub(crate) const SIMILAR: f64 = 30.0;

/// A row that is off by more than this share of its norm has jumped with the last correction,
/// whatever the stop rule: see
/// [`Equations::has_jumped`](crate::system::evaluate::Equations::has_jumped). \[-\]
const JUMPS: f64 = 1e-13;

/// The largest rotation of a body in a damped step. \[rad\]
const TURN: f64 = 1.0;

/// The largest number of halvings of one damped step.
const HALVINGS: usize = 24;

/// The reason why an attempt failed, as data.
#[derive(Clone, Debug)]
pub(crate) enum Failure {
    NotFinite(Bad),
    Singular,
    /// A constraint on the wrong branch, by its index.
    WrongBranch(usize),
    NoConvergence {
        row: usize,
        residual: f64,
    },
}

/// The data of a successful attempt.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outcome {
    pub iterations: usize,
    pub residual: f64,
}

/// The kind of Newton steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Steps {
    /// Full steps without a condition.
    Full,
    /// Full steps that must shrink, because the start is near.
    Near,
    /// Steps that are shortened until the residual falls.
    Damped,
}

/// The present point, with workspace buffers. A step allocates nothing.
pub(crate) struct Newton<'a> {
    pub system: &'a System,
    pub options: &'a SolverOptions,
    pub q: Padded,
    pub qd: Padded,
    pub qdd: Padded,
    /// q⃛ if it is computed, otherwise empty.
    pub qddd: Padded,
    pub c: Padded,
    before: Vec<f64>,
    pub instant: Instant,
    pub linear: Linear,
    /// s_j, the characteristic size of each coordinate.
    pub sizes: Vec<f64>,
    /// The slopes from which the sizes were computed.
    turned: Turned,
    /// 1 / s_j of each coordinate.
    shares: Padded,
    /// The allowance of each row.
    allowed: Vec<f64>,
    /// max |C_i| at the last linearization.
    residual: f64,
    /// The number of Newton steps of all attempts; `before` is the number before the present time.
    pub steps: usize,
    pub steps_before: usize,
    /// True if a constraint can jump when coordinates move.
    jumps: bool,
    /// True if a constraint can jump or has a kink.
    has_branches: bool,
}

impl<'a> Newton<'a> {
    pub(crate) fn new(system: &'a System, options: &'a SolverOptions) -> Self {
        let n = system.n_coordinates();
        let equations = system.equations();
        Newton {
            system,
            options,
            q: system.initial().into(),
            qd: Padded::new(n, 0.0),
            qdd: Padded::new(n, 0.0),
            qddd: Padded::new(if options.jerk { n } else { 0 }, 0.0),
            c: Padded::new(n, 0.0),
            before: vec![0.0; n],
            instant: equations.instant(),
            linear: system.linear(),
            sizes: vec![1.0; n],
            turned: Turned::default(),
            shares: Padded::new(n, 1.0),
            allowed: vec![0.0; n],
            residual: 0.0,
            steps: 0,
            steps_before: 0,
            jumps: !equations.jumping().is_empty(),
            has_branches: !equations.jumping().is_empty() || !equations.switching().is_empty(),
        }
    }

    /// Returns the present point for the same equations in another copy of the system.
    #[inline(always)]
    pub(in crate::solve) fn on<'b>(
        self,
        system: &'b System,
        options: &'b SolverOptions,
    ) -> Newton<'b> {
        let Newton {
            q,
            qd,
            qdd,
            qddd,
            c,
            before,
            instant,
            linear,
            sizes,
            turned,
            shares,
            allowed,
            residual,
            steps,
            steps_before,
            jumps,
            has_branches,
            ..
        } = self;
        Newton {
            system,
            options,
            q,
            qd,
            qdd,
            qddd,
            c,
            before,
            instant,
            linear,
            sizes,
            turned,
            shares,
            allowed,
            residual,
            steps,
            steps_before,
            jumps,
            has_branches,
        }
    }

    /// Sets the characteristic sizes of the coordinates.
    fn set_sizes(&mut self, sizes: Vec<f64>) {
        self.linear.set_sizes(&sizes);
        self.shares.iter_mut().zip(&sizes).for_each(|(share, size)| *share = size.recip());
        self.sizes = sizes;
    }

    /// Runs Newton's method from the present point. After success the matrix at the solution is
    /// factored.
    pub(crate) fn solve(&mut self, t: f64, steps: Steps) -> Result<Outcome, Failure> {
        self.iterate(t, steps, false)
    }

    /// Runs Newton's method from the solution of another time: at first it evaluates only what
    /// depends on time.
    pub(crate) fn solve_on(&mut self, t: f64, steps: Steps) -> Result<Outcome, Failure> {
        self.iterate(t, steps, true)
    }

    fn iterate(&mut self, t: f64, steps: Steps, still: bool) -> Result<Outcome, Failure> {
        let options = self.options;
        let near = steps == Steps::Near;
        let mut single =
            Single { newton: self, t, steps, still, iterations: 0, failure: None, left: None };
        let mut found = iterate::newton(&mut single, options, near);
        let Single { iterations, failure, left, .. } = single;
        if let Some(left) = left {
            found = self.return_to(&left.q, t);
        }
        if found && self.jumps {
            found = self.take_greater_choices(t);
        }
        if found {
            self.regular(iterations)
        } else {
            Err(failure.unwrap_or_else(|| self.failure()))
        }
    }

    /// Returns the outcome, unless the position is singular within rounding, or on a wrong branch.
    fn regular(&mut self, iterations: usize) -> Result<Outcome, Failure> {
        if self.linear.is_provisional() && !self.measured_here() {
            return Err(Failure::Singular);
        }
        let is_doubtful =
            self.linear.smallest_pivot() < SIMILAR * DOUBTFUL || self.linear.is_faint();
        if is_doubtful && self.is_singular() {
            return Err(Failure::Singular);
        }
        if let Some(block) = self.system.equations().first_wrong(&self.instant) {
            return Err(Failure::WrongBranch(block));
        }
        Ok(Outcome { iterations, residual: self.residual })
    }

    /// Scales rows and columns by their present values and those at earlier positions, because an
    /// iterate far away may have had much larger ones. Factors C_q again and returns false if it is
    /// singular.
    #[cold]
    fn measured_here(&mut self) -> bool {
        self.linear.revoke();
        self.linear.measure() && self.linear.factor()
    }

    /// Returns true if a diagnosis would call the rank of C_q at the present point less than n.
    #[cold]
    fn is_singular(&self) -> bool {
        let model = self.system.model();
        let t = self.instant.t();
        let values = model.linearize(&self.q, t).map(|point| point.values);
        values.is_ok_and(|values| model.rank(&values, &model.measure(&self.q, t)) < self.q.len())
    }

    /// Returns why the iteration did not end. If C is satisfied and every step is still long, C_q
    /// is practically singular.
    fn failure(&mut self) -> Failure {
        if matches!(self.options.stop, Stop::Converged { .. }) && self.met() {
            return Failure::Singular;
        }
        let (row, residual) = self.worst();
        Failure::NoConvergence { row, residual }
    }

    /// Evaluates C and C_q at the present point, and the scales of its rows.
    pub(crate) fn linearize(&mut self, t: f64) -> Result<(), Failure> {
        let equations = self.system.equations();
        if self.instant.t() != t {
            equations.set_time(t, &mut self.instant);
        }
        equations.set_position(&self.q, &mut self.instant);
        equations.linearize(&self.q, &self.instant, &mut self.c, self.linear.values_mut());
        self.measure(true)
    }

    /// Evaluates C and C_q if only the time has changed. Returns true if C_q has changed.
    fn relinearize(&mut self, t: f64) -> Result<bool, Failure> {
        let equations = self.system.equations();
        equations.set_time(t, &mut self.instant);
        let changed =
            equations.relinearize(&self.q, &self.instant, &mut self.c, self.linear.values_mut());
        self.measure(changed).map(|()| changed)
    }

    /// Sets the right side to −C and scales C, and C_q if `matrix` is true. Returns an error if a
    /// number is not finite.
    #[inline(always)]
    fn measure(&mut self, matrix: bool) -> Result<(), Failure> {
        self.residual = padded::oppose(self.linear.whole_rhs_mut(), self.c.whole());
        if (!matrix || self.linear.measure()) && self.residual < f64::INFINITY {
            Ok(())
        } else {
            self.finite()
        }
    }

    /// Returns an error unless C and C_q are finite.
    #[cold]
    fn finite(&self) -> Result<(), Failure> {
        self.system.equations().finite(&self.c, self.linear.values()).map_err(Failure::NotFinite)
    }

    /// Returns true if C = 0 holds within the tolerance, each row relative to its norm. If the stop
    /// rule is the residual, only the residual counts.
    fn met(&mut self) -> bool {
        match self.options.stop {
            Stop::Converged { tolerance } => self.is_within(tolerance),
            Stop::ResidualOnly(bound) => self.residual < bound,
        }
    }

    /// Returns true if C = 0 holds within the tolerance, each row relative to its norm, with an
    /// allowance for rounding of q.
    fn is_within(&mut self, tolerance: f64) -> bool {
        padded::largest_share(self.c.whole(), self.linear.row_units().whole()) <= tolerance || {
            let mut allowed = std::mem::take(&mut self.allowed);
            self.allow(tolerance, &mut allowed);
            let within = self.c.iter().zip(&allowed).all(|(c, allowed)| c.abs() <= *allowed);
            self.allowed = allowed;
            within
        }
    }

    /// Computes the allowance of each row at the present point.
    pub(crate) fn allow(&self, tolerance: f64, allowed: &mut Vec<f64>) {
        let entries = self.system.equations().entries.iter().zip(self.linear.values());
        let entries =
            entries.filter_map(|(entry, value)| entry.map(|(row, column)| (row, column, *value)));
        stop::allowances(tolerance, self.linear.norms(), entries, &self.q, allowed);
    }

    /// Adds the correction: q += dq.
    fn correct(&mut self) {
        padded::add(self.q.whole_mut(), self.linear.whole_solution());
    }

    /// Adds the last correction, after which nothing is evaluated again except constraints that can
    /// jump. Returns false if one has jumped.
    #[inline(always)]
    fn correct_last(&mut self) -> bool {
        if self.jumps {
            return self.correct_before_a_jump();
        }
        self.correct();
        true
    }

    #[cold]
    fn correct_before_a_jump(&mut self) -> bool {
        self.before.copy_from_slice(&self.q);
        self.correct();
        let mut allowed = std::mem::take(&mut self.allowed);
        self.allow(JUMPS, &mut allowed);
        let has_jumped = self.system.equations().has_jumped(&self.q, &mut self.instant, &allowed);
        self.allowed = allowed;
        !has_jumped
    }

    /// Sets the instant to the present position, or to the one before the last step.
    fn instant_at(&mut self, t: f64, before: bool) {
        let equations = self.system.equations();
        if self.instant.t() != t {
            equations.set_time(t, &mut self.instant);
        }
        equations.set_position(if before { &self.before } else { &self.q }, &mut self.instant);
    }

    /// Restores a position that was satisfied before. Returns true if its matrix is regular.
    #[cold]
    fn return_to(&mut self, q: &[f64], t: f64) -> bool {
        self.q.copy_from_slice(q);
        self.linearize(t).is_ok() && self.linear.factor()
    }

    /// Adds λ dq with the largest λ = 1, ½, ¼, … for which Σ (C_i / norm_i)² falls (Armijo) and
    /// nothing rotates too far.
    fn damped(&mut self) -> Result<(), Failure> {
        let equations = self.system.equations();
        let units = &self.system.layout().units;
        let dq = self.linear.solution();
        let turns = dq
            .iter()
            .zip(units)
            .filter(|(_, unit)| **unit != crate::coordinates::units::Unit::Metre)
            .map(|(dq, _)| dq.abs());
        let mut lambda = (TURN / largest(turns)).min(1.0);
        let merit = self.merit();
        let failure = self.failure();
        self.before.copy_from_slice(&self.q);
        for _ in 0..HALVINGS {
            for ((q, before), dq) in self.q.iter_mut().zip(&self.before).zip(self.linear.solution())
            {
                *q = before + lambda * dq;
            }
            equations.set_position(&self.q, &mut self.instant);
            let finite = equations.residual(&self.q, &self.instant, &mut self.c).is_ok();
            if finite && self.merit() <= (1.0 - 0.5 * lambda) * merit {
                return Ok(());
            }
            lambda *= 0.5;
        }
        Err(failure)
    }

    /// Returns Σ (C_i / norm_i)² with the norms of the last linearization.
    pub(crate) fn merit(&self) -> f64 {
        self.c.iter().zip(self.linear.norms()).map(|(c, norm)| (c / norm).powi(2)).sum()
    }

    /// Returns 1 / s_j of each coordinate.
    pub(crate) fn shares(&self) -> &Padded {
        &self.shares
    }
}

/// Returns the largest of nonnegative numbers, or 0 if there are none. NaN counts as infinite.
pub(crate) fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, |m, x| {
        if x <= m {
            m
        } else if x.is_nan() {
            f64::INFINITY
        } else {
            x
        }
    })
}
