//! Finds another value of a dimension with which a mechanism closes and moves.

use super::dimension::{Dimension, Of};
use super::trial::{Trial, drivers};
use crate::coordinates::units::Unit;
use crate::linear::LeastSquares;
use crate::solve::assembly::search::Found;
use crate::system::evaluate::Equations;
use crate::system::scaled::{Measures, Model, Point};

/// A value of a dimension with which everything closes and the drivers have something to drive.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fitted {
    pub value: Vec<f64>,
    /// True if only this value works, false if the values beyond it work too.
    pub exact: bool,
    /// The distance from the present value: |ln| of the factor between both. \[-\]
    pub change: f64,
}

/// The reported bound has this margin, because at the bound itself the mechanism is in a toggle.
/// \[-\]
const SPARE: f64 = 0.05;

/// The relative accuracy of a bound, and the largest number of bisections towards it.
const CLOSE: f64 = 2e-4;
const HALVINGS: usize = 18;

/// The largest number of steps to a pose near a known one.
const NEAR: usize = 60;

/// Returns the nearest other value of the dimension that works, if there is one.
pub(crate) fn fit(
    model: &Model<'_>,
    dimension: &Dimension,
    near: &Found,
    t: f64,
    without: &[usize],
    steps: usize,
) -> Option<Fitted> {
    let equations = model.equations.clone();
    let scale = scale(dimension, &near.measures, model);
    let mut fit = Fit { model: *model, equations, dimension, t, without, steps, scale };
    let (value, q) = fit.solved(near)?;
    if let [_] = dimension.value[..] {
        return fit.bounded(value, &q);
    }
    let beyond: Vec<f64> =
        dimension.value.iter().zip(&value).map(|(is, to)| is + (1.0 + SPARE) * (to - is)).collect();
    [(beyond, false), (value, true)]
        .into_iter()
        .find(|(value, _)| fit.works(value, &q))
        .map(|(value, exact)| fit.fitted(value, exact))
}

struct Fit<'a> {
    model: Model<'a>,
    /// A copy of the equations in which the dimension changes.
    equations: Equations,
    dimension: &'a Dimension,
    t: f64,
    without: &'a [usize],
    steps: usize,
    /// The change of the dimension that counts as order 1.
    scale: f64,
}

fn scale(dimension: &Dimension, measures: &Measures, model: &Model<'_>) -> f64 {
    let length = model
        .layout
        .units
        .iter()
        .position(|unit| *unit == Unit::Metre)
        .map_or(1.0, |k| measures.sizes[k]);
    dimension.value.iter().fold(length, |m, x| m.max(x.abs()))
}

