//! All assemblies of a mechanism at one time.
//!
//! Newton's steps from many starts. Where they lead to a known assembly, the same start once more with the
//! known ones deflated: their neighbourhoods push steps away (P. E. Farrell, Á. Birkisson, S. W. Funke,
//! Deflation techniques for finding distinct solutions of nonlinear partial differential equations, SIAM J.
//! Sci. Comput. 37, 2015). With M = Π (1 + ρ²/d_k²) the step of M C = 0 is Newton's step times 1 / (1 − ∇ln M
//! · Δq).

use std::time::Duration;

use super::label::{Label, canonical, labelled};
use super::levenberg_marquardt::{Iterate, LevenbergMarquardt};
use super::options::{Clock, at_least_one};
use super::turn;
use crate::linear::{LeastSquares, Linear};
use crate::model::error::{Error, Result};
use crate::model::layout::Kind;
use crate::model::units::Unit;
use crate::numbers::random::Random;
use crate::system::scaled::{Measures, Model, Point};

/// How assemblies are looked for. All fields have defaults: `AssemblyOptions { seed: 7,
/// ..AssemblyOptions::default() }`.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblyOptions {
    /// Starts at most; default 4000.
    pub starts: usize,
    /// The search ends after this many starts in a row that lead to nothing new, and twenty more for each
    /// assembly that is known; default 100.
    pub patience: usize,
    /// Newton's steps from one start; default 60.
    pub steps: usize,
    /// The same seed gives the same assemblies; default 0.
    pub seed: u64,
    /// Time after which no other start is begun. With a limit the result can depend on the machine; default
    /// none.
    pub time_limit: Option<Duration>,
}

impl Default for AssemblyOptions {
    fn default() -> Self {
        AssemblyOptions { starts: 4000, patience: 100, steps: 60, seed: 0, time_limit: None }
    }
}

/// One assembly of a mechanism.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Assembly {
    /// Its name among all.
    pub label: Label,
    /// The pose, C(q, t) = 0: a guess from which the mechanism is assembled in this way again
    /// ([`crate::System::set_initial`]).   \[m, rad\]
    pub q: Vec<f64>,
}

/// All assemblies that are found, in the order of their labels.
pub(crate) fn all(
    model: Model<'_>,
    guess: &[f64],
    t: f64,
    options: &AssemblyOptions,
) -> Result<Vec<Assembly>> {
    at_least_one(options.starts, "starts")?;
    at_least_one(options.steps, "steps")?;
    let clock = Clock::new(options.time_limit);
    let measures = model.measure(guess, t);
    let mut modes = Modes::new(model, &measures, options);
    let mut random = Random::new(options.seed);
    let mut idle = 0;
    for start in 0..options.starts {
        if idle > options.patience + 20 * modes.found.len() || clock.is_up() {
            break;
        }
        let from = modes.start(guess, start, &mut random);
        let from = turn::turned(&model, &from, t, &|_| true);
        idle += 1;
        if modes.from(&from, t) {
            idle = 0;
            if modes.found.len() > MOST {
                return Err(Error::InvalidOptions {
                    reason: format!("more than {MOST} assemblies: the mechanism is free to move"),
                });
            }
        }
    }
    let found = labelled(&model, &measures, modes.found, t);
    Ok(found.into_iter().map(|(label, q)| Assembly { label, q }).collect())
}

/// More assemblies than this are no assemblies but poses of something that moves.
const MOST: usize = 2000;

/// No step turns a body by more than this, or moves it by more than so many lengths of the model.   \[-\]
const STEP: f64 = 0.25;

/// Two assemblies are one where no coordinate differs by more.   \[-\]
const SAME: f64 = 1e-5;

struct Modes<'a> {
    model: Model<'a>,
    measures: &'a Measures,
    options: &'a AssemblyOptions,
    solver: Solver,
    onto_equations: LevenbergMarquardt<'a>,
    found: Vec<Vec<f64>>,
    /// The same as they are compared.
    canonical: Vec<Vec<f64>>,
}

