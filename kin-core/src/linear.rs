//! The linear solver: a square matrix of fixed pattern comes in as values, solutions go out.
//! Nothing else of Kin eliminates.
//!
//! The elimination is recorded once, at real numbers, and then replayed as flat code ([`code`]) on
//! one memory: values, right side and solution stand in it, so constraints write straight into it.
//! Each pivot is measured by the largest entries that its row and its column have had so far,
//! lengths in units of the model's own length: so the verdict "singular" does not depend on units
//! (mm, m or km), and a row that fades on the way to a toggle is seen to fade. A replay is watched:
//! where pivots fade or multipliers grow, the elimination is recorded anew at the numbers of that
//! moment. The measures only choose and judge pivots, they never touch the numbers.

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

/// A pivot below this measure is zero; the rounding of an elimination of moderate size stays
/// below.   \[-\]
const SINGULAR: f64 = 1e-13;

/// A condition number, by the measures of rows and columns, above which a matrix counts as
/// singular.   \[-\]
const CONDITION: f64 = 3e12;

/// Multipliers of a replay may grow to this; a new recording keeps them below 10.   \[-\]
const GROWTH: f64 = 30.0;

/// Where cells of the elimination have grown beyond this, solutions are refined; of mechanisms none
/// has been seen to need it.   \[-\]
const REFINED: f64 = 100.0;

/// The smallest pivot may fade to this share of what it has been since the recording.   \[-\]
const FADED: f64 = 0.01;

/// Rows and columns are measured anew where a value has grown by this.   \[-\]
const SLACK: f64 = 1.25;

/// Below this a pivot may be judged by a recording only that has seen one like it.   \[-\]
const SUSPICIOUS: f64 = 1e-6;

/// A square matrix of fixed pattern, its recorded elimination, and the memory that both work in.
#[derive(Clone)]
pub(crate) struct Linear {
    n: usize,
    /// Row and column of each value; `None` for what stands on the ground.
    entries: Arc<[Option<(u32, u32)>]>,
    /// Values in the order of rows, then of columns.
    sorted: Arc<[u32]>,
    /// Values that never change; `None` for those that can.
    constants: Arc<[Option<f64>]>,
    /// Values, right side, solution, then what the programs compute.
    memory: Vec<f64>,
    places: Places,
    /// s_j, the characteristic size of unknown j.
    sizes: Vec<f64>,
    /// max_j |a_ij| s_j of each row, the largest so far.
    norms: Vec<f64>,
    /// max_i |a_ij| s_j / norm_i of each column, the largest so far.
    tops: Vec<f64>,
    /// Both as they were when they were last confirmed, where they have grown since.
    confirmed: [Vec<f64>; 2],
    provisional: bool,
    faint: bool,
    /// 1 / norm_i, and s_j / top_j.
    row_units: Padded,
    column_units: Vec<f64>,
    /// A value above its limit is not finite, or its row and column are to be measured anew;
    /// infinite on the ground.
    limits: Padded,
    recording: Option<Arc<Recording>>,
    /// The factors that make each factored number one of order 1, by the measures, in the order of
    /// the memory.
    weights: Padded,
    /// Bounds of multipliers and other factored numbers.
    bounds: Padded,
    /// True if the recording's weights agree with the present measures.
    weighted: bool,
    /// True if there is nothing to compute and nothing to judge until the measures change: all
    /// pivots are constants.
    settled: bool,
    /// The smallest constant pivot, and the smallest of all at the last factoring.
    smallest_constant: f64,
    smallest: f64,
    /// True if a multiplier, or another number, has grown beyond its bound at the last factoring.
    grown: bool,
    refined: bool,
    /// The largest that `smallest` has been since the recording.
    best: f64,
    /// Right side and solution while they are refined.
    known: Vec<f64>,
    /// How many times the elimination has been recorded.
    recordings: usize,
}

