//! The first position: from a rough guess to C(q, t) = 0, in the preferred assembly.
//!
//! Driven bodies are turned to their drivers first. Then, where nothing is preferred, damped Newton steps. Where they fail, or an assembly
//! is preferred, damped least squares on C (Levenberg–Marquardt, which needs no regular C_q) with the preferred coordinates held softly,
//! then ever more softly, then not at all; Newton ends it. Where that fails too, the same from a few other starts, always the same ones.

use super::{Failure, Newton, Outcome, Steps, driven, largest};
use crate::error::{Error, Result};
use crate::layout::Unit;
use crate::linear::Linear;
use crate::system::scale;

/// Starts that are tried.
const STARTS: usize = 16;

/// How firmly preferred coordinates are held, stage by stage, against rows of norm 1.   \[-\]
const HOLDS: [f64; 3] = [1.0, 0.1, 0.0];

/// A preferred coordinate that ends this near is in the preferred assembly.   \[rad, or typical lengths\]
const NEAR: f64 = std::f64::consts::FRAC_PI_4;

/// Sizes of guess and solution that differ by less than this factor are the same.   \[-\]
const SAME: f64 = 1.25;

/// Solves at the first time t from the system's guess; q̇ and q̈ too.
pub(crate) fn assemble(newton: &mut Newton<'_>, t: f64) -> Result<Outcome> {
    if !newton.options.rescue {
        return from_start(newton, t, Steps::Full);
    }
    measure(newton, t);
    let outcome = search(newton, t)?;
    newton.rates().map_err(|failure| newton.error(failure, t, None))?;
    Ok(outcome)
}

/// Solves at time t from the point in hand by Newton steps of that kind; q̇ and q̈ too.
pub(crate) fn from_start(newton: &mut Newton<'_>, t: f64, steps: Steps) -> Result<Outcome> {
    measure(newton, t);
    if steps == Steps::Damped {
        driven::turn(newton, t);
    }
    let outcome = attempt(newton, t, steps)?;
    newton.rates().map_err(|failure| newton.error(failure, t, None))?;
    Ok(outcome)
}

/// Takes the characteristic sizes of the point in hand; without C_q if that is not finite there.
fn measure(newton: &mut Newton<'_>, t: f64) {
    let sizes = sizes(newton, t);
    // Where the first look at the model was far off, the measures taken with it are worth nothing.
    if differ(&sizes, &newton.sizes, 8.0) {
        newton.linear.forget();
    }
    newton.set_sizes(sizes);
}

fn sizes(newton: &mut Newton<'_>, t: f64) -> Vec<f64> {
    let values: &[f64] = if newton.linearize(t).is_ok() { newton.linear.values() } else { &[] };
    let system = newton.system;
    scale::sizes(system.layout(), system.equations(), values, &newton.q, system.links())
}

fn differ(sizes: &[f64], others: &[f64], factor: f64) -> bool {
    sizes.iter().zip(others).any(|(size, other)| !(factor.recip()..factor).contains(&(size / other)))
}

/// Newton from the point in hand; then once more with the sizes of the solution, which takes no step, if they are others.
fn attempt(newton: &mut Newton<'_>, t: f64, steps: Steps) -> Result<Outcome> {
    let tried = newton.solve(t, steps).and_then(|outcome| {
        if !differ(&sizes(newton, t), &newton.sizes, SAME) {
            return Ok(outcome);
        }
        measure(newton, t);
        newton.solve(t, steps)
    });
    let outcome = tried.map_err(|failure| newton.error(failure, t, None))?;
    newton.meant().map(|()| outcome)
}

/// Start after start until one ends in the preferred assembly; else the nearest to it, else the error that says most.
fn search(newton: &mut Newton<'_>, t: f64) -> Result<Outcome> {
    let preferred = newton.system.preferred();
    let mut failure: Option<Error> = None;
    driven::turn(newton, t);
    let guess = newton.q.clone();
    if preferred.is_empty() {
        match attempt(newton, t, Steps::Damped) {
            Ok(outcome) => return Ok(outcome),
            Err(error) => failure = Some(error),
        }
    }
    let mut best: Option<(f64, Vec<f64>)> = None;
    for start in 0..STARTS {
        place(newton, &guess, start);
        approach(newton, t);
        match attempt(newton, t, Steps::Damped) {
            Ok(outcome) => {
                let far = distance(newton);
                if far <= NEAR {
                    return Ok(outcome);
                }
                if best.as_ref().is_none_or(|(known, _)| far < *known) {
                    best = Some((far, newton.q.clone()));
                }
            }
            Err(error) => failure = Some(more_telling(failure, error)),
        }
    }
    if let Some((_, q)) = best {
        newton.q = q;
        return attempt(newton, t, Steps::Damped);
    }
    Err(failure.unwrap_or_else(|| newton.error(Failure::NoConvergence { row: 0, residual: f64::INFINITY }, t, None)))
}

