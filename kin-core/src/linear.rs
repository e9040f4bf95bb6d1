//! Implements the linear solver for a square matrix of fixed pattern.
//!
//! Callers write values and a right side, and read the solution. No other module of Kin eliminates
//! sparse matrices.
//!
//! Kin records the elimination once at real numbers and then replays it as flat code ([`code`]) on
//! one memory. The memory contains values, right side and solution, so constraints write directly
//! into the memory.
//!
//! Kin scales a pivot by the largest entries that its row and its column have had so far, with
//! lengths in units of the model's length. So the verdict "singular" does not depend on units (mm,
//! m or km), and Kin detects a row that becomes small towards a toggle. The scales only select and
//! judge pivots and do not change the numbers.
//!
//! Kin checks each replay. If pivots become small or multipliers grow, Kin records the elimination
//! again at the present numbers.

mod condition;
mod dense;
mod echelon;
mod independent;
mod least_squares;
mod measures;
mod recorded;
#[cfg(test)]
mod tests;

pub(crate) use dense::Dense;
pub(crate) use echelon::{Echelon, RANK, Sparse, dense, reduced};
pub(crate) use independent::Independent;

use std::sync::Arc;

use crate::numbers::padded::{self, Padded, Quad};
pub(crate) use least_squares::LeastSquares;
use recorded::record::{Factored, Input, Places, Recording};

/// A scaled pivot below this value is zero; rounding of an elimination of moderate size stays
/// below. \[-\]
const SINGULAR: f64 = 1e-13;

/// A matrix with a scaled condition number above this value counts as singular. \[-\]
const CONDITION: f64 = 3e12;

/// The largest multiplier of a replay. A new recording keeps multipliers below 10. \[-\]
const GROWTH: f64 = 30.0;

/// If entries of the elimination grow beyond this factor, solutions are refined. No mechanism has
/// needed it so far. \[-\]
const REFINED: f64 = 100.0;

/// The smallest pivot may fade to this share of its largest value since the recording. \[-\]
const FADED: f64 = 0.01;

/// If a value grows by this factor, rows and columns are scaled again. \[-\]
const SLACK: f64 = 1.25;

/// A pivot below this value may be judged only by a recording that has seen a pivot of this size.
/// \[-\]
const SUSPICIOUS: f64 = 1e-6;

/// A square matrix of fixed pattern, its recorded elimination, and the memory of both.
#[derive(Clone)]
pub(crate) struct Linear {
    /// The number of rows and columns.
    n: usize,
    /// The row and column of each value; `None` for values of the ground, which belong to no entry.
    entries: Arc<[Option<(u32, u32)>]>,
    /// The indices of the values, sorted by rows, then by columns.
    sorted: Arc<[u32]>,
    /// For each value its number if it is constant, otherwise `None`.
    constants: Arc<[Option<f64>]>,
    /// The values, the right side, the solution, then the numbers that the programs compute.
    memory: Vec<f64>,
    /// The places of right side, solution and constants in the memory.
    places: Places,
    /// s_j, the characteristic size of unknown j.
    sizes: Vec<f64>,
    /// For each row the largest max_j |a_ij| s_j so far.
    norms: Vec<f64>,
    /// For each column the largest max_i |a_ij| s_j / norm_i so far.
    tops: Vec<f64>,
    /// `norms` and `tops` at their last confirmation, if they have grown since.
    confirmed: [Vec<f64>; 2],
    /// True if `norms` or `tops` have grown since their last confirmation.
    provisional: bool,
    /// True if a column is so small that only the rank of the whole matrix distinguishes it from
    /// zero.
    faint: bool,
    /// 1 / norm_i of each row.
    row_units: Padded,
    /// s_j / top_j of each column.
    column_units: Vec<f64>,
    /// For each value its limit. A value above its limit is not finite, or its row and column must
    /// be scaled again. The limit is infinite for values of the ground.
    limits: Padded,
    /// The recorded elimination; `None` before the first one.
    recording: Option<Arc<Recording>>,
    /// For each factored number the factor that scales it to order 1, in the order of the memory.
    weights: Padded,
    /// The bounds of multipliers and other factored numbers, in the order of the memory.
    bounds: Padded,
    /// True if the recording's weights agree with the present scales.
    weighted: bool,
    /// True if nothing must be computed or judged until the scales change: all pivots are
    /// constants.
    settled: bool,
    /// The smallest constant pivot.
    smallest_constant: f64,
    /// The smallest pivot at the last factoring.
    smallest: f64,
    /// True if a multiplier or another number exceeded its bound at the last factoring.
    grown: bool,
    /// True if solutions are refined.
    refined: bool,
    /// The largest value of `smallest` since the recording.
    best: f64,
    /// A buffer for right side and solution during refinement.
    known: Vec<f64>,
    /// The number of recordings.
    recordings: usize,
}

