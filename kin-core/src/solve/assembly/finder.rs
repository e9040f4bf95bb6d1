//! Makes Newton's steps for one group of equations, with all other coordinates constant.

use super::groups::Group;
use super::known::Known;
use crate::coordinates::units::Unit;
use crate::linear::{Dense, LeastSquares, Linear};
use crate::system::evaluate::Instant;
use crate::system::scaled::{Measures, Model};

/// The largest rotation of a body in one step, and the largest displacement in extents of the
/// group. \[-\]
const STEP: f64 = 0.5;

/// The residual of a satisfied row, as a share of its norm. \[-\]
const NEAR: f64 = 1e-8;

/// The largest number of equations that are solved as a dense matrix.
const SMALL: usize = 32;

/// The present pose, with workspace buffers.
pub(super) struct Finder<'a> {
    model: Model<'a>,
    measures: &'a Measures,
    group: &'a Group,
    solver: Solver,
    instant: Instant,
    c: Vec<f64>,
    values: Vec<f64>,
    /// The present step, in units of the sizes of the group's coordinates.
    y: Vec<f64>,
    /// The largest distance of poses from one another, from [`Finder::measure`]. \[m\]
    pub extent: f64,
    /// The present pose, all coordinates.
    pub q: Vec<f64>,
}

impl<'a> Finder<'a> {
    pub(super) fn new(model: Model<'a>, measures: &'a Measures, group: &'a Group, t: f64) -> Self {
        let mut values = vec![0.0; model.equations.entries.len()];
        model.equations.set_constants(&mut values);
        let q = vec![0.0; model.n()];
        Finder {
            solver: Solver::new(group, measures),
            instant: model.equations.instant_at(t, &q),
            c: vec![0.0; model.m()],
            y: vec![0.0; group.columns.len()],
            model,
            measures,
            group,
            values,
            extent: 1.0,
            q,
        }
    }

    /// Sets a known extent.
    pub(super) fn within(self, extent: f64) -> Self {
        Finder { extent, ..self }
    }

    /// Computes the extent of the group at a pose: the lengths over which its equations bend or
    /// rotate, and by which they are off. It does not depend on the origin.
    pub(super) fn measure(&mut self, at: &[f64]) {
        /// The largest extent, in typical lengths. \[-\]
        const MOST: f64 = 100.0;
        let units = &self.model.layout.units;
        let sizes = &self.measures.sizes;
        let lengths = || self.group.columns.iter().filter(|column| units[**column] == Unit::Metre);
        let size = lengths().map(|column| sizes[*column]).fold(0.0, f64::max);
        self.extent = if size > 0.0 { size } else { 1.0 };
        self.q.copy_from_slice(at);
        if size == 0.0 || !self.look() {
            return;
        }
        let before = self.values.clone();
        lengths().for_each(|column| self.q[*column] = at[*column] + size);
        let mut rows =
            vec![Bend { off: 0.0, per_length: 0.0, per_angle: 0.0, change: 0.0 }; self.c.len()];
        self.group.rows.iter().for_each(|row| rows[*row].off = self.c[*row].abs());
        if !self.look() {
            return;
        }
        for &(place, row, column) in &self.group.entries {
            let bend = &mut rows[self.group.rows[row]];
            let value = before[place].abs();
            match units[self.group.columns[column]] {
                Unit::Metre => {
                    bend.per_length = bend.per_length.max(value);
                    bend.change =
                        bend.change.max((self.values[place] - before[place]).abs() / size);
                }
                Unit::Radian => bend.per_angle = bend.per_angle.max(value),
                Unit::One => {}
            }
        }
        self.turns(at, &before, &mut rows);
        let all = rows.iter().map(|bend| bend.length(size));
        let extent = all.fold(0.0, f64::max).min(MOST * size);
        self.extent = if extent > 0.0 { extent } else { size };
    }

    /// Runs Newton's method from a start until the group is nearly satisfied. Returns false if the
    /// steps lead nowhere. Earlier results have no influence, except that the poses of `away` push
    /// steps away.
    pub(super) fn newton(&mut self, from: &[f64], steps: usize, away: Option<&Known<'_>>) -> bool {
        self.q.copy_from_slice(from);
        self.solver.forget();
        for _ in 0..steps {
            self.normalize();
            if !self.look() {
                return false;
            }
            if self.is_near() {
                return true;
            }
            if !self.solve() {
                return false;
            }
            let push = away.map_or(1.0, |known| 1.0 / (1.0 - self.repulsion(known)));
            let factor = push * (STEP / self.length(push)).min(1.0);
            if !factor.is_finite() {
                return false;
            }
            self.correct(factor);
        }
        false
    }

