//! Solves mechanisms with more equations than coordinates, all of which can be satisfied.
//!
//! Examples are the third crank of a parallelogram, a spatial four-bar of five-row revolutes, and a
//! slider in two guides.
//!
//! Kin solves as many independent equations as the mechanism has coordinates, and checks the other
//! equations ([`crate::linear::Independent`]). If the options allow a misfit
//! ([`Options::closure`]), Kin solves all equations by least squares.

mod begin;
mod errors;
mod judged;
mod rows;
mod solver;

use crate::coordinates::units::Units;
use crate::numbers::padded::{self, Padded};
use crate::outcome::error::{Error, FailureKind, Result, UnfollowedReason};
use crate::solve::explain::{Explain, Start};
use crate::solve::follow::{Drive, Objection};
use crate::solve::motion::Motion;
use crate::solve::newton::{Outcome, iterate};
use crate::solve::options::SolverOptions;
use crate::solve::step::advance::{Asked, Effort, Stepping, advance};
use crate::solve::step::predictor::{Last, Predictor};
use crate::system::evaluate::{Instant, finite};
use crate::system::scaled::{Measures, Model, Point, TOLERANCE};
use crate::system::{Report, Solution, System};
use errors::unmet;
use rows::Rows;
use solver::Solver;
pub(crate) use solver::solved;

/// The permitted difference of equations in velocities, as a share of their terms. If positions may
/// contradict each other, it is the second value times that contradiction. \[-\]
pub(crate) const CONSISTENT: f64 = 1e-8;
pub(crate) const ALLOWED: f64 = 30.0;

/// A run of such a mechanism from time to time.
pub(crate) struct Stepper<'a> {
    system: &'a System,
    options: &'a SolverOptions,
    explain: Option<Explain>,
    /// `None` before the first time.
    position: Option<Position<'a>>,
    /// The smallest pivot of the equations that are solved, at the first time.   \[-\]
    pub(super) first_pivot: Option<f64>,
}

impl<'a> Stepper<'a> {
    pub(crate) fn new(
        system: &'a System,
        options: &'a SolverOptions,
        explain: Option<Explain>,
    ) -> Self {
        Stepper { system, options, explain, position: None, first_pivot: None }
    }

    /// Solves at the next time.
    pub(super) fn reach(&mut self, t: f64) -> Result<(&Position<'a>, Outcome)> {
        match self.position {
            Some(ref mut position) => {
                let outcome = position.advance(t)?;
                Ok((position, outcome))
            }
            None => {
                let (position, outcome) =
                    Position::assembled(self.system, self.options, t, self.explain)?;
                self.first_pivot = Some(position.solver.smallest_pivot());
                Ok((self.position.insert(position), outcome))
            }
        }
    }

    /// Begins the next step at this pose, which satisfies the equations at time t.
    pub(super) fn begin_from(&mut self, t: f64, q: &[f64]) -> Result<()> {
        self.position_at(t, q).map(|_| ())
    }

    fn position_at(&mut self, t: f64, q: &[f64]) -> Result<&mut Position<'a>> {
        let (position, _) = Position::near(self.system, self.options, t, q)?;
        Ok(self.position.insert(position))
    }

    /// Appends the pose at time t to `motion`, reached from time k of a known motion.
    pub(super) fn go_from(
        &mut self,
        known: &Motion,
        k: usize,
        t: f64,
        motion: &mut Motion,
    ) -> Result<()> {
        let position = self.position_at(known.times()[k], known.q(k))?;
        let outcome = position.advance(t)?;
        position.append(outcome, motion);
        Ok(())
    }
}

/// Returns position, velocity and acceleration at one time, from the guess or from a start nearby.
pub(crate) fn at(
    system: &System,
    t: f64,
    start: Option<&[f64]>,
    options: &SolverOptions,
    explain: Explain,
) -> Result<Solution> {
    let (position, outcome) = match start {
        None => Position::assembled(system, options, t, Some(explain))?,
        Some(start) => Position::from_start(system, options, t, (start, explain))?,
    };
    let worst = system.equations().equation(position.worst);
    let report = Report {
        iterations: outcome.iterations,
        residual: outcome.residual,
        worst,
        smallest_pivot: position.solver.smallest_pivot(),
        compiled: false,
    };
    Ok(Solution {
        t,
        q: position.q.to_vec(),
        qd: position.qd.to_vec(),
        qdd: position.qdd.to_vec(),
        report,
    })
}

