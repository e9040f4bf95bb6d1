//! Mechanisms with more equations than coordinates, all of which can be met: the third crank of a parallelogram, a spatial four-bar of
//! five-row revolutes, a slider in two guides.
//!
//! Every time is solved for all equations in the sense of least squares. To leave the superfluous ones out would not do: which equations are
//! superfluous changes on the way (whatever row of a parallelogram's third crank is left out, twice in a turn it is the one that is needed).

mod judged;

use super::options::resolution;
use super::run::Explain;
use super::sweep::SHORTEST;
use super::watch::Watch;
use super::{Options, Outcome, Report, Stop};
use crate::assembly::search::{self, Found};
use crate::diagnosis::{self, DiagnosisOptions, Start};
use crate::error::{Error, Result};
use crate::follow::Drive;
use crate::linear::Tall;
use crate::model::{Measures, Model, Point, TOLERANCE};
use crate::motion::Motion;
use crate::system::evaluate::{Instant, finite};
use crate::system::{Solution, System};

/// Equations at a solution may differ by this share of their terms in velocities; where their positions may, by so many times that.   \[-\]
const CONSISTENT: f64 = 1e-8;
const ALLOWED: f64 = 30.0;

/// A correction that stalls above this share of its coordinate is no rounding.   \[-\]
const STALL: f64 = 1e-9;

/// A run of such a mechanism from time to time.
pub(crate) struct Sweep<'a> {
    system: &'a System,
    options: &'a Options,
    explain: Explain,
    /// None before the first time.
    driver: Option<Driver<'a>>,
}

impl<'a> Sweep<'a> {
    pub(crate) fn new(system: &'a System, options: &'a Options, explain: Explain) -> Self {
        Sweep { system, options, explain, driver: None }
    }

    /// Solves at the next time and appends it to the motion.
    pub(super) fn reach(&mut self, t: f64, watch: &mut Watch, motion: &mut Motion) -> Result<()> {
        let (driver, outcome) = match &mut self.driver {
            Some(driver) => {
                let outcome = driver.advance(t)?;
                (driver, outcome)
            }
            None => {
                let (driver, outcome) = Driver::assembled(self.system, self.options, t, self.explain)?;
                (self.driver.insert(driver), outcome)
            }
        };
        watch.look(self.system, &driver.instant, &mut motion.breaks)?;
        motion.append(t, driver.rows(), outcome, driver.worst);
        motion.misfit = driver.misfit;
        Ok(())
    }
}

/// Position, velocity and acceleration at one time; from the guess, or from a start that is near.
pub(crate) fn at(system: &System, t: f64, start: Option<&[f64]>, options: &Options) -> Result<Solution> {
    let (driver, outcome) = match start {
        None => Driver::assembled(system, options, t, Explain::Yes)?,
        Some(start) => Driver::from_start(system, options, t, start)?,
    };
    let worst = system.equations().equation(driver.worst);
    let report = Report { iterations: outcome.iterations, residual: outcome.residual, worst, smallest_pivot: driver.tall.smallest_pivot() };
    Ok(Solution { t, q: driver.q, qd: driver.qd, qdd: driver.qdd, report })
}

/// C_q x = the right side at a position, in the sense of least squares.
pub(crate) fn solved(system: &System, q: &[f64], t: f64, rhs: &[f64]) -> Result<Vec<f64>> {
    let (model, options) = (system.model(), Options::default());
    let mut driver = Driver::new(system, (&options, Explain::Yes), t, (q.to_vec(), model.measure(q, t)));
    match driver.factor(t) {
        Some(()) => Ok(driver.solved(rhs)),
        None => Err(driver.blamed(true, t)),
    }
}

/// The point in hand, and the means to go on from it.
struct Driver<'a> {
    system: &'a System,
    model: Model<'a>,
    options: &'a Options,
    explain: Explain,
    measures: Measures,
    tall: Tall,
    instant: Instant,
    /// C and C_q at the last evaluation.
    point: Point,
    /// What each value of C_q is multiplied by to be of order 1.
    scales: Vec<f64>,
    t: f64,
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    /// q⃛ where it is asked for, else empty.
    qddd: Vec<f64>,
    /// Newton steps since the last time.
    steps: usize,
    /// The row with the largest |C_i|.
    worst: usize,
    /// The largest share of its norm that a row has been off by, where that was allowed.
    misfit: f64,
    /// What happens between the ends of a step; taken out while it is asked.
    drive: Option<Drive>,
}

