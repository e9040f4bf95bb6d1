//! Solves the equations of derivatives by one parameter at one time, with the factors of C_q.

use std::cell::OnceCell;

use super::along::{Along, Prepared};
use crate::ask::diagnosis::explain::EXPLAIN;
use crate::linear::{Independent, Linear};
use crate::numbers::rounded::Rounded;
use crate::outcome::error::{Error, Result};
use crate::solve::explain::Start;
use crate::solve::options::SolverOptions;
use crate::system::System;
use crate::system::scaled::Measures;

/// The permitted difference of the equations of a redundant mechanism, as a share of their terms.
/// \[-\]
pub(super) const CONSISTENT: f64 = 1e-8;

/// The permitted difference, as a multiple of the first-order bound of rounding. \[-\]
pub(super) const ROUNDED: f64 = 16.0;

/// C_q at one time after the other, factored.
pub(super) struct SlopeSolver<'a> {
    system: &'a System,
    t: f64,
    /// q, q̇ and q̈ at the time.
    orders: [&'a [f64]; 3],
    /// C_q and C_p at the time with bounds of their errors, computed at the first use.
    bounded: OnceCell<Along<Rounded>>,
    kind: Kind,
}

enum Kind {
    Square(Option<Box<Linear>>),
    /// `None` before the first time.
    Redundant(Option<Box<Redundant>>),
}

/// As many independent equations as there are coordinates, and the others, which must agree.
struct Redundant {
    rows: Independent,
    measures: Measures,
    /// For each value of C_q the factor that scales it to order 1.
    scales: Vec<f64>,
    /// The largest |C_i| at the time, as a share of the row's norm.
    residual: f64,
}

impl<'a> SlopeSolver<'a> {
    pub(super) fn new(system: &'a System) -> Self {
        let kind = if system.is_redundant() { Kind::Redundant(None) } else { Kind::Square(None) };
        SlopeSolver { system, t: f64::NAN, orders: [&[]; 3], bounded: OnceCell::new(), kind }
    }

