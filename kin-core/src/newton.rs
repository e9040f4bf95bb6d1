//! Newton's method on C(q, t) = 0, and q̇, q̈ from the matrix of its last check.

pub(crate) mod assembly;
mod driven;
mod options;
pub(crate) mod sweep;

pub use options::{Options, Report, Stop};

use crate::error::Error;
use crate::linear::{Linear, Singular};
use crate::system::evaluate::Bad;
use crate::system::{Solution, System};

/// A correction that stalls above this share of its coordinate is no rounding but a singular position.   \[-\]
const STALL: f64 = 1e-9;

/// A position with a pivot below this cannot be told from a singular one: rounding ε of C moves q by ε / pivot, and so the pivot by about
/// as much, which is itself at √ε = 1.5e-8.   \[-\]
const DOUBTFUL: f64 = 1e-7;

/// A row that is off by more than this, of the norm of the row, is told as not met where C_q is singular.   \[-\]
const UNMET: f64 = 1e-2;

/// A damped step turns no body by more than this.   \[rad\]
const TURN: f64 = 1.0;

/// Halvings of one damped step.
const HALVINGS: usize = 24;

/// Why an attempt failed, without text yet.
#[derive(Clone, Debug)]
pub(crate) enum Failure {
    NotFinite(Bad),
    Singular(Singular),
    NoConvergence { row: usize, residual: f64 },
}

/// What an attempt that succeeded did.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outcome {
    pub iterations: usize,
    pub residual: f64,
    pub row: usize,
}

/// How an attempt takes its steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Steps {
    /// Full steps, whatever they do.
    Full,
    /// Full steps that must shrink: the start is near.
    Near,
    /// Steps shortened until the residual falls.
    Damped,
}

/// The point in hand and the space to work in; stepping allocates nothing.
pub(crate) struct Newton<'a> {
    pub system: &'a System,
    pub options: &'a Options,
    pub q: Vec<f64>,
    pub qd: Vec<f64>,
    pub qdd: Vec<f64>,
    pub c: Vec<f64>,
    dq: Vec<f64>,
    before: Vec<f64>,
    pub states: Vec<f64>,
    rates: Vec<f64>,
    pub linear: Linear,
    /// s_j, the characteristic size of each coordinate.
    pub sizes: Vec<f64>,
    /// What is left of what each row is allowed to be off.
    left: Vec<f64>,
    /// max |C_i| at the last linearization.
    residual: f64,
    /// Newton steps of all attempts, and how many there were before this time.
    pub steps: usize,
    pub steps_before: usize,
}

impl<'a> Newton<'a> {
    pub(crate) fn new(system: &'a System, options: &'a Options) -> Self {
        let (n, equations) = (system.n_coordinates(), system.equations());
        Newton {
            system,
            options,
            q: system.initial().to_vec(),
            qd: vec![0.0; n],
            qdd: vec![0.0; n],
            c: vec![0.0; n],
            dq: vec![0.0; n],
            before: vec![0.0; n],
            states: equations.plan.states(),
            rates: equations.plan.rates(),
            linear: Linear::new(n, equations.entries.iter().copied(), &equations.constants),
            sizes: vec![1.0; n],
            left: vec![0.0; n],
            residual: 0.0,
            steps: 0,
            steps_before: 0,
        }
    }

    /// Newton's method from the point in hand; on success the matrix at the solution is factored.
    pub(crate) fn solve(&mut self, t: f64, steps: Steps) -> Result<Outcome, Failure> {
        let mut previous = f64::INFINITY;
        for iteration in 0..=self.options.max_iterations {
            self.linearize(t)?;
            self.linear.factor().map_err(Failure::Singular)?;
            if let Stop::ResidualOnly(bound) = self.options.stop
                && self.residual < bound
            {
                return self.regular(iteration);
            }
            let correction = self.correction();
            if self.converged(correction, previous) {
                return self.regular(iteration);
            }
            if iteration == self.options.max_iterations || (steps == Steps::Near && correction > previous) {
                break;
            }
            previous = correction;
            self.step(t, if correction <= STALL { Steps::Full } else { steps })?;
            self.steps += 1;
        }
        Err(self.failure())
    }

