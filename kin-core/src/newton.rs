//! Newton's method on C(q, t) = 0, and q̇, q̈ from the matrix of its last check.

pub(crate) mod assembly;
mod driven;
mod options;
pub(crate) mod predictor;
pub(crate) mod redundant;
pub(crate) mod sweep;
mod watch;

pub use options::{Follow, Options, Report, Stop};
pub use watch::CrossedBreak;

use crate::error::Error;
use crate::fours;
use crate::linear::Linear;
use crate::system::evaluate::{Bad, Instant, finite};
use crate::system::{Solution, System};

/// A correction that stalls above this share of its coordinate is no rounding but a singular position.   \[-\]
pub(crate) const STALL: f64 = 1e-9;

/// A position with a pivot below this cannot be told from a singular one: rounding ε of C moves q by ε / pivot, and so the pivot by about
/// as much, which is itself at √ε = 1.5e-8.   \[-\]
pub(crate) const DOUBTFUL: f64 = 1e-7;

/// A row that is off by more than this, of the norm of the row, is told as not met where C_q is singular.   \[-\]
const UNMET: f64 = 1e-2;

/// What the right side for the jerk is called.
pub(crate) const JERK_RHS: &str = "the right side for the jerk";

/// A damped step turns no body by more than this.   \[rad\]
const TURN: f64 = 1.0;

/// Halvings of one damped step.
const HALVINGS: usize = 24;

/// Why an attempt failed, without text yet.
#[derive(Clone, Debug)]
pub(crate) enum Failure {
    NotFinite(Bad),
    Singular,
    /// A constraint that closes the wrong way.
    WrongBranch(usize),
    NoConvergence {
        row: usize,
        residual: f64,
    },
}