    /// Moves to the time t of a motion with these q, q̇ and q̈. Errors: a singular position.
    pub(super) fn go_to(&mut self, t: f64, orders: [&'a [f64]; 3]) -> Result<()> {
        (self.t, self.orders) = (t, orders);
        self.bounded = OnceCell::new();
        let system = self.system;
        let q = orders[0];
        match &mut self.kind {
            Kind::Square(square) => {
                let mut linear = system.linearized(q, t)?;
                if !linear.factor() {
                    return Err(system.singular(t, q, None));
                }
                *square = Some(Box::new(linear));
            }
            Kind::Redundant(redundant) => {
                let redundant =
                    redundant.get_or_insert_with(|| Box::new(Redundant::new(system, q, t)));
                redundant.factor(system, q, t)?;
            }
        }
        Ok(())
    }

    /// Returns the solution of C_qᵀ λ = w. For a redundant mechanism it is zero in the rows that
    /// are not in use.
    pub(super) fn transposed(&self, w: &[f64]) -> Vec<f64> {
        match &self.kind {
            Kind::Square(Some(linear)) => linear.solved_transposed(w),
            Kind::Redundant(Some(redundant)) => redundant.transposed(w),
            _ => vec![f64::NAN; self.system.n_equations()],
        }
    }

    /// Returns the number of coordinates.
    pub(super) fn columns(&self) -> usize {
        self.system.n_coordinates()
    }

    /// Returns the rows of a redundant mechanism that are in use, in increasing order, and the
    /// norms of all rows. Returns `None` if no equation is redundant.
    pub(super) fn in_use(&self) -> Option<(&[usize], &[f64])> {
        match &self.kind {
            Kind::Redundant(Some(redundant)) => {
                Some((redundant.rows.rows(), &redundant.measures.norms))
            }
            _ => None,
        }
    }

    /// Returns q_p, q̇_p and q̈_p by the name with this index.
    pub(super) fn forward(
        &mut self,
        prepared: &Prepared<'_>,
        along: &Along,
        (number, name): (usize, &str),
    ) -> Result<[Vec<f64>; 3]> {
        let mut found: [Vec<f64>; 3] = Default::default();
        for order in 0..3 {
            let mut rhs = vec![0.0; self.system.n_equations()];
            along.by_p[number].iter().for_each(|(row, jet)| rhs[*row] -= jet[order]);
            for (row, column, jet) in &along.by_q {
                rhs[*row] -= match order {
                    0 => 0.0,
                    1 => jet[1] * found[0][*column],
                    _ => 2.0 * jet[1] * found[1][*column] + jet[2] * found[0][*column],
                };
            }
            found[order] = self.solved(&rhs);
            if !found[order].iter().all(|x| x.is_finite()) {
                let t = self.t;
                let s = self.system.unit_words().time();
                let reason =
                    format!("at t = {t} {s} a term of the equations has no finite derivative");
                return Err(Error::no_derivative(name, reason));
            }
            self.agree(prepared, along, &rhs, (&found, order), (number, name))?;
        }
        Ok(found)
    }

    /// Returns x with C_q x = rhs.
    fn solved(&mut self, rhs: &[f64]) -> Vec<f64> {
        match &mut self.kind {
            Kind::Square(Some(linear)) => {
                linear.rhs_mut().copy_from_slice(rhs);
                linear.solve();
                linear.solution().to_vec()
            }
            Kind::Redundant(Some(redundant)) => redundant.solved(rhs),
            _ => vec![f64::NAN; self.system.n_coordinates()],
        }
    }

    /// Returns an error, by name, if the last solution does not satisfy all equations. Then the
    /// mechanism closes at one value of the parameter only.
    fn agree(
        &self,
        prepared: &Prepared<'_>,
        along: &Along,
        rhs: &[f64],
        (found, order): (&[Vec<f64>; 3], usize),
        (number, name): (usize, &str),
    ) -> Result<()> {
        let Kind::Redundant(Some(redundant)) = &self.kind else { return Ok(()) };
        let norms = &redundant.measures.norms;
        let mut missed = rhs.to_vec();
        let mut size = rhs.iter().zip(norms).fold(0.0_f64, |m, (x, norm)| m.max(x.abs() / norm));
        for (row, column, jet) in &along.by_q {
            let term = jet[0] * found[order][*column];
            missed[*row] -= term;
            size = size.max(term.abs() / norms[*row]);
        }
        let largest =
            missed.iter().zip(norms).map(|(missed, norm)| missed.abs() / norm).enumerate();
        let (row, largest) =
            largest.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst });
        if largest <= CONSISTENT * size {
            return Ok(());
        }
        // Terms that cancel leave rounding. If a derivative does not depend on the parameter, only
        // rounding remains.
        if largest <= ROUNDED * self.rounding(prepared, number, (found, order)) {
            return Ok(());
        }
        let equation = self.system.equations().equation(row);
        let reason = format!(
            "the redundant mechanism closes at this value only: with another value `{equation}` contradicts the other equations. Change this dimension together with the dimensions that must match it"
        );
        Err(Error::no_derivative(name, reason))
    }
}

impl SlopeSolver<'_> {
    /// How far rounding may bring the equations of order `last` apart, as a share of their norms,
    /// with these solutions by the name of that number; 0 where no equation is superfluous.   \[-\]
    pub(super) fn rounding(
        &self,
        prepared: &Prepared<'_>,
        number: usize,
        (found, last): (&[Vec<f64>; 3], usize),
    ) -> f64 {
        let Kind::Redundant(Some(redundant)) = &self.kind else { return 0.0 };
        let bounded = self.bounded.get_or_init(|| {
            prepared.bounded(
                self.t,
                self.orders,
                redundant.off(self.orders).each_ref().map(|off| &off[..]),
            )
        });
        redundant.rounding(bounded, number, (found, last))
    }
}

impl Redundant {
    fn new(system: &System, q: &[f64], t: f64) -> Self {
        let model = system.model();
        let entries = &system.equations().entries;
        let measures = model.measure(q, t);
        let scale = |entry: &Option<(usize, usize)>| {
            entry.map_or(0.0, |(row, column)| measures.sizes[column] / measures.norms[row])
        };
        let scales = entries.iter().map(scale).collect();
        Redundant {
            rows: Independent::new(model.m(), model.n(), entries),
            measures,
            scales,
            residual: 0.0,
        }
    }

