//! Evaluates the equations of a mechanism in units of order 1, for any number of equations and any
//! pose.
//!
//! Diagnosis, assembly from a poor guess and redundant mechanisms use this module. The step-by-step
//! solver and the compiled program do not.

use crate::linear::{Echelon, RANK, Sparse};
use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;

use crate::coordinates::layout::Layout;
use crate::coordinates::units::Unit;
use crate::numbers::random::Random;
use crate::outcome::error::Error;
use crate::system::evaluate::{Bad, Equations, JERK_RHS, finite};
use crate::system::scale;

/// A row is satisfied if its residual is at most this share of its norm. \[-\]
pub(crate) const TOLERANCE: f64 = 1e-10;

/// The facts about a mechanism that are known before it is solved.
#[derive(Clone, Copy)]
pub(crate) struct Model<'a> {
    pub name: &'a str,
    pub layout: &'a Layout,
    pub equations: &'a Equations,
    pub preferred: &'a [(usize, f64)],
    pub links: &'a [f64],
    /// By how much of their norms rows may be off and count as met, beyond rounding.   \[-\]
    pub misfit: f64,
    /// The work that searches may spend on it; none where their own limits are all.
    pub work: Option<&'a Work>,
}

/// The work that searches may spend, counted in computed and factored values of C_q. Kin does not
/// measure time, so the result is the same on each machine.
#[derive(Debug)]
pub(crate) struct Work(AtomicU64);

impl Work {
    pub(crate) fn new(values: f64) -> Self {
        Work(AtomicU64::new(values as u64))
    }

    /// Returns true if no work is left.
    pub(crate) fn is_spent(&self) -> bool {
        self.0.load(Relaxed) == 0
    }

    fn spend(&self, values: usize) {
        self.0.store(self.0.load(Relaxed).saturating_sub(values as u64), Relaxed);
    }
}

/// C and the values of C_q at one pose.
#[derive(Clone, Debug, Default)]
pub(crate) struct Point {
    pub c: Vec<f64>,
    pub values: Vec<f64>,
}

/// Characteristic sizes s_j of coordinates and norms of rows, max_j |∂C_i/∂q_j| s_j over a few
/// poses. In these units everything is of order 1.
#[derive(Clone, Debug)]
pub(crate) struct Measures {
    pub sizes: Vec<f64>,
    pub norms: Vec<f64>,
    /// The time in which the fastest driver moves something of order 1. \[s\]
    pub time: f64,
}

