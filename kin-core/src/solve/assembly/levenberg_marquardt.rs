//! Minimises |C|² by damped least squares (Levenberg–Marquardt).
//!
//! The method accepts more equations than coordinates, dependent equations, and equations that
//! cannot be satisfied.

use crate::linear::LeastSquares;
use crate::system::scaled::{Measures, Model, Point};

/// The largest rotation of a body in one step. \[rad\]
const TURN: f64 = 1.0;

/// The search ends after this number of consecutive steps that raise the sum of squares.
const IDLE: usize = 200;

/// The damping at the start, and its limits, for rows and columns of order 1. \[-\]
const START: f64 = 1e-2;
const DAMPING: std::ops::RangeInclusive<f64> = 1e-11..=1e10;

/// A sum of squares below this value is zero within rounding; a step shorter than the second value
/// counts as none. \[-\]
const ZERO: f64 = 1e-28;
const SHORT: f64 = 1e-15;

/// The search ends after five hardly damped consecutive steps that lower the sum of squares by less
/// than this share. \[-\]
const FLAT: f64 = 1e-11;

/// The weight of the norms of Euler parameters. If not everything can be satisfied, bodies should
/// stay rigid. \[-\]
const RIGID: f64 = 10.0;

/// Minimises Σ (w_i (C_i + shift_i) / norm_i)² + Σ (h (q_p − v_p) / s_p)². The unknowns are y_j =
/// dq_j / s_j, and y_n = dt / s_t if time is free too.
///
/// Each step solves \[I, J; Jᵀ, −λ I\] (r, y) = (−c, 0). This is (Jᵀ J + λ I) y = −Jᵀ c without
/// squaring J. Of all equally good steps it is the shortest.
pub(crate) struct LevenbergMarquardt<'a> {
    model: Model<'a>,
    measures: &'a Measures,
    /// The weight w_i of each row; a row of weight 0 is left out.
    pub weights: Vec<f64>,
    /// For each row a number that is added to C_i; initially zero. \[unit of the row\]
    pub shifts: Vec<f64>,
    /// The coordinates with a soft target, as (column, value, h).
    pub holds: Vec<(usize, f64, f64)>,
    time_is_free: bool,
    least_squares: LeastSquares,
    damping: f64,
}

/// A state of the search.
#[derive(Clone, Debug)]
pub(crate) struct Iterate {
    pub q: Vec<f64>,
    pub t: f64,
    /// The sum of squares.
    pub merit: f64,
    /// The number of steps so far.
    pub steps: usize,
    /// C and C_q.
    pub point: Point,
}

impl<'a> LevenbergMarquardt<'a> {
    pub(crate) fn new(
        model: Model<'a>,
        measures: &'a Measures,
        holds: Vec<(usize, f64, f64)>,
        time_is_free: bool,
    ) -> Self {
        let n = model.n() + usize::from(time_is_free);
        let m = model.m();
        let mut places: Vec<Option<(usize, usize)>> = model.equations.entries.clone();
        places.extend(holds.iter().enumerate().map(|(k, hold)| Some((m + k, hold.0))));
        places.extend((0..if time_is_free { m } else { 0 }).map(|row| Some((row, n - 1))));
        let least_squares = LeastSquares::new(m + holds.len(), n, &places);
        let weights = (0..m).map(|row| if model.is_norm(row) { RIGID } else { 1.0 }).collect();
        LevenbergMarquardt {
            model,
            measures,
            weights,
            shifts: vec![0.0; m],
            holds,
            time_is_free,
            least_squares,
            damping: START,
        }
    }

    /// Returns the state at (q, t), or `None` if C or C_q is not finite.
    pub(crate) fn place(&self, q: &[f64], t: f64) -> Option<Iterate> {
        let point = self.model.linearize(q, t).ok()?;
        let rows = (0..self.weights.len())
            .map(|row| (self.weight(row) * (point.c[row] + self.shifts[row])).powi(2));
        let held = self.holds.iter().map(|&hold| self.offset(q, hold).powi(2));
        let merit = rows.chain(held).sum::<f64>();
        merit.is_finite().then(|| Iterate { q: q.to_vec(), t, merit, steps: 0, point })
    }