    /// Factors C_q at a position. Errors: a singular position.
    fn factor(&mut self, system: &System, q: &[f64], t: f64) -> Result<()> {
        let model = system.model();
        let equations = system.equations();
        let not_finite = |bad| equations.not_finite(bad, model.layout, &equations.instant_at(t, q));
        let point = model.linearize(q, t).map_err(not_finite)?;
        let shares = point.c.iter().zip(&self.measures.norms).map(|(c, norm)| c.abs() / norm);
        self.residual = shares.fold(0.0, f64::max);
        if self
            .rows
            .factor(self.scales.iter().zip(&point.values).map(|(scale, value)| scale * value))
        {
            return Ok(());
        }
        Err((EXPLAIN.cannot_be_driven)(model, Start::Pose(q), t, &SolverOptions::default()))
    }

    fn solved(&mut self, rhs: &[f64]) -> Vec<f64> {
        let Measures { norms, sizes, .. } = &self.measures;
        let scaled: Vec<f64> = rhs.iter().zip(norms).map(|(rhs, norm)| rhs / norm).collect();
        self.rows.solve(&scaled).iter().zip(sizes).map(|(y, size)| y * size).collect()
    }

    fn transposed(&self, w: &[f64]) -> Vec<f64> {
        let Measures { norms, sizes, .. } = &self.measures;
        let scaled: Vec<f64> = w.iter().zip(sizes).map(|(w, size)| w * size).collect();
        self.rows.solved_transposed(&scaled).iter().zip(norms).map(|(y, norm)| y / norm).collect()
    }

    /// Returns bounds of the errors of q, q̇ and q̈, which were solved with the same factors.
    fn off(&self, orders: [&[f64]; 3]) -> [Vec<f64>; 3] {
        let sizes = &self.measures.sizes;
        let largest =
            |all: &[f64]| all.iter().zip(sizes).fold(0.0_f64, |m, (x, size)| m.max(x.abs() / size));
        let unit = (f64::EPSILON + self.residual) / self.rows.smallest_pivot();
        let rate = largest(orders[1]);
        [1.0, rate, largest(orders[2]) + rate * rate]
            .map(|share| unit * share)
            .into_iter()
            .zip(orders)
            .map(|(share, own)| {
                own.iter()
                    .zip(sizes)
                    .map(|(x, size)| share * size + f64::EPSILON * x.abs())
                    .collect()
            })
            .collect::<Vec<Vec<f64>>>()
            .try_into()
            .unwrap_or_default()
    }

    /// Returns the bound of rounding in the equations of one order, as a share of their norms: the
    /// errors of their terms, and of the solutions of lower orders in them. \[-\]
    fn rounding(
        &self,
        along: &Along<Rounded>,
        number: usize,
        (found, last): (&[Vec<f64>; 3], usize),
    ) -> f64 {
        let Measures { norms, sizes, .. } = &self.measures;
        // The relative error of each solution.
        let mut apart = [0.0_f64; 3];
        let mut worst = 0.0;
        for order in 0..=last {
            let mut off = vec![0.0; norms.len()];
            for (row, jet) in &along.by_p[number] {
                off[*row] += jet[order].off;
            }
            for (row, column, jet) in &along.by_q {
                let factors: &[(f64, usize, usize)] = match order {
                    0 => &[(1.0, 0, 0)],
                    1 => &[(1.0, 0, 1), (1.0, 1, 0)],
                    _ => &[(1.0, 0, 2), (2.0, 1, 1), (1.0, 2, 0)],
                };
                for (factor, of, by) in factors {
                    let cell = jet[*of];
                    let x = found[*by][*column].abs();
                    let known = if *of == 0 { 0.0 } else { apart[*by] * sizes[*column] };
                    off[*row] +=
                        factor * (cell.off * x + cell.x.abs() * (known + f64::EPSILON * x));
                }
            }
            worst = off.iter().zip(norms).fold(0.0, |m, (off, norm)| f64::max(m, off / norm))
                / self.rows.smallest_pivot();
            apart[order] = worst;
        }
        worst
    }
}
