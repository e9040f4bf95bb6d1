//! Computes and stores the multipliers λ of all constraints.

use super::acting::Now;
use super::friction::Rub;
use crate::coordinates::units::Unit;
use crate::linear::{Echelon, Independent, Linear, RANK};
use crate::outcome::error::Result;
use crate::system::System;
use crate::system::evaluate::Instant;
use crate::system::scaled::{Measures, Point};

/// A component is unique if a vector of the null space, which changes no balance, changes it by
/// less than this where it changes something by 1. \[-\]
pub(super) const LOOSE: f64 = 1e-7;

/// λ at one time, with the data that belong to it.
pub(super) struct Multipliers {
    /// λ, one number for each equation.
    pub lambda: Vec<f64>,
    pub beside: BesideThem,
}

/// Data of the multipliers that only redundant mechanisms and those with friction have.
#[derive(Default)]
pub(super) struct BesideThem {
    /// Vectors of the null space of C_qᵀ; empty for a mechanism without redundant equations. The
    /// vectors are scaled: the largest generalised force times the size of its coordinate, for any
    /// entry, is 1.
    pub open: Vec<Vec<f64>>,
    /// The factors that scale the entries of each row to order 1, if there are such vectors.
    norms: Vec<f64>,
    /// The characteristic length, if the null space has vectors. \[m\]
    pub length: f64,
    /// The friction in each joint that has it.
    pub rubs: Vec<Rub>,
}

impl BesideThem {
    const NOTHING: BesideThem =
        BesideThem { open: Vec::new(), norms: Vec::new(), length: 1.0, rubs: Vec::new() };

    /// Returns the constraints that share what is not unique, from the vectors of the null space
    /// that change it.
    pub(super) fn sharing(&self, system: &System, is_in_it: impl Fn(usize) -> bool) -> Vec<String> {
        let own: Vec<&Vec<f64>> = self
            .open
            .iter()
            .enumerate()
            .filter(|(number, _)| is_in_it(*number))
            .map(|(_, y)| y)
            .collect();
        let shares = |row: usize| {
            own.iter().any(|y| (y[row] * self.norms.get(row).unwrap_or(&1.0)).abs() > LOOSE)
        };
        let blocks = system.equations().blocks.iter();
        blocks.filter(|block| block.rows().any(shares)).map(|block| block.name.clone()).collect()
    }
}

/// The multipliers of all times.
pub(super) struct AllMultipliers {
    rows: usize,
    lambda: Vec<f64>,
    /// One entry for each time, or empty if no time has an entry.
    beside: Vec<BesideThem>,
}

/// Returns a list of `count` NaN, written by many threads at once.
pub(super) fn not_numbers(count: usize) -> Vec<f64> {
    const MANY: [f64; 64] = [f64::NAN; 64];
    let mut list = Vec::with_capacity(count);
    while list.len() < count {
        list.extend_from_slice(&MANY[..MANY.len().min(count - list.len())]);
    }
    list
}

impl AllMultipliers {
    /// Creates multipliers for these equations and times, filled with NaN.
    pub(super) fn new(rows: usize, times: usize) -> Self {
        AllMultipliers { rows, lambda: not_numbers(rows * times), beside: Vec::new() }
    }

    /// Returns λ of all times, one row for each time.
    pub(super) fn all(&mut self) -> &mut [f64] {
        &mut self.lambda
    }

    /// Stores the multipliers of time k. The additional data must come in the order of the times.
    pub(super) fn set(&mut self, k: usize, found: Multipliers) {
        self.at_mut(k).copy_from_slice(&found.lambda);
        if !(found.beside.open.is_empty() && found.beside.rubs.is_empty()) {
            self.beside.resize_with(k, BesideThem::default);
            self.beside.push(found.beside);
        }
    }

    /// Returns λ at time k.
    pub(super) fn at(&self, k: usize) -> &[f64] {
        &self.lambda[k * self.rows..][..self.rows]
    }

