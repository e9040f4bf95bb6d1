//! Finds minimal sets of equations that depend on one another, with coefficients.

use crate::outcome::verdict::{Class, Dependency, Level, Persistence, Term};

use super::examined::{Examined, Side};
use super::freedom;
use crate::linear::{LeastSquares, Sparse};
use crate::solve::redundant::{ALLOWED, CONSISTENT};

/// At an open gap a coefficient below this value, in units of the norms of its rows, counts as
/// zero. \[-\]
const OPEN: f64 = 1e-4;

/// Returns all dependencies at the pose.
pub(super) fn all(examined: &Examined<'_>, persistence: &[Persistence]) -> Vec<Dependency> {
    if examined.here.dependent.is_empty() {
        return Vec::new();
    }
    let rates = Rates::new(examined);
    let blocked = freedom::infinitesimal(examined, persistence);
    let found = examined.here.dependent.iter().enumerate();
    found
        .map(|(k, (row, vector))| dependency(examined, &rates, &blocked, k, *row, vector))
        .collect()
}

fn dependency(
    examined: &Examined<'_>,
    rates: &Rates,
    blocked: &[Vec<f64>],
    k: usize,
    own: usize,
    vector: &Sparse,
) -> Dependency {
    let norms = &examined.measures().norms;
    let unit = norms[own];
    let mut combination: Sparse =
        vector.iter().map(|(row, y)| (*row, y * unit / norms[*row])).collect();
    if !examined.gaps.is_empty() {
        // At a smallest gap the pose is known to fewer digits, and so are all coefficients.
        combination.retain(|(row, z)| *row == own || (z * norms[*row] / unit).abs() > OPEN);
    }
    combination.sort_by_key(|(row, _)| (*row != own, *row));
    let class = class(examined, rates, blocked, k, &combination, unit);
    let term = |&(row, coefficient): &(usize, f64)| {
        let constraint = examined
            .model()
            .equations
            .block_of(row)
            .map(|(block, _)| block.name.clone())
            .unwrap_or_default();
        Term { constraint, equation: examined.model().equations.equation(row), row, coefficient }
    };
    // The norms of Euler parameters always hold, and no user wrote them.
    let told = combination.iter().filter(|(row, _)| *row == own || !examined.model().is_norm(*row));
    Dependency { class, terms: told.map(term).collect() }
}

fn class(
    examined: &Examined<'_>,
    rates: &Rates,
    blocked: &[Vec<f64>],
    k: usize,
    combination: &Sparse,
    unit: f64,
) -> Class {
    if combination.iter().any(|(row, _)| examined.open(*row)) {
        // A gap has a direction, and no axis needs to be along it. So all equations of an open
        // constraint are reported.
        return Class::Contradictory {
            level: Level::Position,
            residual: left_over(&rates.c, combination, 0.0),
        };
    }
    let bends = |v: &Vec<f64>| {
        let along =
            examined.model().second_order(examined.q, examined.t, v, 0.0).unwrap_or_default();
        left_over(
            &along,
            combination,
            unit * v
                .iter()
                .zip(&examined.measures().sizes)
                .map(|(v, s)| (v / s).powi(2))
                .sum::<f64>(),
        ) != 0.0
    };
    if !examined.persists(k, Side::Rows) || blocked.iter().any(bends) {
        return Class::OnlyHere;
    }
    let fastest = unit / examined.measures().time;
    for (level, rhs, size) in [
        (Level::Velocity, &rates.velocity, fastest),
        (Level::Acceleration, &rates.acceleration, fastest / examined.measures().time),
    ] {
        // A run allows the same, so that both have one opinion.
        let share = CONSISTENT.max(ALLOWED * examined.model().misfit);
        let residual = beyond(rhs, combination, size, share);
        if residual != 0.0 {
            return Class::Contradictory { level, residual };
        }
    }
    Class::Redundant
}

/// Returns Σ coefficient · rhs_i, or zero if it is within rounding of its terms or of the usual
/// size.
fn left_over(rhs: &[f64], combination: &Sparse, size: f64) -> f64 {
    beyond(rhs, combination, size, CONSISTENT)
}

/// Returns Σ coefficient · rhs_i, or zero if it is at most this share of its terms.
fn beyond(rhs: &[f64], combination: &Sparse, size: f64, share: f64) -> f64 {
    let terms = || combination.iter().filter_map(|(row, z)| Some(z * rhs.get(*row)?));
    let (sum, sizes) =
        terms().fold((0.0, size), |(sum, sizes), term| (sum + term, sizes + term.abs()));
    if sum.abs() > share * sizes { sum } else { 0.0 }
}

/// C, C_t and −Q_d at the pose. A list is empty if it is not finite or not determined.
struct Rates {
    c: Vec<f64>,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
}

impl Rates {
    fn new(examined: &Examined<'_>) -> Self {
        let model = examined.model();
        let q = examined.q;
        let t = examined.t;
        let c = model.linearize(q, t).map(|point| point.c).unwrap_or_default();
        let velocity = model.c_t(q, t).unwrap_or_default();
        let determined = examined.here.free.is_empty();
        let qd = if determined { velocities(examined, &velocity) } else { None };
        let acceleration =
            qd.and_then(|qd| model.second_order(q, t, &qd, 1.0).ok()).unwrap_or_default();
        Rates { c, velocity, acceleration }
    }
}

/// Returns q̇ from C_q q̇ = −C_t by least squares.
fn velocities(examined: &Examined<'_>, c_t: &[f64]) -> Option<Vec<f64>> {
    let model = examined.model();
    let measures = examined.measures();
    let q = examined.q;
    let t = examined.t;
    let point = model.linearize(q, t).ok()?;
    let mut least_squares = LeastSquares::new(model.m(), model.n(), &model.equations.entries);
    let scale = |entry: &Option<(usize, usize)>| {
        entry.map_or(0.0, |(row, column)| measures.sizes[column] / measures.norms[row])
    };
    let values = model
        .equations
        .entries
        .iter()
        .zip(&point.values)
        .map(|(entry, value)| scale(entry) * value);
    if !least_squares.factor(values, 0.0) {
        return None;
    }
    let y = least_squares.solve(c_t.iter().zip(&measures.norms).map(|(c_t, norm)| -c_t / norm));
    Some(y.iter().zip(&measures.sizes).map(|(y, size)| y * size).collect())
}