    /// The outcome, unless the position is singular for all that rounding lets one tell.
    fn regular(&mut self, iterations: usize) -> Result<Outcome, Failure> {
        if self.linear.smallest_pivot() < DOUBTFUL {
            return Err(Failure::Singular(self.linear.diagnose()));
        }
        let (row, residual) = self.worst();
        Ok(Outcome { iterations, residual, row })
    }

    /// Why the iteration came to no end: where C is met and still every step is long, C_q is singular for all practical purposes.
    fn failure(&mut self) -> Failure {
        if matches!(self.options.stop, Stop::Converged { .. }) && self.met() {
            return Failure::Singular(self.linear.diagnose());
        }
        let (row, residual) = self.worst();
        Failure::NoConvergence { row, residual }
    }

    /// C and C_q at the point in hand, and the measures of its rows.
    pub(crate) fn linearize(&mut self, t: f64) -> Result<(), Failure> {
        let equations = self.system.equations();
        equations.plan.set_states(&self.q, &mut self.states);
        equations.linearize(t, &self.states, &mut self.c, self.linear.values_mut());
        self.residual = largest_of(self.c.iter().copied());
        if self.linear.measure() && self.residual < f64::INFINITY {
            return Ok(());
        }
        equations.finite(&self.c, self.linear.values()).map_err(Failure::NotFinite)
    }

    /// C_q dq = −C; gives max |dq_j|, each against what may be asked of it, or more if that is within the tolerance.
    fn correction(&mut self) -> f64 {
        for (rhs, c) in self.linear.rhs_mut().iter_mut().zip(&self.c) {
            *rhs = -c;
        }
        self.linear.solve();
        self.dq.copy_from_slice(self.linear.solution());
        let shares = largest_of(self.dq.iter().zip(&self.sizes).map(|(dq, size)| dq / size));
        let Stop::Converged { tolerance } = self.options.stop else { return shares };
        if shares <= tolerance {
            return shares;
        }
        let rounding = rounding(tolerance);
        largest(self.dq.iter().zip(&self.q).zip(&self.sizes).map(|((dq, q), size)| dq.abs() / (size + rounding * q.abs())))
    }

    /// The stop rule that tests the correction too.
    fn converged(&mut self, correction: f64, previous: f64) -> bool {
        let Stop::Converged { tolerance } = self.options.stop else { return false };
        // Newton's steps shrink by squares: one this short that has stopped shrinking is rounding, and no more can be had.
        (self.met() && correction <= tolerance) || (correction > 0.5 * previous && correction <= STALL)
    }

    /// Whether C = 0 holds to the tolerance, each row by its own measure.
    fn met(&mut self) -> bool {
        let tolerance = match self.options.stop {
            Stop::Converged { tolerance } => tolerance,
            Stop::ResidualOnly(bound) => return self.residual < bound,
        };
        let rows = self.c.iter().zip(self.linear.norms());
        rows.fold(true, |met, (c, norm)| met & (c.abs() <= tolerance * norm)) || self.met_but_for_rounding(tolerance)
    }

    /// The same where rounding of q, which makes Σ_j |∂C_i/∂q_j| |q_j| ε of row i, is allowed for.
    fn met_but_for_rounding(&mut self, tolerance: f64) -> bool {
        for ((left, c), norm) in self.left.iter_mut().zip(&self.c).zip(self.linear.norms()) {
            *left = tolerance * norm - c.abs();
        }
        for (entry, value) in self.system.equations().entries.iter().zip(self.linear.values()) {
            if let Some((row, column)) = *entry {
                self.left[row] += tolerance * rounding(tolerance) * (value * self.q[column]).abs();
            }
        }
        self.left.iter().all(|left| *left >= 0.0)
    }