impl Model<'_> {
    pub(crate) fn n(&self) -> usize {
        self.layout.len()
    }

    /// Spends the work of one step of a search. Returns false if no work is left.
    pub(crate) fn may_search(&self) -> bool {
        let Some(work) = self.work else { return true };
        work.spend(self.equations.entries.len());
        !work.is_spent()
    }

    /// Returns true if no work is left for searches.
    pub(crate) fn is_spent(&self) -> bool {
        self.work.is_some_and(Work::is_spent)
    }

    pub(crate) fn m(&self) -> usize {
        self.equations.rows
    }

    /// Evaluates C and C_q, or returns the entry that is not finite.
    pub(crate) fn linearize(&self, q: &[f64], t: f64) -> Result<Point, Bad> {
        let mut point =
            Point { c: vec![0.0; self.m()], values: vec![0.0; self.equations.entries.len()] };
        self.equations.set_constants(&mut point.values);
        self.equations.linearize(
            q,
            &self.equations.instant_at(t, q),
            &mut point.c,
            &mut point.values,
        );
        self.equations.finite(&point.c, &point.values)?;
        Ok(point)
    }

    /// Evaluates C_t, or returns the entry that is not finite.
    pub(crate) fn c_t(&self, q: &[f64], t: f64) -> Result<Vec<f64>, Bad> {
        let mut rhs = vec![0.0; self.m()];
        self.equations.velocity_rhs(&self.equations.instant_at(t, q), &mut rhs);
        finite(&rhs, "C_t")?;
        rhs.iter_mut().for_each(|x| *x = 0.0 - *x);
        Ok(rhs)
    }

    /// Evaluates −\[(C_q v)_q v + 2 ṫ C_qt v + ṫ² C_tt\]. With ṫ = 1 it is Q_d; with ṫ = 0 it is
    /// the second order of a motion along v at constant time.
    pub(crate) fn second_order(
        &self,
        q: &[f64],
        t: f64,
        v: &[f64],
        t_dot: f64,
    ) -> Result<Vec<f64>, Bad> {
        let mut instant = self.equations.instant_at(t, q);
        let mut rhs = vec![0.0; self.m()];
        self.equations.set_rates(v, &mut instant);
        self.equations.second_order(&instant, t_dot, &mut rhs);
        finite(&rhs, "Q_d")?;
        Ok(rhs)
    }

    /// Evaluates −g‴(0), the right side for the jerk. The outer error means that a constraint does
    /// not know it.
    pub(crate) fn jerk_rhs(
        &self,
        q: &[f64],
        t: f64,
        qd: &[f64],
        qdd: &[f64],
    ) -> Result<Result<Vec<f64>, Bad>, Error> {
        let mut instant = self.equations.instant_at(t, q);
        let mut rhs = vec![0.0; self.m()];
        self.equations.set_rates(qd, &mut instant);
        self.equations
            .jerk_rhs(qdd, &mut instant, &mut rhs)
            .map_err(|row| self.equations.no_jerk(row))?;
        Ok(finite(&rhs, JERK_RHS).map(|()| rhs))
    }

    /// Returns the nonzero entries of C_q as (row, column, value).
    pub(crate) fn entries<'b>(
        &'b self,
        values: &'b [f64],
    ) -> impl Iterator<Item = (usize, usize, f64)> + 'b {
        let entries = self.equations.entries.iter().zip(values);
        entries.filter_map(|(entry, value)| entry.map(|(row, column)| (row, column, *value)))
    }

    /// Returns true if a row belongs to a driver.
    pub(crate) fn drives(&self, row: usize) -> bool {
        self.equations.block_of(row).is_some_and(|(block, _)| block.drives)
    }

    /// Returns true if a row is the norm of a body's Euler parameters.
    pub(crate) fn is_norm(&self, row: usize) -> bool {
        self.equations
            .block_of(row)
            .is_some_and(|(block, _)| block.constraint.facts().kind == "euler_norm")
    }

    /// Computes sizes and norms around a pose.
    pub(crate) fn measure(&self, q: &[f64], t: f64) -> Measures {
        let here = self.linearize(q, t);
        let values: &[f64] = here.as_ref().map_or(&[], |point| &point.values);
        let sizes = scale::sizes(self.layout, self.equations, values, (q, t), self.links);
        self.measure_by(sizes, values, (q, t))
    }

    /// Computes sizes and norms for the check of steps of time ([`scale::reaches`]).
    pub(crate) fn measure_steps(
        &self,
        q: &[f64],
        t: f64,
        Measures { sizes, .. }: &Measures,
    ) -> Measures {
        let here = self.linearize(q, t);
        let values: &[f64] = here.as_ref().map_or(&[], |point| &point.values);
        let sizes = scale::reaches(self.layout, self.equations, (q, t), sizes.clone());
        self.measure_by(sizes, values, (q, t))
    }

    fn measure_by(&self, sizes: Vec<f64>, values: &[f64], (q, t): (&[f64], f64)) -> Measures {
        /// The number of random poses near the given one.
        const POSES: u64 = 3;
        const REACH: f64 = 0.3;
        let mut norms = vec![0.0; self.m()];
        self.raise(&mut norms, values, &sizes);
        for seed in 0..POSES {
            let mut random = Random::new(seed);
            let beside: Vec<f64> =
                q.iter().zip(&sizes).map(|(q, size)| q + REACH * size * random.number()).collect();
            if let Ok(point) = self.linearize(&beside, t) {
                self.raise(&mut norms, &point.values, &sizes);
            }
        }
        norms.iter_mut().filter(|norm| **norm == 0.0).for_each(|norm| *norm = 1.0);
        self.share_among_components(&mut norms);
        let c_t = self.c_t(q, t).unwrap_or_default();
        let fastest =
            c_t.iter().zip(&norms).fold(0.0_f64, |m, (c_t, norm)| m.max((c_t / norm).abs()));
        Measures { sizes, norms, time: if fastest > 0.0 { fastest.recip() } else { 1.0 } }
    }

    /// Gives the components of one vector the same norm, so that lengths of vectors do not depend
    /// on the axes.
    fn share_among_components(&self, norms: &mut [f64]) {
        for block in &self.equations.blocks {
            let rows = block.constraint.facts().rows;
            let first = block.rows().start;
            let vector = |row: &&str| match row.rsplit_once('.') {
                Some((vector, "x" | "y" | "z")) => Some(vector.to_string()),
                None if matches!(*row, "x" | "y" | "z") => Some(String::new()),
                _ => None,
            };
            let vectors: Vec<Option<String>> = rows.iter().map(vector).collect();
            for k in (0..rows.len()).filter(|k| vectors[*k].is_some()) {
                let same = (0..rows.len()).filter(|j| vectors[*j] == vectors[k]);
                norms[first + k] = same.fold(0.0, |m, j| m.max(norms[first + j]));
            }
        }
    }

    fn raise(&self, norms: &mut [f64], values: &[f64], sizes: &[f64]) {
        for (row, column, value) in self.entries(values) {
            norms[row] = norms[row].max((value * sizes[column]).abs());
        }
    }

    /// Returns the rows of C_q in units of order 1. Rows outside `active` stay empty.
    pub(crate) fn scaled(
        &self,
        values: &[f64],
        measures: &Measures,
        active: &dyn Fn(usize) -> bool,
    ) -> Vec<Sparse> {
        let mut rows = vec![Sparse::new(); self.m()];
        for (row, column, value) in self.entries(values).filter(|(row, _, _)| active(*row)) {
            rows[row].push((column, value * measures.sizes[column] / measures.norms[row]));
        }
        rows
    }

    /// Returns true if C = 0 holds up to rounding and the permitted closure error.
    pub(crate) fn met(
        &self,
        point: &Point,
        q: &[f64],
        measures: &Measures,
        active: &dyn Fn(usize) -> bool,
    ) -> bool {
        let tolerance = TOLERANCE.max(self.misfit);
        // As a rule rounding needs no allowance of its own.
        if point.c.iter().zip(&measures.norms).all(|(c, norm)| c.abs() <= tolerance * norm) {
            return true;
        }
        let mut allowed: Vec<f64> = measures.norms.iter().map(|norm| tolerance * norm).collect();
        for (row, column, value) in self.entries(&point.values) {
            allowed[row] += 16.0 * f64::EPSILON * (value * q[column]).abs();
        }
        point
            .c
            .iter()
            .zip(allowed)
            .enumerate()
            .all(|(row, (c, allowed))| !active(row) || c.abs() <= allowed)
    }

    /// Returns the rank of C_q from its values at a pose.
    pub(crate) fn rank(&self, values: &[f64], measures: &Measures) -> usize {
        Echelon::new(self.scaled(values, measures, &|_| true), self.n(), RANK).rank()
    }

    /// Builds the error for a value that is not finite at a pose.
    pub(crate) fn not_finite(&self, bad: Bad, q: &[f64], t: f64) -> Error {
        self.equations.not_finite(bad, self.layout, &self.equations.instant_at(t, q))
    }

    /// Returns true for an angle or Euler parameter; a search limits its changes.
    pub(crate) fn turns(&self, column: usize) -> bool {
        self.layout.units[column] != Unit::Metre
    }
}