impl Linear {
    /// An n × n matrix with one value for each (row, column) of the pattern, in its order; repeated
    /// places add up, `None` stands nowhere. Values that are the same for good may be given in
    /// `constants`, in the same order.
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
        // Values, right side and solution begin at whole fours.
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

    /// The characteristic size of each unknown: 1 for an angle, a typical length for a length.
    pub(crate) fn set_sizes(&mut self, sizes: &[f64]) {
        if self.sizes != sizes {
            self.sizes.copy_from_slice(sizes);
            self.set_units();
        }
    }

    /// The values, to be written before [`Linear::factor`].
    pub(crate) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.memory[..self.entries.len()]
    }

    /// The values as last written.
    pub(crate) fn values(&self) -> &[f64] {
        &self.memory[..self.entries.len()]
    }

    /// The right side, to be written before [`Linear::solve`].
    pub(crate) fn rhs_mut(&mut self) -> &mut [f64] {
        &mut self.memory[self.places.rhs as usize..][..self.n]
    }

    /// The values as last written, and the right side.
    pub(crate) fn values_and_rhs(&mut self) -> (&[f64], &mut [f64]) {
        let (values, behind) = self.memory.split_at_mut(self.places.rhs as usize);
        (&values[..self.entries.len()], &mut behind[..self.n])
    }

    /// The same in whole fours; what is written beyond the end does not count.
    pub(crate) fn whole_rhs_mut(&mut self) -> &mut [Quad] {
        self.memory[self.places.rhs as usize..self.places.solution as usize].as_chunks_mut().0
    }

    /// The solution that [`Linear::solve`] has found.
    pub(crate) fn solution(&self) -> &[f64] {
        &self.memory[self.places.solution as usize..][..self.n]
    }

    /// The same in whole fours, zeros at the end.
    pub(crate) fn whole_solution(&self) -> &[Quad] {
        self.memory[self.places.solution as usize..self.places.zero as usize].as_chunks().0
    }

    /// The smallest pivot of the last factoring, by the measures of its row and column.   \[-\]
    pub(crate) fn smallest_pivot(&self) -> f64 {
        self.smallest
    }

    /// A = L U; false if A is singular. The values must be finite and measured.
    pub(crate) fn factor(&mut self) -> bool {
        if self.settled {
            return true;
        }
        if let Some(recording) = &self.recording {
            let settled = recording.factor.len() == 0;
            self.replay();
            // Small pivots are judged as those of a new recording are: by the condition of the
            // whole.
            if self.fits() && (self.smallest >= SUSPICIOUS || self.condition() < CONDITION) {
                self.settled = settled;
                return true;
            }
        }
        self.prepare()
    }

    /// A x = b with the factors at hand: from the right side to the solution.
    pub(crate) fn solve(&mut self) {
        let Some(recording) = &self.recording else { return };
        recording.solve.run(&mut self.memory);
        if self.refined {
            self.refine();
        }
    }

    /// x += A⁻¹ (b − A x): what growth of the cells has cost comes back.
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

    /// Runs the recorded elimination on the values as written, and looks at what it has computed.
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
        // Pivots stand there inverted: the largest is the smallest pivot, and a number that is not
        // finite none at all.
        self.smallest = self.smallest_constant.min(largest(pivots, end).recip());
        self.best = self.best.max(self.smallest);
    }

    /// True if the last replay can be trusted as the recording could.
    fn fits(&self) -> bool {
        let faded = self.best * if self.smallest < SUSPICIOUS { 0.5 } else { FADED };
        !self.grown && self.smallest > SINGULAR && self.smallest >= faded
    }

    /// Tells the watch how pivots are measured.
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

    /// How many times the elimination has been recorded.
    #[cfg(test)]
    pub(crate) fn recordings(&self) -> usize {
        self.recordings
    }

    /// The matrix to be recorded.
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

    /// Records the elimination at the values as written, and runs it; false where there are not
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

    /// Records the elimination at the values as written; false, and nothing recorded, if they are
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