impl<'a> Modes<'a> {
    fn new(model: Model<'a>, measures: &'a Measures, options: &'a AssemblyOptions) -> Self {
        let solver = Solver::new(&model, measures);
        let onto_equations = LevenbergMarquardt::new(model, measures, Vec::new(), false);
        Modes { model, measures, options, solver, onto_equations, found: Vec::new(), canonical: Vec::new() }
    }

    /// The guess first; then angles and Euler parameters any, lengths around the guess.
    fn start(&self, guess: &[f64], start: usize, random: &mut Random) -> Vec<f64> {
        /// How far, in units of the model's length.
        const REACH: f64 = 0.75;
        let mut q = guess.to_vec();
        if start == 0 {
            return q;
        }
        for ((q, unit), size) in q.iter_mut().zip(&self.model.layout.units).zip(&self.measures.sizes) {
            *q = match unit {
                Unit::Metre => *q + REACH * size * random.number(),
                Unit::Radian => std::f64::consts::PI * random.number(),
                Unit::One => random.number(),
            };
        }
        for item in self.model.layout.items.iter().filter(|item| item.kind == Kind::Spatial) {
            let p = &mut q[item.first + 3..item.first + 7];
            let norm = loop {
                // Within the unit ball all directions are alike.
                let norm = p.iter().map(|e| e * e).sum::<f64>().sqrt();
                if (0.1..1.0).contains(&norm) {
                    break norm;
                }
                p.fill_with(|| random.number());
            };
            p.iter_mut().for_each(|e| *e /= norm);
        }
        q
    }

    /// True if a start leads to an assembly that was not known, at the first try or with the known ones
    /// deflated.
    fn from(&mut self, start: &[f64], t: f64) -> bool {
        match self.newton(start, t, false) {
            Some(q) => self.is_new(&q, t) || self.newton(start, t, true).is_some_and(|q| self.is_new(&q, t)),
            None => false,
        }
    }

    /// Keeps a pose, brought onto C = 0 with all digits, unless it is known.
    fn is_new(&mut self, q: &[f64], t: f64) -> bool {
        let pose = canonical(self.model.layout, self.measures, q);
        if self.canonical.iter().any(|known| self.distance(known, &pose) < SAME) {
            return false;
        }
        let Some(place) = self.onto_equations.place(q, t) else { return false };
        let Iterate { q, point, .. } = self.onto_equations.minimise(place, self.options.steps);
        let pose = canonical(self.model.layout, self.measures, &q);
        let known = self.canonical.iter().any(|known| self.distance(known, &pose) < SAME);
        if known || !self.model.met(&point, &q, self.measures, &|_| true) {
            return false;
        }
        self.found.push(q);
        self.canonical.push(pose);
        true
    }

    /// Newton's steps until C is nearly met; `None` where they lead nowhere.
    fn newton(&mut self, start: &[f64], t: f64, deflated: bool) -> Option<Vec<f64>> {
        /// Rows are met to this share of their norms.   \[-\]
        const NEAR: f64 = 1e-8;
        /// Deflated steps are worth this many.
        const DEFLATED: usize = 20;
        let steps = if deflated { DEFLATED.min(self.options.steps) } else { self.options.steps };
        let mut q = start.to_vec();
        for _ in 0..steps {
            let point = self.model.linearize(&q, t).ok()?;
            if point.c.iter().zip(&self.measures.norms).all(|(c, norm)| c.abs() <= NEAR * norm) {
                return Some(q);
            }
            let y = self.solver.step(&self.model, &point, self.measures)?;
            let push = if deflated { 1.0 / (1.0 - self.repulsion(&q, &y)) } else { 1.0 };
            let largest = y.iter().fold(0.0_f64, |m, y| m.max((push * y).abs()));
            let factor = push * (STEP / largest).min(1.0);
            if !factor.is_finite() {
                return None;
            }
            q.iter_mut().zip(&y).zip(&self.measures.sizes).for_each(|((q, y), size)| *q += factor * y * size);
        }
        None
    }