    /// Returns w_i / norm_i.
    fn weight(&self, row: usize) -> f64 {
        self.weights[row] / self.measures.norms[row]
    }

    /// Returns h (q_p − v_p) / s_p.
    fn offset(&self, q: &[f64], (column, value, hold): (usize, f64, f64)) -> f64 {
        hold * (q[column] - value) / self.measures.sizes[column]
    }

    /// Lowers the sum of squares as far as possible.
    pub(crate) fn minimise(&mut self, from: Iterate, steps: usize) -> Iterate {
        let mut here = from;
        self.damping = START;
        let begun = here.steps;
        let mut idle = 0;
        let mut flat = 0;
        while here.steps - begun < steps
            && here.merit > ZERO
            && DAMPING.contains(&self.damping)
            && idle < IDLE
            && self.model.may_search()
        {
            let Some((next, length)) = self.step(&here) else {
                self.damping *= 4.0;
                idle += 1;
                continue;
            };
            if next.merit < here.merit {
                let falls = next.merit < 0.9 * here.merit;
                flat = if next.merit < (1.0 - FLAT) * here.merit || self.damping > 1e-8 {
                    0
                } else {
                    flat + 1
                };
                here = next;
                // Near a solution the damping falls with C itself, so that convergence is
                // quadratic.
                self.damping = (0.2 * self.damping)
                    .min(if falls { here.merit.max(1e-9) } else { f64::INFINITY })
                    .max(*DAMPING.start());
                idle = 0;
            } else {
                self.damping *= 4.0;
                idle += 1;
            }
            if length < SHORT || flat == 5 {
                break;
            }
        }
        here
    }

    /// Makes one damped step and returns its largest component. Returns `None` if there is no step,
    /// or if the step rotates a body too far.
    fn step(&mut self, here: &Iterate) -> Option<(Iterate, f64)> {
        let (jacobian, rhs) = self.rows(here);
        if !self.least_squares.factor(jacobian.iter().copied(), self.damping) {
            return None;
        }
        let y = self.least_squares.solve(rhs.into_iter());
        let last = y.last().copied().unwrap_or(0.0);
        let mut q = here.q.clone();
        let mut length = 0.0_f64;
        for (column, ((q, y), size)) in q.iter_mut().zip(y).zip(&self.measures.sizes).enumerate() {
            *q += y * size;
            if !y.is_finite() || (self.model.turns(column) && y.abs() > TURN) {
                return None;
            }
            length = length.max(y.abs());
        }
        let dt = if self.time_is_free { last } else { 0.0 };
        let next = self.place(&q, here.t + dt * self.measures.time)?;
        Some((Iterate { steps: here.steps + 1, ..next }, length.max(dt.abs())))
    }

    /// Returns the values of the scaled matrix in the order of its entries, and −c.
    fn rows(&self, here: &Iterate) -> (Vec<f64>, Vec<f64>) {
        let m = self.weights.len();
        let entries = self.model.equations.entries.iter().zip(&here.point.values);
        let scaled = |(entry, value): (&Option<(usize, usize)>, &f64)| match *entry {
            Some((row, column)) if self.weights[row] != 0.0 => {
                self.weight(row) * value * self.measures.sizes[column]
            }
            _ => 0.0,
        };
        let mut jacobian: Vec<f64> = entries.map(scaled).collect();
        jacobian.extend(self.holds.iter().map(|hold| hold.2));
        if self.time_is_free {
            let c_t = self.model.c_t(&here.q, here.t).unwrap_or_else(|_| vec![0.0; m]);
            jacobian.extend((0..m).map(|row| self.weight(row) * c_t[row] * self.measures.time));
        }
        let rows = (0..m).map(|row| -self.weight(row) * (here.point.c[row] + self.shifts[row]));
        let held = self.holds.iter().map(|&hold| -self.offset(&here.q, hold));
        (jacobian, rows.chain(held).collect())
    }
}