/// A singular position says more than none, and a near miss more than a far one.
fn more_telling(known: Option<Error>, new: Error) -> Error {
    let weight = |error: &Error| match error {
        Error::WrongBranch { .. } => (4, 0.0),
        Error::SingularAt { unmet: None, .. } => (3, 0.0),
        Error::NoConvergence { residual, .. } => (2, *residual),
        Error::SingularAt { .. } => (1, 0.0),
        _ => (0, 0.0),
    };
    match known {
        Some(known) => {
            let (a, b) = (weight(&known), weight(&new));
            if b.0 > a.0 || (b.0 == a.0 && b.1 < a.1) { new } else { known }
        }
        None => new,
    }
}

/// How far the worst preferred coordinate is from its value, relative to its size.
fn distance(newton: &Newton<'_>) -> f64 {
    largest(newton.system.preferred().iter().map(|&(column, value)| (newton.q[column] - value).abs() / newton.sizes[column]))
}

/// The guess, from the second start on with everything but the preferred coordinates moved at random, more at later starts.
fn place(newton: &mut Newton<'_>, guess: &[f64], start: usize) {
    newton.q.copy_from_slice(guess);
    let reach = 3.0 * (start as f64 / STARTS as f64).sqrt();
    let mut state = start as u64;
    for ((q, size), unit) in newton.q.iter_mut().zip(&newton.sizes).zip(&newton.system.layout().units) {
        let share = if *unit == Unit::One { 0.3 } else { 1.0 };
        *q += share * reach * size * random(&mut state);
    }
    for &(column, value) in newton.system.preferred() {
        newton.q[column] = value;
    }
}

/// SplitMix64, uniform in (−1, 1).
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 * 2.0_f64.powi(-52) - 1.0
}

/// Damped least squares from the point in hand, the preferred coordinates held ever more softly.
fn approach(newton: &mut Newton<'_>, t: f64) {
    let skip = if newton.system.preferred().is_empty() { HOLDS.len() - 1 } else { 0 };
    let mut squares = LeastSquares::new(newton);
    for hold in &HOLDS[skip..] {
        squares.minimise(newton, t, *hold);
    }
}

/// Levenberg–Marquardt on Σ (w_i C_i)² + Σ (h (q_p − v_p)/s_p)², unknowns y_j = dq_j / s_j.
///
/// Each step solves [I, J; Jᵀ, −λ I] (r, y) = (−c, 0), which is (Jᵀ J + λ I) y = −Jᵀ c without squaring J.
struct LeastSquares {
    linear: Linear,
    /// w_i, one over the norm of row i.
    weights: Vec<f64>,
    before: Vec<f64>,
    lambda: f64,
}

impl LeastSquares {
    /// Steps of one stage.
    const STEPS: usize = 200;
    const LAMBDA: std::ops::RangeInclusive<f64> = 1e-10..=1e10;

    fn new(newton: &Newton<'_>) -> Self {
        let (n, rows) = (newton.q.len(), newton.c.len());
        let preferred = newton.system.preferred();
        let above = rows + preferred.len();
        let identity = (0..above).map(|i| Some((i, i)));
        let damping = (0..n).map(|j| Some((above + j, above + j)));
        let holds = preferred.iter().enumerate().map(|(k, &(column, _))| Some((rows + k, column)));
        let jacobian: Vec<_> = newton.system.equations().entries.iter().copied().chain(holds).collect();
        let upper = jacobian.iter().map(|entry| entry.map(|(row, column)| (row, above + column)));
        let lower = jacobian.iter().map(|entry| entry.map(|(row, column)| (above + column, row)));
        let constants = vec![Some(1.0); above];
        let linear = Linear::new(above + n, identity.chain(damping).chain(upper).chain(lower), &constants);
        LeastSquares { linear, weights: vec![1.0; rows], before: vec![0.0; n], lambda: 1e-2 }
    }

