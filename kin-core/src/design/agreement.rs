//! Checks, for all parameters at once, that the redundant equations of a mechanism still agree with
//! the other equations when a parameter changes.
//!
//! Let ν(t) satisfy νᵀ C_q = 0 at all times. Then g = νᵀ C_p and its time derivatives vanish if and
//! only if C_q q_p = −C_p and its derivatives have solutions. One vector ν checks all parameters: ν
//! combines the redundant rows with random factors, so that contradictions do not cancel. With ν
//! instead of λ₂ the equations of the adjoint give λ₁ = 2 ν̇ and λ₀ = ν̈
//! ([`super::adjoint::adjoint`]).

use super::adjoint::adjoint;
use super::along::{Along, Prepared};
use super::solver::{CONSISTENT, ROUNDED, SlopeSolver};
use crate::numbers::random::Random;
use crate::outcome::error::Result;
use crate::solve::motion::Motion;

/// The data with which a tape checks whether redundant equations agree.
pub(super) struct Agreement {
    /// The rows in use, as many as there are coordinates.
    pub rows: Vec<usize>,
    /// For each row ν: random in the redundant rows, 0 in those in use.
    pub shares: Vec<f64>,
    /// For each name the bounds of rounding in g, ġ and g̈. A bound is 0 if rounding is far smaller
    /// than the terms.
    pub limits: Vec<[f64; 3]>,
}

impl Agreement {
    /// Prepares the check along a motion. It bounds rounding at the first time and at the fastest
    /// times. Returns `None` if no equation is redundant.
    ///
    /// Errors: by name if a change of a parameter makes the equations contradict each other at one
    /// of these times; a singular position.
    pub(super) fn along(
        prepared: &mut Prepared<'_>,
        motion: &Motion,
        names: &[String],
    ) -> Result<Option<Agreement>> {
        let mut solver = SlopeSolver::new(prepared.system);
        let mut found = None;
        for k in fastest(motion) {
            let t = motion.times()[k];
            let orders = [motion.q(k), motion.qd(k), motion.qdd(k)];
            solver.go_to(t, orders)?;
            let Some(shares) = shares(&solver) else { return Ok(None) };
            let along = prepared.at(t, orders);
            let count = shares.iter().filter(|share| **share != 0.0).count() as f64;
            let agreement = found.get_or_insert_with(|| Agreement {
                rows: solver.in_use().map_or_else(Vec::new, |(rows, _)| rows.to_vec()),
                shares: shares.clone(),
                limits: vec![[0.0; 3]; names.len()],
            });
            for number in doubtful(&solver, &along, shares) {
                let orders = solver.forward(prepared, &along, (number, &names[number]))?;
                for (order, limit) in agreement.limits[number].iter_mut().enumerate() {
                    let rounding = solver.rounding(prepared, number, (&orders, order));
                    *limit = limit.max(ROUNDED * count * rounding);
                }
            }
        }
        Ok(found)
    }
}

/// Returns an error, by name, if a change of a parameter makes the equations contradict each other
/// at the time of the solver.
pub(super) fn check(
    solver: &mut SlopeSolver<'_>,
    prepared: &Prepared<'_>,
    along: &Along,
    names: &[String],
) -> Result<()> {
    let Some(shares) = shares(solver) else { return Ok(()) };
    // Only the equations themselves show what is rounding.
    let doubtful = doubtful(solver, along, shares).into_iter();
    doubtful.map(|number| (number, &names[number][..])).try_for_each(|name| {
        solver.forward(prepared, along, name)?;
        Ok(())
    })
}

/// ν in the superfluous rows, in which it may be anything, and 0 in the others; `None` where no
/// equation is superfluous.
fn shares(solver: &SlopeSolver<'_>) -> Option<Vec<f64>> {
    let (rows, norms) = solver.in_use()?;
    let mut random = Random::new(1);
    let share = |(row, norm): (usize, &f64)| {
        // A row gets the same number whichever rows are in use.
        let share = 0.75 + 0.25 * random.number();
        if rows.binary_search(&row).is_ok() { 0.0 } else { share / norm }
    };
    Some(norms.iter().enumerate().map(share).collect())
}

/// The numbers of the names of which g, ġ or g̈ are more than a small share of their terms.
fn doubtful(solver: &SlopeSolver<'_>, along: &Along, shares: Vec<f64>) -> Vec<usize> {
    let none = [(); 3].map(|()| vec![0.0; solver.columns()]);
    let nu = adjoint(solver, along, shares, none);
    let is_doubtful = |by_p: &Vec<(usize, [f64; 3])>| {
        (0..3).any(|order| {
            let mut sum = 0.0_f64;
            let mut size = 0.0;
            for (row, jet) in by_p {
                for (factor, of, by) in TERMS[order] {
                    let term: f64 = factor * nu[*of][*row] * jet[*by];
                    sum += term;
                    size += term.abs();
                }
            }
            // A sum that is NaN is doubtful too.
            sum.is_nan() || sum.abs() > CONSISTENT * size
        })
    };
    along
        .by_p
        .iter()
        .enumerate()
        .filter(|(_, by_p)| is_doubtful(by_p))
        .map(|(number, _)| number)
        .collect()
}

/// g, ġ and g̈ as sums of terms (factor, k, order): the factor times the multiplier λ_k times the
/// derivative of C_p by time of this order.
pub(super) const TERMS: [&[(f64, usize, usize)]; 3] =
    [&[(1.0, 2, 0)], &[(1.0, 2, 1), (0.5, 1, 0)], &[(1.0, 2, 2), (1.0, 1, 1), (1.0, 0, 0)]];

/// Returns the first time of a motion, and those with the largest q̇ and q̈, where rounding is
/// largest.
fn fastest(motion: &Motion) -> Vec<usize> {
    let size = |all: &[f64]| all.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let largest =
        |of: &dyn Fn(usize) -> f64| (0..motion.len()).max_by(|a, b| of(*a).total_cmp(&of(*b)));
    let rate = largest(&|k| size(motion.qd(k)));
    let second_rate = largest(&|k| size(motion.qdd(k)));
    let mut all: Vec<usize> =
        [(!motion.is_empty()).then_some(0), rate, second_rate].into_iter().flatten().collect();
    let mut seen = Vec::new();
    all.retain(|k| {
        !seen.contains(k) && {
            seen.push(*k);
            true
        }
    });
    all
}