impl Linear {
    /// Creates an n × n matrix with one value for each (row, column) of the pattern, in its order.
    /// Repeated entries add up; `None` belongs to no entry. `constants` contains the constant
    /// values in the same order.
    pub(crate) fn new(
        n: usize,
        pattern: impl IntoIterator<Item = Option<(usize, usize)>>,
        constants: &[Option<f64>],
    ) -> Self {
        let inside = |(row, column): (usize, usize)| {
            (row < n && column < n).then_some((row as u32, column as u32))
        };
        let entries: Arc<[_]> = pattern.into_iter().map(|entry| entry.and_then(inside)).collect();
        let mut sorted: Vec<((u32, u32), u32)> =
            entries.iter().zip(0..).filter_map(|(entry, k)| Some(((*entry)?, k))).collect();
        sorted.sort_unstable();
        let sorted: Vec<u32> = sorted.into_iter().map(|(_, k)| k).collect();
        let mut limits = Padded::new(entries.len(), 0.0);
        limits
            .iter_mut()
            .zip(entries.iter())
            .filter(|(_, entry)| entry.is_none())
            .for_each(|(limit, _)| *limit = f64::INFINITY);
        // Values, right side and solution begin at multiples of four.
        let rhs = entries.len().next_multiple_of(4);
        let length = n.next_multiple_of(4);
        let solution = rhs + length;
        let zero = rhs + 2 * length;
        Linear {
            n,
            sorted: sorted.into(),
            constants: constants.into(),
            memory: vec![0.0; zero + 1],
            places: Places { rhs: rhs as u32, solution: solution as u32, zero: zero as u32 },
            entries,
            sizes: vec![1.0; n],
            norms: vec![0.0; n],
            tops: vec![0.0; n],
            confirmed: [vec![0.0; n], vec![0.0; n]],
            provisional: false,
            faint: false,
            row_units: Padded::new(n, 1.0),
            column_units: vec![1.0; n],
            limits,
            recording: None,
            weights: Padded::default(),
            bounds: Padded::default(),
            weighted: false,
            settled: false,
            smallest_constant: f64::INFINITY,
            smallest: 0.0,
            grown: false,
            refined: false,
            best: 0.0,
            known: vec![0.0; 2 * length],
            recordings: 0,
        }
    }

    /// Sets the characteristic size of each unknown: 1 for an angle, a typical length for a length.
    pub(crate) fn set_sizes(&mut self, sizes: &[f64]) {
        if self.sizes != sizes {
            self.sizes.copy_from_slice(sizes);
            self.set_units();
        }
    }