    /// Lowers the sum of squares as far as it goes; the point in hand is where it ended.
    fn minimise(&mut self, newton: &mut Newton<'_>, t: f64, hold: f64) {
        if newton.linearize(t).is_err() {
            return;
        }
        self.weigh(newton);
        self.lambda = 1e-2;
        let mut merit = self.merit(newton, hold);
        for _ in 0..Self::STEPS {
            if merit < 1e-20 || !Self::LAMBDA.contains(&self.lambda) {
                break;
            }
            self.before.copy_from_slice(&newton.q);
            let (length, turn) = self.step(newton, hold);
            let lower = turn <= super::TURN && newton.linearize(t).is_ok() && self.merit(newton, hold) < merit;
            if lower {
                merit = self.merit(newton, hold);
                newton.steps += 1;
                self.lambda = (self.lambda * 0.2).max(*Self::LAMBDA.start());
                if length < 1e-9 {
                    break;
                }
            } else {
                newton.q.copy_from_slice(&self.before);
                self.lambda *= 4.0;
                if newton.linearize(t).is_err() {
                    break;
                }
            }
        }
    }

    /// One over the norm of each row.
    fn weigh(&mut self, newton: &Newton<'_>) {
        for (weight, norm) in self.weights.iter_mut().zip(newton.linear.norms()) {
            *weight = if *norm > 0.0 { norm.recip() } else { 1.0 };
        }
    }

    fn merit(&self, newton: &Newton<'_>, hold: f64) -> f64 {
        let rows: f64 = newton.c.iter().zip(&self.weights).map(|(c, w)| (w * c).powi(2)).sum();
        let held: f64 = newton.system.preferred().iter().map(|&p| offset(newton, p, hold).powi(2)).sum();
        rows + held
    }

    /// One step of the point in hand; gives the largest share in it and the largest turn, infinite where there is no step.
    fn step(&mut self, newton: &mut Newton<'_>, hold: f64) -> (f64, f64) {
        self.fill(newton, hold);
        self.linear.forget();
        self.linear.measure();
        if self.linear.factor().is_err() {
            return (f64::INFINITY, f64::INFINITY);
        }
        self.linear.solve();
        let y = &self.linear.solution()[newton.c.len() + newton.system.preferred().len()..];
        for ((q, y), size) in newton.q.iter_mut().zip(y).zip(&newton.sizes) {
            *q += y * size;
        }
        let turns = y.iter().zip(&newton.system.layout().units).filter(|(_, unit)| **unit != Unit::Metre);
        (largest(y.iter().map(|y| y.abs())), largest(turns.map(|(y, _)| y.abs())))
    }

    /// Writes the values in the order of the pattern, and (−c, 0).
    fn fill(&mut self, newton: &Newton<'_>, hold: f64) {
        let preferred = newton.system.preferred();
        let above = self.weights.len() + preferred.len();
        let entries = newton.system.equations().entries.iter().zip(newton.linear.values());
        let scaled = |(entry, value): (&Option<(usize, usize)>, &f64)| match *entry {
            Some((row, column)) => self.weights[row] * value * newton.sizes[column],
            None => 0.0,
        };
        let jacobian: Vec<f64> = entries.map(scaled).chain(preferred.iter().map(|_| hold)).collect();
        let identity = std::iter::repeat_n(1.0, above);
        let damping = std::iter::repeat_n(-self.lambda, newton.q.len());
        let all = identity.chain(damping).chain(jacobian.iter().copied()).chain(jacobian.iter().copied());
        self.linear.values_mut().iter_mut().zip(all).for_each(|(place, value)| *place = value);

        self.linear.rhs_mut().fill(0.0);
        let rows = newton.c.iter().zip(&self.weights).map(|(c, w)| -w * c);
        let held = preferred.iter().map(|&p| -offset(newton, p, hold));
        self.linear.rhs_mut().iter_mut().zip(rows.chain(held)).for_each(|(place, value)| *place = value);
    }
}

/// h (q_p − v_p) / s_p
fn offset(newton: &Newton<'_>, (column, value): (usize, f64), hold: f64) -> f64 {
    hold * (newton.q[column] - value) / newton.sizes[column]
}