impl<'a> Driver<'a> {
    fn new(system: &'a System, (options, explain): (&'a Options, Explain), t: f64, (q, measures): (Vec<f64>, Measures)) -> Self {
        let model = system.model_within(options.closure);
        let (n, equations) = (model.n(), model.equations);
        let mut point = Point { c: vec![0.0; model.m()], values: vec![0.0; equations.entries.len()] };
        equations.set_constants(&mut point.values);
        let Measures { sizes, norms, .. } = &measures;
        let scale = |entry: &Option<(usize, usize)>| entry.map_or(0.0, |(row, column)| sizes[column] / norms[row]);
        Driver {
            scales: equations.entries.iter().map(scale).collect(),
            tall: Tall::new(model.m(), n, &equations.entries),
            instant: equations.instant(),
            point,
            system,
            model,
            options,
            explain,
            measures,
            t,
            q,
            qd: vec![0.0; n],
            qdd: vec![0.0; n],
            qddd: vec![],
            steps: 0,
            worst: 0,
            misfit: 0.0,
            drive: Some(Drive::new(equations)),
        }
    }

    /// Assembled from the guess, into the preferred assembly.
    fn assembled(system: &'a System, options: &'a Options, t: f64, explain: Explain) -> Result<(Self, Outcome)> {
        let model = system.model_within(options.closure);
        let mut found = search::search(model, system.initial(), t, &|_| true, &options.search);
        if let Some(q) = system.nearer(found.as_ref().filter(|found| found.met).map(|found| &found.place.q[..]), t, &options.search) {
            found = search::descend(model, &q, t, &|_| true, false, options.search.steps);
        }
        Self::found(system, options, t, found, (system.initial(), explain))
    }

    /// Assembled from a start, nothing preferred.
    fn from_start(system: &'a System, options: &'a Options, t: f64, start: &[f64]) -> Result<(Self, Outcome)> {
        let found = search::descend(system.model_within(options.closure), start, t, &|_| true, false, options.search.steps);
        Self::found(system, options, t, found, (start, Explain::Yes))
    }

    fn found(
        system: &'a System,
        options: &'a Options,
        t: f64,
        found: Option<Found>,
        (start, explain): (&[f64], Explain),
    ) -> Result<(Self, Outcome)> {
        let model = system.model_within(options.closure);
        let Some(found) = found.filter(|found| found.met) else {
            return Err(match explain {
                Explain::Yes => blamed(model, Start::Guess(start), t, options),
                Explain::No => unmet(system, start, t, 0, None),
            });
        };
        let steps = found.place.steps;
        let mut driver = Driver::new(system, (options, explain), t, (found.place.q, found.measures));
        let solved = driver.solve(t).and_then(|outcome| driver.rates(t).map(|()| outcome));
        let Some(outcome) = solved else { return Err(driver.blamed(true, t)) };
        match driver.wrong() {
            None => Ok((driver, Outcome { iterations: outcome.iterations + steps, ..outcome })),
            Some(error) => Err(error),
        }
    }

    /// To another time, in smaller steps of time where that is needed.
    fn advance(&mut self, to: f64) -> Result<Outcome> {
        let smallest = self.options.smallest_step(self.t, to);
        let shortest = (SHORTEST * (to - self.t).abs()).max(resolution(self.t, to));
        let (mut h, mut iterations) = (to - self.t, 0);
        self.steps = 0;
        loop {
            let target = if (to - self.t).abs() <= h.abs() * 1.001 { to } else { self.t + h };
            let before = [self.q.clone(), self.qd.clone(), self.qdd.clone()];
            if self.options.predict {
                self.predict(target - self.t);
            }
            let solved = self.solve(target);
            let wrong = solved.and_then(|_| self.wrong());
            if let (Some(outcome), None) = (&solved, &wrong) {
                iterations += outcome.iterations;
                if self.rates(target).is_none() {
                    return Err(self.blamed(true, target));
                }
                if let Some(objection) = self.objection(target, &before) {
                    [self.q, self.qd, self.qdd] = before;
                    if h.abs() <= shortest {
                        let units = self.model.layout.words.clone();
                        return Err(Error::CannotFollow { t: self.t, units, reason: objection.reason(), motion: None });
                    }
                    h *= 0.5;
                    continue;
                }
                self.t = target;
                if target == to {
                    return Ok(Outcome { iterations, ..*outcome });
                }
                h *= 2.0;
            } else {
                [self.q, ..] = before;
                if !self.options.rescue || h.abs() <= smallest {
                    if let Some(error) = wrong {
                        return Err(error);
                    }
                    return Err(self.blamed(false, target));
                }
                h *= 0.5;
            }
        }
    }

    /// The error for a position that is not what is meant.
    fn wrong(&self) -> Option<Error> {
        let equations = self.model.equations;
        equations.first_wrong(&self.instant).map(|block| equations.closes_wrong(block, self.model.layout, &self.instant))
    }

    /// q + h q̇ + ½ h² q̈
    fn predict(&mut self, h: f64) {
        for ((q, qd), qdd) in self.q.iter_mut().zip(&self.qd).zip(&self.qdd) {
            *q += h * (qd + 0.5 * h * qdd);
        }
    }

    /// Newton's steps in the sense of least squares, which must shrink; on success the matrix at the solution is factored.
    fn solve(&mut self, t: f64) -> Option<Outcome> {
        let mut previous = f64::INFINITY;
        for iterations in 0..=self.options.max_iterations {
            self.steps += 1;
            self.factor(t)?;
            let residual = self.point.c.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
            if let Stop::ResidualOnly(bound) = self.options.stop
                && residual < bound
            {
                return Some(self.outcome(iterations));
            }
            let opposed: Vec<f64> = self.point.c.iter().map(|c| -c).collect();
            let dq = self.solved(&opposed);
            let correction = dq.iter().zip(&self.measures.sizes).fold(0.0_f64, |m, (dq, size)| m.max((dq / size).abs()));
            let converged = match self.options.stop {
                Stop::Converged { tolerance } => correction <= tolerance || (correction > 0.5 * previous && correction <= STALL),
                Stop::ResidualOnly(_) => false,
            };
            // A correction that is infinite or not a number does not shrink.
            if !(correction < previous || converged) {
                return None;
            }
            let met = converged && self.model.met(&self.point, &self.q, &self.measures, &|_| true);
            self.q.iter_mut().zip(&dq).for_each(|(q, dq)| *q += dq);
            if converged {
                if met && self.has_jumped(t) {
                    self.q.iter_mut().zip(&dq).for_each(|(q, dq)| *q -= dq);
                }
                return met.then(|| self.outcome(iterations));
            }
            previous = correction;
        }
        None
    }

    /// Whether what can jump has done so with the last correction.
    fn has_jumped(&self, t: f64) -> bool {
        let met = |point: Point| self.model.met(&point, &self.q, &self.measures, &|_| true);
        !self.model.equations.jumping().is_empty() && !self.model.linearize(&self.q, t).is_ok_and(met)
    }

    fn outcome(&mut self, iterations: usize) -> Outcome {
        let rows = self.point.c.iter().map(|c| c.abs()).enumerate();
        let (worst, residual) = rows.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst });
        let share = self.point.c.iter().zip(&self.measures.norms).fold(0.0_f64, |m, (c, norm)| m.max((c / norm).abs()));
        if share > TOLERANCE {
            self.misfit = self.misfit.max(share);
        }
        self.worst = worst;
        Outcome { iterations, residual }
    }

    /// C and C_q at the point in hand, the matrix factored.
    fn factor(&mut self, t: f64) -> Option<()> {
        let (equations, Point { c, values }) = (self.model.equations, &mut self.point);
        if self.instant.t() != t {
            equations.set_time(t, &mut self.instant);
        }
        equations.set_position(&self.q, &mut self.instant);
        equations.linearize(&self.q, &self.instant, c, values);
        equations.finite(c, values).ok()?;
        let scaled = self.scales.iter().zip(values.iter()).map(|(scale, value)| scale * value);
        self.tall.factor_again(scaled, 0.0).then_some(())
    }

    /// The solution for a right side in the units of its rows.
    fn solved(&mut self, rhs: &[f64]) -> Vec<f64> {
        let Measures { sizes, norms, .. } = &self.measures;
        let y = self.tall.solve(rhs.iter().zip(norms).map(|(rhs, norm)| rhs / norm));
        y.iter().zip(sizes).map(|(y, size)| y * size).collect()
    }

    /// q̇ and q̈ with the matrix in hand, and q⃛ where it is asked for; `None` where they are not finite or the equations ask for different ones.
    fn rates(&mut self, t: f64) -> Option<()> {
        let equations = self.model.equations;
        equations.set_position(&self.q, &mut self.instant);
        let mut rhs = vec![0.0; self.model.m()];
        equations.velocity_rhs(&self.instant, &mut rhs);
        self.qd = self.agreed(&rhs)?;
        equations.set_rates(&self.qd, &mut self.instant);
        equations.second_order(&self.instant, 1.0, &mut rhs);
        self.qdd = self.agreed(&rhs)?;
        if self.options.jerk {
            let rhs = self.model.jerk_rhs(&self.q, t, &self.qd, &self.qdd).ok()?.ok()?;
            self.qddd = self.agreed(&rhs)?;
        }
        Some(())
    }

    /// The solution of C_q x = the right side, if it is finite and meets every row.
    fn agreed(&mut self, rhs: &[f64]) -> Option<Vec<f64>> {
        finite(rhs, "").ok()?;
        let solution = self.solved(rhs);
        let mut rows: Vec<(f64, f64)> = rhs.iter().map(|rhs| (-rhs, rhs.abs())).collect();
        for (row, column, value) in self.model.entries(&self.point.values) {
            let term = value * solution[column];
            rows[row] = (rows[row].0 + term, rows[row].1 + term.abs());
        }
        let rows = rows.iter().zip(&self.measures.norms);
        let largest = rows.clone().fold(0.0_f64, |m, ((_, size), norm)| m.max(size / norm));
        let share = CONSISTENT.max(ALLOWED * self.options.closure);
        let met = rows.clone().all(|((sum, _), norm)| sum.abs() <= share * largest * norm);
        (met && solution.iter().all(|x| x.is_finite())).then_some(solution)
    }

    /// The error for a time that cannot be reached from the position in hand, which is one that `closes` or a guess of one.
    fn blamed(&self, closes: bool, t: f64) -> Error {
        let start = if closes { Start::Pose(&self.q) } else { Start::Guess(&self.q) };
        match self.explain {
            Explain::Yes => blamed(self.model, start, t, self.options),
            Explain::No => unmet(self.system, &self.q, t, self.steps, Some(self.t)),
        }
    }

    /// q, q̇, q̈, and q⃛ or nothing.
    fn rows(&self) -> [&[f64]; 4] {
        [&self.q, &self.qd, &self.qdd, &self.qddd]
    }
}