    /// ∇ln M · Δ for a step of shares y.
    fn repulsion(&self, q: &[f64], y: &[f64]) -> f64 {
        /// ρ², how far it reaches.   \[-\]
        const RANGE: f64 = 0.05;
        let pose = canonical(self.model.layout, self.measures, q);
        // Where the canonical pose has the other signs of Euler parameters, the step has them too.
        let mut step = y.to_vec();
        for item in self.model.layout.items.iter().filter(|item| item.kind == Kind::Spatial) {
            let own = item.first + 3..item.first + 7;
            if q[own.clone()].iter().zip(&pose[own.clone()]).any(|(q, pose)| q * pose < 0.0) {
                step[own].iter_mut().for_each(|y| *y = -*y);
            }
        }
        let gradient = |known: &Vec<f64>| {
            let (_, difference, square) = self.difference(known, &pose);
            let along: f64 = difference.iter().zip(&step).map(|(d, y)| d * y).sum();
            // ∂ ln(1 + ρ²/d²) = −2 d·∂d / (d² (d²/ρ² + 1))
            -2.0 * along / (square * (square / RANGE + 1.0)).max(f64::MIN_POSITIVE)
        };
        self.canonical.iter().map(gradient).sum()
    }

    /// The largest difference of two canonical poses.
    fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        self.difference(a, b).0
    }

    /// b − a, angles by the shorter way, Euler parameters by the nearer of the two signs: the largest, all,
    /// and the sum of squares.
    fn difference(&self, a: &[f64], b: &[f64]) -> (f64, Vec<f64>, f64) {
        let mut d: Vec<f64> = a.iter().zip(b).map(|(a, b)| b - a).collect();
        for (d, _) in d.iter_mut().zip(&self.model.layout.units).filter(|(_, unit)| **unit == Unit::Radian) {
            *d -= std::f64::consts::TAU * (*d / std::f64::consts::TAU).round();
        }
        for item in self.model.layout.items.iter().filter(|item| item.kind == Kind::Spatial) {
            let own = item.first + 3..item.first + 7;
            if a[own.clone()].iter().zip(&b[own.clone()]).map(|(a, b)| a * b).sum::<f64>() < 0.0 {
                own.for_each(|k| d[k] = b[k] + a[k]);
            }
        }
        let largest = d.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
        let square = d.iter().map(|d| d * d).sum();
        (largest, d, square)
    }
}

/// Newton's steps in shares: for as many equations as coordinates by the recorded elimination, for more by
/// least squares.
enum Solver {
    Square(Linear),
    LeastSquares(LeastSquares),
}

impl Solver {
    fn new(model: &Model<'_>, measures: &Measures) -> Self {
        if model.m() != model.n() {
            return Solver::LeastSquares(LeastSquares::new(model.m(), model.n(), &model.equations.entries));
        }
        let mut linear =
            Linear::new(model.n(), model.equations.entries.iter().copied(), &model.equations.constants);
        linear.set_sizes(&measures.sizes);
        Solver::Square(linear)
    }

    /// y_j = dq_j / s_j with C_q dq = −C; `None` where C_q is singular.
    fn step(&mut self, model: &Model<'_>, point: &Point, measures: &Measures) -> Option<Vec<f64>> {
        /// Against matrices that are singular on the way.   \[-\]
        const DAMPING: f64 = 1e-9;
        let Measures { sizes, norms, .. } = measures;
        match self {
            Solver::Square(linear) => {
                linear.values_mut().copy_from_slice(&point.values);
                linear.measure();
                if !linear.factor() {
                    return None;
                }
                linear.rhs_mut().iter_mut().zip(&point.c).for_each(|(rhs, c)| *rhs = -c);
                linear.solve();
                Some(linear.solution().iter().zip(sizes).map(|(dq, size)| dq / size).collect())
            }
            Solver::LeastSquares(least_squares) => {
                let entries = model.equations.entries.iter().zip(&point.values);
                let values = entries.map(|(entry, value)| {
                    entry.map_or(0.0, |(row, column)| value * sizes[column] / norms[row])
                });
                if !least_squares.factor(values, DAMPING) {
                    return None;
                }
                Some(least_squares.solve(point.c.iter().zip(norms).map(|(c, norm)| -c / norm)).to_vec())
            }
        }
    }
}