impl Fit<'_> {
    /// Calls `ask` with another value of the dimension.
    fn with<T>(&mut self, value: &[f64], ask: impl FnOnce(Model<'_>) -> Option<T>) -> Option<T> {
        if !self.dimension.put(&mut self.equations, value) {
            return None;
        }
        ask(Model { equations: &self.equations, ..self.model })
    }

    /// Returns the pose with another value of the dimension, starting from a pose nearby or from
    /// beside it.
    fn closed(&mut self, value: &[f64], from: &[f64]) -> Option<Found> {
        let t = self.t;
        let without = self.without;
        let steps = self.steps.min(NEAR);
        self.with(value, |model| Trial { model, t, without, steps }.closed_beside(from))
    }

    /// Returns true if the mechanism with this value closes near a pose and moves as it should.
    fn works(&mut self, value: &[f64], from: &[f64]) -> bool {
        let Some(found) = self.closed(value, from) else { return false };
        let t = self.t;
        let without = self.without;
        let steps = self.steps;
        self.with(value, |model| {
            let trial = Trial { model, t, without, steps };
            (trial.moves(&found, &drivers(&model, without)) && trial.goes_on(&found)).then_some(())
        })
        .is_some()
    }

    /// Returns the value for the report: the end of the interval of values that close, as close as
    /// possible to the present value.
    fn bounded(&mut self, value: Vec<f64>, q: &[f64]) -> Option<Fitted> {
        let is = self.dimension.value[0];
        let to = value[0];
        if to <= 0.0 && matches!(self.dimension.of, Of::Length(_) | Of::Point(..)) {
            return None;
        }
        let beyond = |x: f64| x + SPARE * (x - is).abs().min(x.abs()).copysign(x - is);
        let Some(found) = self.closed(&[beyond(to)], q) else {
            return self.works(&value, q).then(|| self.fitted(value, true));
        };
        let mut open = is;
        let mut closed = beyond(to);
        let mut pose = found.place.q;
        for _ in 0..HALVINGS {
            let middle = if open * closed > 0.0 {
                (open * closed).sqrt().copysign(open)
            } else {
                0.5 * (open + closed)
            };
            if (closed - open).abs() < CLOSE * closed.abs() {
                break;
            }
            match self.closed(&[middle], &pose) {
                Some(found) => (closed, pose) = (middle, found.place.q),
                None => open = middle,
            }
        }
        let spared = beyond(closed);
        let value = if matches!(self.dimension.of, Of::Point(..)) { spared } else { closed };
        self.works(&[spared], &pose).then(|| self.fitted(vec![value], false))
    }

    fn fitted(&self, value: Vec<f64>, exact: bool) -> Fitted {
        Fitted { change: self.proportion(&value), value, exact }
    }

    /// Returns |ln| of the factor between the two values. If the sign changes or one value is zero,
    /// the result is larger than for any probable factor.
    fn proportion(&self, value: &[f64]) -> f64 {
        const FAR: f64 = 3.0;
        match (&self.dimension.value[..], value) {
            ([is], [to]) if is * to > 0.0 => (to / is).ln().abs(),
            (is, to) => {
                let moved = is.iter().zip(to).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                moved / self.scale + if is.len() == 1 { FAR } else { 0.0 }
            }
        }
    }

    /// Solves C = 0 by coordinates and dimension together (Levenberg–Marquardt), from a pose
    /// nearby.
    fn solved(&mut self, near: &Found) -> Option<(Vec<f64>, Vec<f64>)> {
        /// The damping at the start and its minimum, for rows and columns of order 1. \[-\]
        const DAMPING: [f64; 2] = [1e-2, 1e-12];
        const MET: f64 = 1e-12;
        let n = self.model.n();
        let m = self.model.m();
        let d = self.dimension.value.len();
        let places: Vec<Option<(usize, usize)>> = self
            .model
            .equations
            .entries
            .iter()
            .copied()
            .chain((0..d).flat_map(|k| (0..m).map(move |row| Some((row, n + k)))))
            .collect();
        let mut solver = LeastSquares::new(m, n + d, &places);
        let mut q = near.place.q.clone();
        let mut value = self.dimension.value.clone();
        let mut damping = DAMPING[0];
        let (mut point, mut slopes) = self.linearized(&q, &value)?;
        let mut merit = self.merit(&point, &near.measures);
        for _ in 0..self.steps {
            if merit < MET * MET {
                return Some((value, q));
            }
            let y = self.step(&mut solver, (&point, &slopes), &near.measures, damping);
            let next = y.and_then(|y| {
                let moved: Vec<f64> = q
                    .iter()
                    .zip(&y)
                    .zip(&near.measures.sizes)
                    .map(|((q, y), size)| q + y * size)
                    .collect();
                let changed: Vec<f64> =
                    value.iter().zip(&y[n..]).map(|(value, y)| value + y * self.scale).collect();
                let (point, slopes) = self.linearized(&moved, &changed)?;
                Some((self.merit(&point, &near.measures), moved, changed, point, slopes))
            });
            match next {
                Some((lower, moved, changed, at, along)) if lower < merit => {
                    (merit, q, value, point, slopes) = (lower, moved, changed, at, along);
                    damping = (0.1 * damping).max(DAMPING[1]);
                }
                _ if damping > 1e8 || merit < 1e-20 => break,
                _ => damping *= 8.0,
            }
        }
        (merit < 1e-20).then_some((value, q))
    }

    /// Returns C, C_q and the slopes of C by the dimension, all rows of one component after those
    /// of the other.
    fn linearized(&mut self, q: &[f64], value: &[f64]) -> Option<(Point, Vec<f64>)> {
        /// The step of central differences. Parameters usually enter in the first or second power.
        /// \[-\]
        const STEP: f64 = 1e-5;
        let t = self.t;
        let point = self.with(value, |model| model.linearize(q, t).ok())?;
        let mut slopes = Vec::new();
        for k in 0..value.len() {
            let h = STEP * self.scale;
            let mut at = |sign: f64| {
                let mut moved = value.to_vec();
                moved[k] += sign * h;
                self.with(&moved, |model| model.linearize(q, t).ok()).map(|point| point.c)
            };
            let after = at(1.0)?;
            let before = at(-1.0)?;
            slopes.extend(after.iter().zip(before).map(|(a, b)| (a - b) / (2.0 * h)));
        }
        Some((point, slopes))
    }

    fn merit(&self, point: &Point, measures: &Measures) -> f64 {
        let rows = point
            .c
            .iter()
            .zip(&measures.norms)
            .enumerate()
            .filter(|(row, _)| !self.without.contains(row));
        rows.map(|(_, (c, norm))| (c / norm).powi(2)).sum()
    }

    fn step(
        &self,
        solver: &mut LeastSquares,
        (point, slopes): (&Point, &[f64]),
        measures: &Measures,
        damping: f64,
    ) -> Option<Vec<f64>> {
        let Measures { sizes, norms, .. } = measures;
        let m = norms.len();
        let weight =
            |row: usize| if self.without.contains(&row) { 0.0 } else { norms[row].recip() };
        let entries = self.model.equations.entries.iter().zip(&point.values);
        let mut values: Vec<f64> = entries
            .map(|(entry, value)| {
                entry.map_or(0.0, |(row, column)| weight(row) * value * sizes[column])
            })
            .collect();
        values
            .extend(slopes.iter().enumerate().map(|(k, slope)| weight(k % m) * slope * self.scale));
        if !solver.factor(values.iter().copied(), damping) {
            return None;
        }
        let y = solver.solve(point.c.iter().enumerate().map(|(row, c)| -weight(row) * c)).to_vec();
        y.iter().all(|y| y.is_finite()).then_some(y)
    }
}