/// The present point, with workspace buffers.
pub(super) struct Position<'a> {
    system: &'a System,
    model: Model<'a>,
    options: &'a SolverOptions,
    explain: Option<Explain>,
    measures: Measures,
    solver: Solver,
    instant: Instant,
    /// C and C_q at the last evaluation.
    point: Point,
    /// For each value of C_q the factor that scales it to order 1.
    scales: Vec<f64>,
    /// The factors that scale rows and changes of coordinates to order 1; `turns` is 1 for
    /// coordinates that rotate.
    row_shares: Padded,
    shares: Padded,
    turns: Padded,
    predictor: Predictor,
    /// A right side and its solution.
    rhs: Padded,
    x: Padded,
    t: f64,
    /// The last solution, kept during the search for the next one.
    last: Padded,
    q: Padded,
    qd: Padded,
    qdd: Padded,
    /// q⃛ if it is computed, otherwise empty.
    qddd: Vec<f64>,
    /// The number of evaluations since the last time, and of Newton steps that have led to a
    /// position.
    steps: usize,
    iterations: usize,
    /// The row with the largest |C_i|.
    worst: usize,
    /// The largest residual of a row as a share of its norm, if the options allow one.
    misfit: f64,
    /// The motion of the drivers between the ends of a step; `None` while it is in use.
    drive: Option<Drive>,
    effort: Effort,
}

impl Position<'_> {
    /// Moves to another time, in smaller steps of time if necessary.
    fn advance(&mut self, to: f64) -> Result<Outcome> {
        (self.steps, self.iterations) = (0, 0);
        self.effort.grant();
        let outcome = advance(self, Asked { from: self.t, to })?;
        Ok(Outcome { iterations: self.iterations, ..outcome })
    }

    /// Records that a step h has succeeded. The present velocities still belong to the earlier time
    /// and become the past.
    fn settle(&mut self, h: f64, iterations: usize) {
        if self.options.predict && iterations > 0 {
            let last = Last { q: &self.last, qd: &self.qd, qdd: &self.qdd };
            self.predictor.compare(h, last, &self.q, &self.measures.sizes);
        }
        self.predictor.advance(h, &mut self.qd, &mut self.qdd);
    }

    /// Returns the error for a position on a wrong branch, if it is on one.
    fn wrong(&self) -> Option<Error> {
        let equations = self.model.equations;
        equations
            .first_wrong(&self.instant)
            .map(|block| equations.closes_wrong(block, self.model.layout, &self.instant))
    }

    /// Runs Newton's method by least squares; its steps must shrink. After success the matrix at
    /// the solution is factored.
    fn solve(&mut self, t: f64) -> Option<Outcome> {
        let options = self.options;
        let mut rows = Rows { position: self, t, iterations: 0, before: Vec::new() };
        let found = iterate::newton(&mut rows, options, true);
        let iterations = rows.iterations;
        found.then(|| self.outcome(iterations))
    }

    /// Returns true if a constraint that can jump has done so with the last correction.
    fn has_jumped(&self, t: f64) -> bool {
        let met = |point: Point| self.model.met(&point, &self.q, &self.measures, &|_| true);
        !self.model.equations.jumping().is_empty()
            && !self.model.linearize(&self.q, t).is_ok_and(met)
    }

    fn outcome(&mut self, iterations: usize) -> Outcome {
        let rows = self.point.c.iter().map(|c| c.abs()).enumerate();
        let (worst, residual) =
            rows.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst });
        if self.options.allowed_misfit > 0.0 {
            let share = self
                .point
                .c
                .iter()
                .zip(&self.row_shares)
                .fold(0.0_f64, |m, (c, share)| m.max((c * share).abs()));
            self.misfit = self.misfit.max(if share > TOLERANCE { share } else { 0.0 });
        }
        self.worst = worst;
        Outcome { iterations, residual }
    }

    /// Evaluates C and C_q at the present point and factors the matrix.
    fn factor(&mut self, t: f64) -> Option<()> {
        let equations = self.model.equations;
        let Point { c, values } = &mut self.point;
        if self.instant.t() != t {
            equations.set_time(t, &mut self.instant);
        }
        equations.set_position(&self.q, &mut self.instant);
        equations.linearize(&self.q, &self.instant, c, values);
        equations.finite(c, values).ok()?;
        let scaled = self.scales.iter().zip(values.iter()).map(|(scale, value)| scale * value);
        self.solver.factor(scaled).then_some(())
    }

    /// Solves C_q x = the present right side, with rows of order 1.
    fn solve_for_rhs(&mut self) {
        self.rhs.iter_mut().zip(&self.row_shares).for_each(|(rhs, share)| *rhs *= share);
        let y = self.solver.solve(&self.rhs);
        self.x.iter_mut().zip(y).zip(&self.measures.sizes).for_each(|((x, y), size)| *x = y * size);
    }

    /// Solves q̇ and q̈ with the present matrix, and q⃛ if it is computed. Returns `None` if they
    /// are not finite, or if the equations contradict each other.
    fn rates(&mut self, t: f64) -> Option<()> {
        let equations = self.model.equations;
        equations.set_position(&self.q, &mut self.instant);
        equations.velocity_rhs(&self.instant, &mut self.rhs);
        self.agree()?;
        padded::copy(self.qd.whole_mut(), self.x.whole());
        equations.set_rates(&self.qd, &mut self.instant);
        equations.second_order(&self.instant, 1.0, &mut self.rhs);
        self.agree()?;
        padded::copy(self.qdd.whole_mut(), self.x.whole());
        if self.options.jerk {
            self.rhs
                .copy_from_slice(&self.model.jerk_rhs(&self.q, t, &self.qd, &self.qdd).ok()?.ok()?);
            self.agree()?;
            self.qddd = self.x.to_vec();
        }
        Some(())
    }

    /// Solves for the present right side. Returns `None` if the solution is not finite or does not
    /// satisfy every row.
    fn agree(&mut self) -> Option<()> {
        finite(&self.rhs, "").ok()?;
        self.solve_for_rhs();
        let terms = padded::largest(self.rhs.whole())
            .max(padded::largest_share(self.x.whole(), self.shares.whole()));
        self.solver.leave(&mut self.rhs);
        let share = CONSISTENT.max(ALLOWED * self.options.allowed_misfit);
        (terms.is_finite() && padded::largest(self.rhs.whole()) <= share * terms).then_some(())
    }

    /// Returns the error for a time that cannot be reached from the present position. `closes` says
    /// whether that position satisfies the equations or is only a guess.
    fn blamed(&self, closes: bool, t: f64) -> Error {
        let start = if closes { Start::Pose(&self.q) } else { Start::Guess(&self.q) };
        match self.explain {
            Some(explain) => (explain.cannot_be_driven)(self.model, start, t, self.options),
            None => unmet(self.system, &self.q, t, self.steps, Some(self.t)),
        }
    }

    /// Appends the present point to a motion.
    pub(super) fn append(&self, outcome: Outcome, motion: &mut Motion) {
        let rows = [&self.q[..], &self.qd, &self.qdd, &self.qddd];
        motion.append(self.t, rows, outcome, self.worst);
    }

    /// Returns the instant of the present point.
    pub(super) fn instant(&self) -> &Instant {
        &self.instant
    }

    /// Returns the largest residual of a row as a share of its norm, if the options allow one.
    pub(super) fn misfit(&self) -> f64 {
        self.misfit
    }
}