    /// Returns the values, to be written before [`Linear::factor`].
    pub(crate) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.memory[..self.entries.len()]
    }

    /// Returns the values as last written.
    pub(crate) fn values(&self) -> &[f64] {
        &self.memory[..self.entries.len()]
    }

    /// Returns the right side, to be written before [`Linear::solve`].
    pub(crate) fn rhs_mut(&mut self) -> &mut [f64] {
        &mut self.memory[self.places.rhs as usize..][..self.n]
    }

    /// Returns the values as last written, and the right side.
    pub(crate) fn values_and_rhs(&mut self) -> (&[f64], &mut [f64]) {
        let (values, behind) = self.memory.split_at_mut(self.places.rhs as usize);
        (&values[..self.entries.len()], &mut behind[..self.n])
    }

    /// Returns the right side in groups of four; numbers beyond the end are ignored.
    pub(crate) fn whole_rhs_mut(&mut self) -> &mut [Quad] {
        self.memory[self.places.rhs as usize..self.places.solution as usize].as_chunks_mut().0
    }

    /// Returns the solution of [`Linear::solve`].
    pub(crate) fn solution(&self) -> &[f64] {
        &self.memory[self.places.solution as usize..][..self.n]
    }

    /// Returns the solution in groups of four, with zeros at the end.
    pub(crate) fn whole_solution(&self) -> &[Quad] {
        self.memory[self.places.solution as usize..self.places.zero as usize].as_chunks().0
    }

    /// Returns the smallest scaled pivot of the last factoring. \[-\]
    pub(crate) fn smallest_pivot(&self) -> f64 {
        self.smallest
    }

    /// Factors A = L U. Returns false if A is singular. The values must be finite and scaled.
    ///
    /// It replays the recording if there is one and its check succeeds; otherwise it records the
    /// elimination again.
    pub(crate) fn factor(&mut self) -> bool {
        if self.settled {
            return true;
        }
        if let Some(recording) = &self.recording {
            let settled = recording.factor.len() == 0;
            self.replay();
            // Small pivots are judged like those of a new recording: by the condition of the whole
            // matrix.
            if self.fits() && (self.smallest >= SUSPICIOUS || self.condition() < CONDITION) {
                self.settled = settled;
                return true;
            }
        }
        self.prepare()
    }

    /// Solves A x = b with the present factors.
    pub(crate) fn solve(&mut self) {
        let Some(recording) = &self.recording else { return };
        recording.solve.run(&mut self.memory);
        if self.refined {
            self.refine();
        }
    }

    /// Improves the solution: x += A⁻¹ (b − A x). This removes the error that the growth of entries
    /// causes.
    #[cold]
    fn refine(&mut self) {
        let mut known = std::mem::take(&mut self.known);
        known.copy_from_slice(&self.memory[self.places.rhs as usize..self.places.zero as usize]);
        let (b, x) = known.split_at(known.len() / 2);
        let (values, rhs) = self.memory.split_at_mut(self.places.rhs as usize);
        for (entry, value) in self.entries.iter().zip(values) {
            if let Some((i, j)) = entry {
                rhs[*i as usize] -= *value * x[*j as usize];
            }
        }
        if let Some(recording) = &self.recording {
            recording.solve.run(&mut self.memory);
        }
        let (rhs, solution) = self.memory[self.places.rhs as usize..].split_at_mut(b.len());
        rhs.copy_from_slice(b);
        solution.iter_mut().zip(x).for_each(|(solution, x)| *solution += x);
        self.known = known;
    }

    /// Runs the recorded elimination on the present values, and checks the result.
    fn replay(&mut self) {
        if !self.weighted {
            self.weight_pivots();
        }
        let Some(recording) = &self.recording else { return };
        recording.factor.run(&mut self.memory);
        let Factored { cells, multipliers, pivots, end } = recording.factored;
        let largest = |from: usize, to: usize| {
            let weights = &self.weights.whole()[(from - cells) / 4..(to - cells) / 4];
            padded::largest_share(self.memory[from..to].as_chunks().0, weights)
        };
        let inside = padded::inside(self.memory[cells..pivots].as_chunks().0, self.bounds.whole());
        self.refined = !inside && largest(cells, multipliers) > REFINED;
        self.grown = !inside && largest(multipliers, pivots) > GROWTH;
        // Pivots are stored inverted, so the largest number belongs to the smallest pivot. A number
        // that is not finite means no pivot.
        self.smallest = self.smallest_constant.min(largest(pivots, end).recip());
        self.best = self.best.max(self.smallest);
    }

    /// Returns true if the last replay is as reliable as the recording.
    fn fits(&self) -> bool {
        let faded = self.best * if self.smallest < SUSPICIOUS { 0.5 } else { FADED };
        !self.grown && self.smallest > SINGULAR && self.smallest >= faded
    }

    /// Sets the scales of the pivots for the check.
    fn weight_pivots(&mut self) {
        self.weighted = true;
        let Some(recording) = &self.recording else { return };
        let unit = |row: u32, column: u32| {
            self.row_units[row as usize] * self.column_units[column as usize]
        };
        let mut weights = recording.weights.clone();
        recording
            .watched
            .iter()
            .for_each(|&(step, row, column)| weights[step as usize] = unit(row, column).recip());
        let Factored { cells, multipliers, pivots, end } = recording.factored;
        self.weights = Padded::new(end - cells, 0.0);
        recording
            .factor
            .written()
            .zip(weights)
            .for_each(|((_, place), weight)| self.weights[place as usize - cells] = weight);
        self.bounds = Padded::new(pivots - cells, 0.0);
        for (k, (bound, weight)) in self.bounds.iter_mut().zip(self.weights.iter()).enumerate() {
            *bound = if cells + k < multipliers { REFINED } else { GROWTH } / weight;
        }
        let constant =
            recording.constant.iter().map(|&(row, column, value)| value.abs() * unit(row, column));
        self.smallest_constant = constant.fold(f64::INFINITY, f64::min);
    }

    /// Returns the number of recordings.
    #[cfg(test)]
    pub(crate) fn recordings(&self) -> usize {
        self.recordings
    }

    /// Returns the matrix to be recorded.
    fn input(&self) -> Input<'_> {
        Input {
            n: self.n,
            entries: &self.entries,
            sorted: &self.sorted,
            constants: &self.constants,
            row_units: &self.row_units,
            column_units: &self.column_units,
        }
    }

    /// Records the elimination at the present values, and runs it. Returns false if there are not
    /// enough pivots.
    fn record(&mut self) -> bool {
        self.recordings += 1;
        (self.weighted, self.settled, self.best, self.recording) = (false, false, 0.0, None);
        let mut memory = std::mem::take(&mut self.memory);
        memory.truncate(self.places.zero as usize + 1);
        let recorded = recorded::record::record(&self.input(), self.places, &mut memory);
        self.memory = memory;
        let Some(recorded) = recorded else { return false };
        self.recording = Some(Arc::new(recorded));
        self.replay();
        true
    }

    /// Records the elimination at the present values. Returns false and records nothing if they are
    /// singular.
    pub(crate) fn prepare(&mut self) -> bool {
        self.measure();
        let regular = self.record()
            && (self.n == 0 || self.smallest > SINGULAR && self.condition() < CONDITION);
        if !regular {
            self.recording = None;
        }
        regular
    }
}