/// What an attempt that succeeded did.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outcome {
    pub iterations: usize,
    pub residual: f64,
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
    /// q⃛ where it is asked for, else empty.
    pub qddd: Vec<f64>,
    pub c: Vec<f64>,
    before: Vec<f64>,
    pub instant: Instant,
    pub linear: Linear,
    /// s_j, the characteristic size of each coordinate.
    pub sizes: Vec<f64>,
    /// 1 / s_j
    shares: Vec<f64>,
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
            qddd: vec![0.0; if options.jerk { n } else { 0 }],
            c: vec![0.0; n],
            before: vec![0.0; n],
            instant: equations.instant(),
            linear: system.linear(),
            sizes: vec![1.0; n],
            shares: vec![1.0; n],
            left: vec![0.0; n],
            residual: 0.0,
            steps: 0,
            steps_before: 0,
        }
    }

    /// Gives each coordinate its characteristic size.
    fn set_sizes(&mut self, sizes: Vec<f64>) {
        self.linear.set_sizes(&sizes);
        self.shares.iter_mut().zip(&sizes).for_each(|(share, size)| *share = size.recip());
        self.sizes = sizes;
    }

    /// Newton's method from the point in hand; on success the matrix at the solution is factored.
    pub(crate) fn solve(&mut self, t: f64, steps: Steps) -> Result<Outcome, Failure> {
        self.linearize(t)?;
        self.factor()?;
        self.iterate(t, steps)
    }

    /// The same where the point in hand is the solution of another time: only what depends on the time is evaluated at first.
    pub(crate) fn solve_on(&mut self, t: f64, steps: Steps) -> Result<Outcome, Failure> {
        let equations = self.system.equations();
        equations.set_time(t, &mut self.instant);
        let changed = equations.relinearize(&self.instant, &mut self.c, self.linear.values_mut());
        self.measure(changed)?;
        if changed {
            self.factor()?;
        }
        self.iterate(t, steps)
    }

    fn factor(&mut self) -> Result<(), Failure> {
        if self.linear.factor() { Ok(()) } else { Err(Failure::Singular) }
    }

    /// Newton's method with the matrix of the point in hand factored.
    fn iterate(&mut self, t: f64, steps: Steps) -> Result<Outcome, Failure> {
        let (mut previous, mut iteration) = (f64::INFINITY, 0);
        loop {
            if let Stop::ResidualOnly(bound) = self.options.stop
                && self.residual < bound
            {
                return self.regular(iteration);
            }
            let correction = self.correction();
            if self.converged(correction, previous) {
                // The correction costs nothing any more, and keeps errors of predictions from adding up.
                if self.options.predict {
                    self.correct();
                }
                return self.regular(iteration);
            }
            if iteration == self.options.max_iterations || (steps == Steps::Near && correction > previous) {
                return Err(self.failure());
            }
            previous = correction;
            self.step(if correction <= STALL { Steps::Full } else { steps })?;
            (self.steps, iteration) = (self.steps + 1, iteration + 1);
            self.linearize(t)?;
            self.factor()?;
        }
    }

    /// The outcome, unless the position is singular for all that rounding lets one tell, or not what is meant.
    fn regular(&mut self, iterations: usize) -> Result<Outcome, Failure> {
        if self.linear.smallest_pivot() < DOUBTFUL {
            return Err(Failure::Singular);
        }
        if let Some(block) = self.system.equations().first_wrong(&self.instant) {
            return Err(Failure::WrongBranch(block));
        }
        Ok(Outcome { iterations, residual: self.residual })
    }

    /// Why the iteration came to no end: where C is met and still every step is long, C_q is singular for all practical purposes.
    fn failure(&mut self) -> Failure {
        if matches!(self.options.stop, Stop::Converged { .. }) && self.met() {
            return Failure::Singular;
        }
        let (row, residual) = self.worst();
        Failure::NoConvergence { row, residual }
    }

    /// C and C_q at the point in hand, and the measures of its rows.
    pub(crate) fn linearize(&mut self, t: f64) -> Result<(), Failure> {
        let equations = self.system.equations();
        if self.instant.t() != t {
            equations.set_time(t, &mut self.instant);
        }
        equations.set_position(&self.q, &mut self.instant);
        equations.linearize(&self.instant, &mut self.c, self.linear.values_mut());
        self.measure(true)
    }

    /// Measures C, and C_q if that is asked for; an error where a number is not finite.
    fn measure(&mut self, matrix: bool) -> Result<(), Failure> {
        self.residual = fours::largest(&self.c);
        if (!matrix || self.linear.measure()) && self.residual < f64::INFINITY {
            return Ok(());
        }
        self.system.equations().finite(&self.c, self.linear.values()).map_err(Failure::NotFinite)
    }

    /// C_q dq = −C; gives max |dq_j|, each against what may be asked of it, or more if that is within the tolerance.
    fn correction(&mut self) -> f64 {
        fours::negate(self.linear.rhs_mut(), &self.c);
        self.linear.solve();
        let (dq, tolerance) = match self.options.stop {
            Stop::Converged { tolerance } => (self.linear.solution(), tolerance),
            // Nothing asks for more, where steps are taken as they come.
            Stop::ResidualOnly(_) if !self.options.rescue => return f64::INFINITY,
            Stop::ResidualOnly(_) => (self.linear.solution(), f64::INFINITY),
        };
        let shares = fours::largest_share(dq, &self.shares);
        if shares <= tolerance {
            return shares;
        }
        let rounding = rounding(tolerance);
        largest(dq.iter().zip(&self.q).zip(&self.sizes).map(|((dq, q), size)| dq.abs() / (size + rounding * q.abs())))
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
        fours::largest_share(&self.c, self.linear.row_units()) <= tolerance || self.met_but_for_rounding(tolerance)
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
    pub(crate) fn worst(&self) -> (usize, f64) {
        let rows = self.c.iter().map(|c| c.abs()).enumerate();
        rows.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst })
    }

    /// q += dq, or less of it.
    fn step(&mut self, steps: Steps) -> Result<(), Failure> {
        if steps == Steps::Damped && !self.met() {
            return self.damped();
        }
        self.correct();
        Ok(())
    }

    /// q += dq
    fn correct(&mut self) {
        fours::add(&mut self.q, self.linear.solution());
    }

    /// q += λ dq with the largest λ = 1, ½, ¼, … that lets Σ (C_i / norm_i)² fall (Armijo) and turns nothing too far.
    fn damped(&mut self) -> Result<(), Failure> {
        let equations = self.system.equations();
        let units = &self.system.layout().units;
        let dq = self.linear.solution();
        let turns = dq.iter().zip(units).filter(|(_, unit)| **unit != crate::layout::Unit::Metre).map(|(dq, _)| dq.abs());
        let mut lambda = (TURN / largest(turns)).min(1.0);
        let merit = self.merit();
        let failure = self.failure();
        self.before.copy_from_slice(&self.q);
        for _ in 0..HALVINGS {
            for ((q, before), dq) in self.q.iter_mut().zip(&self.before).zip(self.linear.solution()) {
                *q = before + lambda * dq;
            }
            equations.set_position(&self.q, &mut self.instant);
            let finite = equations.residual(&self.instant, &mut self.c).is_ok();
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
    pub(crate) fn rates(&mut self) -> Result<(), Failure> {
        let equations = self.system.equations();
        equations.velocity_rhs(&self.instant, self.linear.rhs_mut());
        self.linear.solve();
        let finite = fours::take(&mut self.qd, self.linear.solution());
        equations.set_rates(&self.qd, &mut self.instant);
        equations.acceleration_rhs(&self.instant, self.linear.rhs_mut());
        self.linear.solve();
        // A right side that is not finite makes solutions that are not.
        if !(fours::take(&mut self.qdd, self.linear.solution()) && finite) {
            return Err(Failure::NotFinite(self.overflow()));
        }
        if self.options.jerk { self.jerk() } else { Ok(()) }
    }

    /// q⃛ from C_q q⃛ = −g‴(0), with the same factors.
    fn jerk(&mut self) -> Result<(), Failure> {
        let (equations, rhs) = (self.system.equations(), self.linear.rhs_mut());
        let known = equations.jerk_rhs(&self.qdd, &mut self.instant, rhs).map_err(|row| Bad { row, quantity: JERK_RHS });
        let right_side = known.and_then(|()| finite(rhs, JERK_RHS));
        self.linear.solve();
        if fours::take(&mut self.qddd, self.linear.solution()) && right_side.is_ok() {
            return Ok(());
        }
        Err(Failure::NotFinite(right_side.err().unwrap_or(Bad { row: self.worst().0, quantity: "q'''" })))
    }

    /// 1 / s_j, one over the characteristic size of each coordinate.
    pub(crate) fn shares(&self) -> &[f64] {
        &self.shares
    }

    /// |C_q⁻¹ (C_q v)_q v| by the sizes, with the matrix in hand; the rates of the instant are lost.
    pub(crate) fn bend(&mut self, v: &[f64]) -> f64 {
        let equations = self.system.equations();
        equations.set_rates(v, &mut self.instant);
        equations.second_order(&self.instant, 0.0, self.linear.rhs_mut());
        self.linear.solve();
        fours::largest_share(self.linear.solution(), &self.shares)
    }

    /// What is not finite in the right sides or their solutions.
    fn overflow(&mut self) -> Bad {
        let equations = self.system.equations();
        let own_row = |bad: Bad| Bad { row: self.worst().0, ..bad };
        let (qd, qdd) = (finite(&self.qd, "q'").map_err(own_row), finite(&self.qdd, "q''").map_err(own_row));
        let rhs = self.linear.rhs_mut();
        equations.velocity_rhs(&self.instant, rhs);
        let c_t = finite(rhs, "C_t");
        equations.acceleration_rhs(&self.instant, rhs);
        let q_d = finite(rhs, "Q_d");
        c_t.and(qd).and(q_d).and(qdd).err().unwrap_or(Bad { row: 0, quantity: "q''" })
    }

    /// What is in hand, to keep.
    pub(crate) fn solution(self, t: f64, outcome: Outcome) -> Solution {
        let report = Report {
            iterations: self.steps,
            residual: outcome.residual,
            worst: self.system.equations().equation(self.worst().0),
            smallest_pivot: self.linear.smallest_pivot(),
        };
        Solution { t, q: self.q, qd: self.qd, qdd: self.qdd, report }
    }

    /// The error that tells a failure in the user's names.
    pub(crate) fn error(&mut self, failure: Failure, t: f64, last: Option<f64>) -> Error {
        let equations = self.system.equations();
        match failure {
            Failure::NotFinite(bad) => equations.not_finite(bad, self.system.layout(), &self.instant),
            Failure::WrongBranch(block) => equations.closes_wrong(block, &self.instant),
            Failure::Singular => self.system.singular(t, &self.q, self.unmet()),
            Failure::NoConvergence { row, residual } => {
                let (constraint, row) = self.system.row_name(row);
                Error::NoConvergence {
                    t,
                    iterations: self.steps - self.steps_before,
                    constraint,
                    row,
                    residual,
                    last,
                    diagnosis: None,
                    motion: None,
                }
            }
        }
    }
}

/// Four roundings of a number in units of the tolerance: a number that large may be off by that much.
pub(crate) fn rounding(tolerance: f64) -> f64 {
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