/// The reason why a step of time failed.
pub(super) enum Trouble {
    Unsolved,
    /// A constraint is on a wrong branch.
    Wrong(Error),
    /// There is a position, but no velocities that satisfy all equations.
    Disagreed(Error),
    Objected(Objection),
}

impl Stepping for Position<'_> {
    type Trouble = Trouble;

    fn keep(&mut self) {
        padded::copy(self.last.whole_mut(), self.q.whole());
    }

    fn attempt(&mut self, h: f64, target: f64, _: Asked) -> std::result::Result<Outcome, Trouble> {
        if self.options.predict {
            let last = Last { q: &self.last, qd: &self.qd, qdd: &self.qdd };
            self.predictor.predict(h, last, &mut self.q);
        }
        let outcome = self.solve(target).ok_or(Trouble::Unsolved)?;
        if let Some(error) = self.wrong() {
            return Err(Trouble::Wrong(error));
        }
        self.iterations += outcome.iterations;
        self.settle(h, outcome.iterations);
        if self.rates(target).is_none() {
            return Err(Trouble::Disagreed(self.blamed(true, target)));
        }
        if let Some(objection) = self.objection(target) {
            self.predictor.retreat(&mut self.qd, &mut self.qdd);
            return Err(Trouble::Objected(objection));
        }
        self.t = target;
        Ok(outcome)
    }

    fn confirm(&mut self) {}

    fn go_back(&mut self) {
        padded::copy(self.q.whole_mut(), self.last.whole());
    }

    fn is_short(&mut self, h: f64, _: f64, asked: Asked, trouble: &Trouble) -> bool {
        let SolverOptions { rescue, .. } = self.options;
        match trouble {
            Trouble::Disagreed(_) => true,
            Trouble::Objected(_) => h.abs() <= asked.shortest(),
            Trouble::Unsolved | Trouble::Wrong(_) => {
                !rescue || h.abs() <= self.options.smallest_step(asked.from, asked.to)
            }
        }
    }

    /// There is no other method: Kin does not pass singular positions of rectangular matrices.
    fn give_up(
        &mut self,
        trouble: Trouble,
        t: f64,
        target: f64,
        _: f64,
        _: Asked,
    ) -> Result<Outcome> {
        Err(match trouble {
            Trouble::Unsolved => self.blamed(false, target),
            Trouble::Wrong(error) | Trouble::Disagreed(error) => error,
            Trouble::Objected(objection) => {
                FailureKind::CannotFollow { reason: objection.reason() }.at(t, self.units())
            }
        })
    }

    fn effort(&mut self) -> &mut Effort {
        &mut self.effort
    }

    fn objection(trouble: &Trouble) -> Option<UnfollowedReason> {
        match trouble {
            Trouble::Objected(objection) => objection.of_branches(),
            _ => None,
        }
    }

    fn units(&self) -> &Units {
        &self.model.layout.words
    }
}