/// The error for a mechanism that cannot be driven there, with its diagnosis.
fn blamed(model: Model<'_>, start: Start<'_>, t: f64, options: &Options) -> Error {
    let options = DiagnosisOptions { search: options.search.clone(), ..DiagnosisOptions::default() };
    match diagnosis::diagnose(model, start, t, &options) {
        Ok(diagnosis) => Error::CannotBeDriven { diagnosis: Box::new(diagnosis), motion: None },
        Err(error) => error,
    }
}

/// The same error where nobody asks what is wrong: the equation that is furthest from being met.
fn unmet(system: &System, q: &[f64], t: f64, iterations: usize, last: Option<f64>) -> Error {
    let (model, instant) = (system.model(), system.equations().instant_at(t, q));
    match model.linearize(q, t) {
        Err(bad) => system.equations().not_finite(bad, system.layout(), &instant),
        Ok(point) => {
            let rows = point.c.iter().map(|c| c.abs()).enumerate();
            let (worst, residual) = rows.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst });
            let (constraint, row) = system.row_name(worst);
            let units = system.layout().words.clone();
            Error::NoConvergence { t, units, iterations, constraint, row, residual, last, diagnosis: None, motion: None }
        }
    }
}

/// Whether a system is one for this driver.
pub(crate) fn is_redundant(system: &System) -> bool {
    system.n_equations() > system.n_coordinates()
}