    pub(super) fn at_mut(&mut self, k: usize) -> &mut [f64] {
        &mut self.lambda[k * self.rows..][..self.rows]
    }

    pub(super) fn beside(&self, k: usize) -> &BesideThem {
        self.beside.get(k).unwrap_or(const { &BesideThem::NOTHING })
    }

    /// Removes and returns the null space at time k, because λ is unique from now on.
    pub(super) fn close(&mut self, k: usize) -> Vec<Vec<f64>> {
        self.beside.get_mut(k).map(|beside| std::mem::take(&mut beside.open)).unwrap_or_default()
    }
}

/// Solves C_qᵀ λ = Q at one time after the other. It tries the elimination of the preceding time
/// first.
pub(super) struct TransposedSolver<'a> {
    system: &'a System,
    instant: Instant,
    kind: Kind,
    c: Vec<f64>,
}

enum Kind {
    Square(Box<Linear>),
    Redundant { rows: Box<Independent>, values: Vec<f64>, measures: Option<Measures> },
}

impl<'a> TransposedSolver<'a> {
    pub(super) fn new(system: &'a System) -> Self {
        let equations = system.equations();
        let m = system.n_equations();
        let n = system.n_coordinates();
        let kind = if system.is_redundant() {
            let rows = Box::new(Independent::new(m, n, &equations.entries));
            Kind::Redundant { rows, values: vec![0.0; equations.entries.len()], measures: None }
        } else {
            let mut linear = system.linear();
            linear.forget();
            equations.set_constants(linear.values_mut());
            Kind::Square(Box::new(linear))
        };
        TransposedSolver { system, instant: equations.instant(), kind, c: vec![0.0; m] }
    }