    /// The equation that is far from being met at the point in hand, if one is.
    fn unmet(&self) -> Option<String> {
        let shares = self.c.iter().zip(self.linear.norms()).map(|(c, norm)| c.abs() / norm).enumerate();
        let (row, share) = shares.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst });
        (share > UNMET).then(|| self.system.equations().equation(row))
    }

    /// The row with the largest |C_i|, and that; rows as they are written.
    fn worst(&self) -> (usize, f64) {
        let rows = self.c.iter().map(|c| c.abs()).enumerate();
        rows.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst })
    }

    /// q += dq, or less of it.
    fn step(&mut self, t: f64, steps: Steps) -> Result<(), Failure> {
        if steps == Steps::Damped && !self.met() {
            return self.damped(t);
        }
        self.q.iter_mut().zip(&self.dq).for_each(|(q, dq)| *q += dq);
        Ok(())
    }

    /// q += λ dq with the largest λ = 1, ½, ¼, … that lets Σ (C_i / norm_i)² fall (Armijo) and turns nothing too far.
    fn damped(&mut self, t: f64) -> Result<(), Failure> {
        let equations = self.system.equations();
        let units = &self.system.layout().units;
        let turns = self.dq.iter().zip(units).filter(|(_, unit)| **unit != crate::layout::Unit::Metre).map(|(dq, _)| dq.abs());
        let mut lambda = (TURN / largest(turns)).min(1.0);
        let merit = self.merit();
        let failure = self.failure();
        self.before.copy_from_slice(&self.q);
        for _ in 0..HALVINGS {
            for ((q, before), dq) in self.q.iter_mut().zip(&self.before).zip(&self.dq) {
                *q = before + lambda * dq;
            }
            equations.plan.set_states(&self.q, &mut self.states);
            let finite = equations.residual(t, &self.states, &mut self.c).is_ok();
            if finite && self.merit() <= (1.0 - 0.5 * lambda) * merit {
                return Ok(());
            }
            lambda *= 0.5;
        }
        Err(failure)
    }

    /// Σ (C_i / norm_i)² with the norms of the last linearization.
    pub(crate) fn merit(&self) -> f64 {
        self.c.iter().zip(self.linear.norms()).map(|(c, norm)| (c / norm).powi(2)).sum()
    }

    /// q̇ from C_q q̇ = −C_t and q̈ from C_q q̈ = Q_d, with the matrix that [`Newton::solve`] has left factored.
    pub(crate) fn rates(&mut self, t: f64) -> Result<(), Failure> {
        let equations = self.system.equations();
        equations.velocity_rhs(t, &self.states, self.linear.rhs_mut()).map_err(Failure::NotFinite)?;
        self.linear.solve();
        self.qd.copy_from_slice(self.linear.solution());
        self.overflow(&self.qd, "q'")?;
        equations.plan.set_rates(&self.qd, &mut self.rates);
        equations.acceleration_rhs(t, &self.states, &self.rates, self.linear.rhs_mut()).map_err(Failure::NotFinite)?;
        self.linear.solve();
        self.qdd.copy_from_slice(self.linear.solution());
        self.overflow(&self.qdd, "q''")
    }

    /// What is in hand, to keep.
    pub(crate) fn solution(self, t: f64, outcome: Outcome) -> Solution {
        let report = Report {
            iterations: self.steps,
            residual: outcome.residual,
            worst: self.system.equations().equation(outcome.row),
            smallest_pivot: self.linear.smallest_pivot(),
        };
        Solution { t, q: self.q, qd: self.qd, qdd: self.qdd, report }
    }

    fn overflow(&self, solution: &[f64], quantity: &'static str) -> Result<(), Failure> {
        if solution.iter().fold(true, |finite, x| finite & x.is_finite()) {
            Ok(())
        } else {
            Err(Failure::NotFinite(Bad { row: self.worst().0, quantity }))
        }
    }

    /// The error that tells a failure in the user's names.
    pub(crate) fn error(&mut self, failure: Failure, t: f64, last: Option<f64>) -> Error {
        let equations = self.system.equations();
        match failure {
            Failure::NotFinite(bad) => equations.not_finite(bad, t, &self.states),
            Failure::Singular(found) => self.system.singular(t, &found, self.unmet()),
            Failure::NoConvergence { row, residual } => {
                let (constraint, row) = self.system.row_name(row);
                Error::NoConvergence { t, iterations: self.steps - self.steps_before, constraint, row, residual, last, motion: None }
            }
        }
    }
}

/// The largest |x|, 0 of none; NaN counts as infinite. By bits, whose order is that of the numbers: the compiler makes lanes of it.
fn largest_of(numbers: impl Iterator<Item = f64>) -> f64 {
    let bits = numbers.fold(0, |m: i64, x| m.max(x.abs().to_bits() as i64));
    let largest = f64::from_bits(bits as u64);
    if largest.is_nan() { f64::INFINITY } else { largest }
}

/// Four roundings of a number in units of the tolerance: a number that large may be off by that much.
fn rounding(tolerance: f64) -> f64 {
    4.0 * f64::EPSILON / tolerance
}

/// The largest of non-negative numbers, 0 of none; NaN counts as infinite.
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