    /// Continues Newton's method from a nearly satisfied pose as long as its steps shrink.
    pub(super) fn refine(&mut self, from: &[f64]) {
        /// Towards a singular pose each step is half of the one before, so this number of steps
        /// reaches rounding.
        const STEPS: usize = 60;
        self.q.copy_from_slice(from);
        self.solver.forget();
        let mut last = STEP;
        for _ in 0..STEPS {
            if !self.look() || !self.solve() {
                return;
            }
            let length = self.length(1.0);
            // A NaN does not shrink either.
            if length.partial_cmp(&last) != Some(std::cmp::Ordering::Less) {
                return;
            }
            self.correct(1.0);
            last = length;
        }
    }

    /// Appends the derivatives by rotations of spatial bodies: half of those by Euler parameters,
    /// without the part along p, which does not rotate anything.
    fn turns(&self, at: &[f64], values: &[f64], rows: &mut [Bend]) {
        let mut slopes: std::collections::BTreeMap<(usize, usize), [f64; 4]> = Default::default();
        for &(place, row, column) in &self.group.entries {
            let column = self.group.columns[column];
            if let Some(&first) =
                self.group.turns.iter().find(|first| (**first..**first + 4).contains(&column))
            {
                slopes.entry((self.group.rows[row], first)).or_default()[column - first] +=
                    values[place];
            }
        }
        for ((row, first), slope) in slopes {
            let p = &at[first..first + 4];
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let along = dot(&slope, p) / dot(p, p).max(f64::MIN_POSITIVE);
            let across: f64 =
                slope.iter().zip(p).map(|(slope, p)| (slope - along * p).powi(2)).sum();
            rows[row].per_angle = rows[row].per_angle.max(0.5 * across.sqrt());
        }
    }

    /// Computes the only solution of an affine group. Returns false if the group is singular.
    pub(super) fn affine(&mut self, from: &[f64]) -> bool {
        /// The second step removes the rounding of the first one.
        const STEPS: usize = 2;
        self.q.copy_from_slice(from);
        self.solver.forget();
        for _ in 0..STEPS {
            if !self.look() || !self.solve() {
                return false;
            }
            self.correct(1.0);
        }
        true
    }

    /// Returns the constraints that can close with an axis turned by 180°, and whose bodies are
    /// known after this group.
    pub(super) fn branches(&self) -> &'a [usize] {
        &self.group.branches
    }

    /// Normalises the Euler parameters.
    fn normalize(&mut self) {
        for &first in &self.group.turns {
            let p = &mut self.q[first..first + 4];
            let norm = p.iter().map(|e| e * e).sum::<f64>().sqrt();
            if norm > 0.0 && norm.is_finite() {
                p.iter_mut().for_each(|e| *e /= norm);
            }
        }
    }

    /// Evaluates C and C_q of the group at the present pose. Returns false if they are not finite.
    fn look(&mut self) -> bool {
        let equations = self.model.equations;
        equations.set_position(&self.q, &mut self.instant);
        for block in self.group.constraints.iter().map(|&k| &equations.blocks[k]) {
            let at = equations.at(block, &self.instant);
            block.constraint.linearize(
                &at,
                &mut self.c[block.rows()],
                &mut self.values[block.values()],
            );
        }
        let Group { rows, entries, .. } = self.group;
        rows.iter().all(|row| self.c[*row].is_finite())
            && entries.iter().all(|(place, _, _)| self.values[*place].is_finite())
    }

    fn is_near(&self) -> bool {
        self.group.rows.iter().all(|row| self.c[*row].abs() <= NEAR * self.measures.norms[*row])
    }

    /// Solves C_q dq = −C with y_j = dq_j / s_j. Returns false if C_q is singular.
    fn solve(&mut self) -> bool {
        self.solver.solve(self.group, self.measures, [&self.values, &self.c], &mut self.y)
    }

    /// Returns the largest component of the present step: lengths relative to the extent, others
    /// relative to 1.
    fn length(&self, push: f64) -> f64 {
        let share = |(column, y): (&usize, &f64)| {
            let is_length = self.model.layout.units[*column] == Unit::Metre;
            let unit = if is_length { self.measures.sizes[*column] / self.extent } else { 1.0 };
            (push * unit * y).abs()
        };
        // A NaN counts too.
        self.group
            .columns
            .iter()
            .zip(&self.y)
            .map(share)
            .fold(0.0, |m, y| if y <= m { m } else { y })
    }

    fn correct(&mut self, factor: f64) {
        for (&column, y) in self.group.columns.iter().zip(&self.y) {
            self.q[column] += factor * y * self.measures.sizes[column];
        }
    }

    /// Returns ∇ln M · Δ for the present step.
    fn repulsion(&self, known: &Known<'_>) -> f64 {
        let mut step = vec![0.0; self.q.len()];
        self.group.columns.iter().zip(&self.y).for_each(|(column, y)| step[*column] = *y);
        known.repulsion(&self.q, step)
    }
}