    /// Returns the system whose forces these are.
    pub(super) fn system(&self) -> &'a System {
        self.system
    }

    /// Returns λ for other generalised forces, with the elimination of the last solution.
    pub(super) fn transposed(&self, by_q: &[f64]) -> Vec<f64> {
        match &self.kind {
            Kind::Square(linear) => linear.solved_transposed(by_q),
            Kind::Redundant { rows, measures, .. } => {
                let Some(measures) = measures else { return vec![0.0; self.system.n_equations()] };
                let scaled: Vec<f64> =
                    by_q.iter().zip(&measures.sizes).map(|(q, size)| q * size).collect();
                let mut lambda = rows.solved_transposed(&scaled);
                lambda.iter_mut().zip(&measures.norms).for_each(|(lambda, norm)| *lambda /= norm);
                lambda
            }
        }
    }

    /// Returns −C_qᵀ λ of one constraint at the time of the last solution.
    pub(super) fn by_block(&self, block: usize, lambda: &[f64]) -> Vec<f64> {
        let equations = self.system.equations();
        let values = match &self.kind {
            Kind::Square(linear) => linear.values(),
            Kind::Redundant { values, .. } => values,
        };
        let mut by_q = vec![0.0; self.system.n_coordinates()];
        let own = equations.blocks[block].values();
        for (entry, value) in equations.entries[own.clone()].iter().zip(&values[own]) {
            if let Some((row, column)) = entry {
                by_q[*column] -= value * lambda[*row];
            }
        }
        by_q
    }

    /// Returns λ · C_t, the power of all drivers, at the time of the last solution. \[W\]
    pub(super) fn power(&mut self, lambda: &[f64]) -> f64 {
        self.system.equations().velocity_rhs(&self.instant, &mut self.c);
        self.c.iter().zip(lambda).map(|(minus_c_t, lambda)| -minus_c_t * lambda).sum()
    }

    /// Returns λ for the generalised forces Q. Errors: a singular position, terms that are not
    /// finite.
    pub(super) fn solve(&mut self, now: Now<'_>, by_q: &[f64]) -> Result<Multipliers> {
        let system = self.system;
        let equations = self.system.equations();
        equations.set_time(now.t, &mut self.instant);
        equations.set_position(now.q, &mut self.instant);
        match &mut self.kind {
            Kind::Square(linear) => {
                equations.linearize(now.q, &self.instant, &mut self.c, linear.values_mut());
                let finite = equations.finite(&self.c, linear.values());
                finite.map_err(|bad| equations.not_finite(bad, system.layout(), &self.instant))?;
                if !(linear.measure() && linear.factor()) {
                    return Err(system.singular(now.t, now.q, None));
                }
                let beside = BesideThem::default();
                Ok(Multipliers { lambda: linear.solved_transposed(by_q), beside })
            }
            Kind::Redundant { rows, values, measures } => {
                equations.set_constants(values);
                equations.linearize(now.q, &self.instant, &mut self.c, values);
                let finite = equations.finite(&self.c, values);
                finite.map_err(|bad| equations.not_finite(bad, system.layout(), &self.instant))?;
                let model = system.model();
                let measures = measures.get_or_insert_with(|| model.measure(now.q, now.t));
                let unit = |(entry, value): (&Option<(usize, usize)>, &f64)| {
                    entry.map_or(0.0, |(row, column)| {
                        value * measures.sizes[column] / measures.norms[row]
                    })
                };
                let scaled_values: Vec<f64> =
                    equations.entries.iter().zip(values.iter()).map(unit).collect();
                if !rows.factor(scaled_values.iter().copied()) {
                    return Err(system.singular(now.t, now.q, None));
                }
                let scaled: Vec<f64> =
                    by_q.iter().zip(&measures.sizes).map(|(q, size)| q * size).collect();
                let mut lambda = rows.solved_transposed(&scaled);
                let point = Point { c: Vec::new(), values: values.clone() };
                let mut open = null_space(system, &point, measures);
                for y in &mut open {
                    // The solver omitted entries close to zero; this adds their part of the
                    // balance.
                    let mut left = vec![0.0; system.n_coordinates()];
                    for (entry, value) in equations.entries.iter().zip(&scaled_values) {
                        if let Some((row, column)) = entry {
                            left[*column] += value * y[*row];
                        }
                    }
                    y.iter_mut()
                        .zip(rows.solved_transposed(&left))
                        .for_each(|(y, part)| *y -= part);
                }
                for y in open.iter_mut().chain([&mut lambda]) {
                    y.iter_mut().zip(&measures.norms).for_each(|(y, norm)| *y /= norm);
                }
                let length = length(system, &measures.sizes);
                let norms = measures.norms.to_vec();
                Ok(Multipliers {
                    lambda,
                    beside: BesideThem { open, norms, length, rubs: Vec::new() },
                })
            }
        }
    }
}

/// Returns orthonormal vectors y with yᵀ C_q = 0, for rows in units of order 1.
fn null_space(system: &System, point: &Point, measures: &Measures) -> Vec<Vec<f64>> {
    let model = system.model();
    let m = system.n_equations();
    let rows = model.scaled(&point.values, measures, &|_| true);
    let found = Echelon::new(rows, system.n_coordinates(), RANK).left_null_space();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for sparse in found {
        let mut y = vec![0.0; m];
        sparse.iter().for_each(|(row, value)| y[*row] = *value);
        // Twice is enough (Kahan).
        for _ in 0..2 {
            for known in &basis {
                let share: f64 = known.iter().zip(&y).map(|(a, b)| a * b).sum();
                y.iter_mut().zip(known).for_each(|(y, known)| *y -= share * known);
            }
        }
        let norm = y.iter().map(|y| y * y).sum::<f64>().sqrt();
        if norm > RANK {
            y.iter_mut().for_each(|y| *y /= norm);
            basis.push(y);
        }
    }
    basis
}

/// Returns the size of a length coordinate, or 1 if there is none.
fn length(system: &System, sizes: &[f64]) -> f64 {
    let units = &system.layout().units;
    let metre = units.iter().position(|unit| *unit == Unit::Metre);
    metre.and_then(|k| sizes.get(k)).copied().unwrap_or(1.0)
}