/// How an equation changes with lengths and angles.
#[derive(Clone)]
struct Bend {
    /// The residual |C|.
    off: f64,
    /// The largest derivatives by lengths and by angles.
    per_length: f64,
    per_angle: f64,
    /// The change of the derivatives by lengths, per length.
    change: f64,
}

impl Bend {
    /// Returns the largest of the lever, the length over which the slope changes, and the length
    /// over which the equation can be satisfied.
    fn length(&self, size: f64) -> f64 {
        /// A row whose slopes change by less than this over a typical length is straight. \[-\]
        const STRAIGHT: f64 = 1e-6;
        if self.per_length == 0.0 {
            return 0.0;
        }
        let lever = self.per_angle / self.per_length;
        let others = if self.change * size > STRAIGHT * self.per_length {
            (self.per_length / self.change).max((2.0 * self.off / self.change).sqrt())
        } else {
            self.off / self.per_length
        };
        lever.max(others)
    }
}

/// Solvers of Newton's steps: a dense matrix for a few equations, the recorded elimination for
/// many, least squares if there are more equations than coordinates.
enum Solver {
    Small(Dense),
    Square(Linear),
    LeastSquares(LeastSquares),
}

impl Solver {
    fn new(group: &Group, measures: &Measures) -> Self {
        let m = group.rows.len();
        let n = group.columns.len();
        if group.is_square() && n <= SMALL {
            return Solver::Small(Dense::new(n));
        }
        let places: Vec<_> =
            group.entries.iter().map(|&(_, row, column)| Some((row, column))).collect();
        if !group.is_square() {
            return Solver::LeastSquares(LeastSquares::new(m, n, &places));
        }
        let mut linear = Linear::new(n, places, &[]);
        let sizes: Vec<f64> = group.columns.iter().map(|column| measures.sizes[*column]).collect();
        linear.set_sizes(&sizes);
        Solver::Square(linear)
    }

    fn forget(&mut self) {
        match self {
            Solver::Square(linear) => linear.forget(),
            // These solvers normalise before each factoring.
            Solver::Small(_) | Solver::LeastSquares(_) => {}
        }
    }

    /// Solves C_q dq = −C with y_j = dq_j / s_j. Returns false if C_q is singular.
    fn solve(
        &mut self,
        group: &Group,
        measures: &Measures,
        [values, c]: [&[f64]; 2],
        y: &mut [f64],
    ) -> bool {
        /// Damping, because matrices can be singular during the search. \[-\]
        const DAMPING: f64 = 1e-9;
        let Measures { sizes, norms, .. } = measures;
        let rhs = group.rows.iter().map(|row| -c[*row] / norms[*row]);
        let scaled = group.entries.iter().map(|&(place, row, column)| {
            let value = values[place] * sizes[group.columns[column]] / norms[group.rows[row]];
            (row, column, value)
        });
        match self {
            Solver::Small(dense) => {
                dense.set(scaled, rhs);
                let Some(found) = dense.solve() else { return false };
                y.copy_from_slice(found);
            }
            Solver::Square(linear) => {
                let places = linear.values_mut().iter_mut().zip(&group.entries);
                places.for_each(|(own, (place, _, _))| *own = values[*place]);
                if !linear.measure() || !linear.factor() {
                    return false;
                }
                linear.rhs_mut().iter_mut().zip(&group.rows).for_each(|(rhs, row)| *rhs = -c[*row]);
                linear.solve();
                let found = linear.solution().iter().zip(&group.columns);
                y.iter_mut().zip(found).for_each(|(y, (dq, column))| *y = dq / sizes[*column]);
            }
            Solver::LeastSquares(least_squares) => {
                if !least_squares.factor(scaled.map(|(_, _, value)| value), DAMPING) {
                    return false;
                }
                y.copy_from_slice(least_squares.solve(rhs));
            }
        }
        true
    }
}
