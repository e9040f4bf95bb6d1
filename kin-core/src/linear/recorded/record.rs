//! Records an elimination: chooses pivots at real numbers and writes the steps of each pivot.
//!
//! Kin chooses pivots by Markowitz' count (few cells in the row times few in the column) among the
//! cells that are not small relative to the largest cell of their row. A = L U, where the rows of U
//! are divided by their pivots if both L and U have cells. A pivot alone in its column divides at
//! the end of back substitution instead, and a pivot alone in its row needs no back substitution.
//! Kin computes constant cells only once, when it records the elimination.

use std::collections::HashMap;

use super::super::SINGULAR;
use super::active::{Active, NONE, Side};
use super::cells::{PLUS, Term};
use super::code::SMALL;
use super::orientation::Orientation;
use super::program::{Kind, Program};
use super::solving;

/// A pivot is at least this share of the largest cell in its row. \[-\]
const THRESHOLD: f64 = 0.1;

/// The number of lines with a possible pivot that are compared.
const COMPARED: usize = 4;

/// A matrix to be recorded: unscaled values, scales of rows and columns, and the start of the
/// program's memory.
pub(crate) struct Input<'a> {
    pub n: usize,
    /// The row and column of each value; `None` for values without an entry.
    pub entries: &'a [Option<(u32, u32)>],
    /// The indices of the values, sorted by rows, then by columns.
    pub sorted: &'a [u32],
    /// For each value its number if it is constant, otherwise `None`.
    pub constants: &'a [Option<f64>],
    /// One divided by the norm of each row.
    pub row_units: &'a [f64],
    pub column_units: &'a [f64],
}

impl Input<'_> {
    /// Returns the row and column of each value that is not always zero.
    fn places(&self) -> impl Iterator<Item = (u32, u32)> {
        let constants = self.constants.iter().copied().chain(std::iter::repeat(None));
        self.entries
            .iter()
            .zip(constants)
            .filter_map(|(entry, constant)| entry.filter(|_| constant != Some(0.0)))
    }
}

/// The places of right side, solution and three constants, after the values.
#[derive(Clone, Copy)]
pub(crate) struct Places {
    pub rhs: u32,
    pub solution: u32,
    pub zero: u32,
}

/// A recorded elimination.
#[derive(Default)]
pub(crate) struct Recording {
    pub factor: Program,
    pub solve: Program,
    /// For each factored number the factor that scaled it to order 1 at the recording.
    pub weights: Vec<f64>,
    /// For each pivot that is not constant its step, row and column.
    pub watched: Vec<(u32, u32, u32)>,
    /// For each constant pivot its row, column and value.
    pub constant: Vec<(u32, u32, f64)>,
    pub orientation: Orientation,
    /// The places at which the factored numbers begin, each kind at a multiple of four, and the
    /// end.
    pub factored: Factored,
}

/// The places of the factored numbers: pivots (as one divided by them), multipliers, and all
/// others.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Factored {
    pub cells: usize,
    pub multipliers: usize,
    pub pivots: usize,
    pub end: usize,
}

impl Recording {
    /// Places the factored numbers after the constants, kind by kind; `begin` is the first place of
    /// a constant.
    fn arrange(&mut self, begin: usize, memory: &mut Vec<f64>) {
        let mut kinds = vec![None; memory.len()];
        self.factor.written().for_each(|(kind, out)| kinds[out as usize] = Some(kind));
        let mut places: Vec<u32> = (0..memory.len() as u32).collect();
        let mut end = begin;
        for old in (begin..memory.len()).filter(|old| kinds[*old].is_none()) {
            (places[old], memory[end]) = (end as u32, memory[old]);
            end += 1;
        }
        let mut place = |wanted: fn(Kind) -> bool| {
            let first = end.next_multiple_of(4);
            end = first;
            for old in (begin..kinds.len()).filter(|old| kinds[*old].is_some_and(wanted)) {
                places[old] = end as u32;
                end += 1;
            }
            first
        };
        let cells = place(|kind| matches!(kind, Kind::Plain | Kind::Negated));
        let multipliers = place(|kind| kind == Kind::Scaled);
        let pivots = place(|kind| kind == Kind::Pivot);
        self.factored = Factored { cells, multipliers, pivots, end: end.next_multiple_of(4) };
        memory.resize(self.factored.end, 0.0);
        memory[cells..].fill(0.0);
        self.orientation.pivots.iter_mut().for_each(|(place, _)| *place = places[*place as usize]);
        self.factor.rename(&places);
        self.solve.rename(&places);
    }
}

/// A number in the elimination.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Number {
    Constant(f64),
    /// The number at this place of the memory.
    At(u32),
}

/// One divided by a pivot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Inverse {
    One,
    MinusOne,
    At(u32),
}

/// One chosen pivot, with the rest of its row in U.
pub(crate) struct Pivot {
    pub row: u32,
    pub column: u32,
    /// The value of one divided by the pivot.
    pub inverse: Inverse,
    /// True if its column has cells in L.
    pub has_lower: bool,
    /// The range of the row in [`Recorder::upper`].
    pub upper: std::ops::Range<usize>,
}

/// The elimination during its recording.
pub(crate) struct Recorder<'a> {
    pub input: &'a Input<'a>,
    pub places: Places,
    pub memory: &'a mut Vec<f64>,
    pub active: Active,
    pub terms: Vec<Term>,
    pub constants: HashMap<u64, u32>,
    pub recording: Recording,
    /// The pivots in the order of their choice.
    pub pivots: Vec<Pivot>,
    /// The columns and numbers of U, pivot by pivot.
    pub upper: Vec<(u32, Number)>,
    /// The cells of L as (column, number, next cell of the row); `lower_first` contains the first
    /// cell of each row.
    pub lower: Vec<(u32, Number, u32)>,
    /// The index of the first cell of each row in `lower`.
    pub lower_first: Vec<u32>,
    pub lists: Lists,
}

/// The operands of one step, while they are collected.
#[derive(Default)]
pub(crate) struct Lists {
    /// The places of the two factors of each product.
    pub products: Vec<[u32; 2]>,
    /// The places of the added numbers.
    pub plus: Vec<u32>,
    /// The places of the subtracted numbers.
    pub minus: Vec<u32>,
}

impl Lists {
    pub(crate) fn clear(&mut self) {
        self.products.clear();
        self.plus.clear();
        self.minus.clear();
    }
}

/// Chooses all pivots and writes both programs. Returns `None` if there is no further pivot. The
/// memory contains the values.
///
/// The phases are: the cells of the matrix, then one pivot after the other, then the program of
/// forward and back substitution, then the places of the factored numbers.
pub(crate) fn record(
    input: &Input<'_>,
    places: Places,
    memory: &mut Vec<f64>,
) -> Option<Recording> {
    let mut recorder = Recorder {
        input,
        places,
        memory,
        active: Active::new(input.n),
        terms: Vec::new(),
        constants: HashMap::new(),
        recording: Recording::default(),
        pivots: Vec::with_capacity(input.n),
        upper: Vec::new(),
        lower: Vec::new(),
        lower_first: vec![NONE; input.n],
        lists: Lists::default(),
    };
    recorder.fill();
    for _ in 0..input.n {
        let pivot = recorder.choose()?;
        recorder.eliminate(pivot);
    }
    solving::write(&mut recorder);
    let Recorder { mut recording, memory, pivots, .. } = recorder;
    recording.orientation = Orientation::new(&pivots, &recording.constant, input.places());
    recording.arrange(places.zero as usize + 1, memory);
    memory.resize(memory.len().max(SMALL), 0.0);
    recording.factor.finish(memory.len());
    recording.solve.finish(memory.len());
    Some(recording)
}

impl Recorder<'_> {
    /// Creates the cells of the matrix.
    fn fill(&mut self) {
        let mut last = None;
        for &k in self.input.sorted {
            let Some((row, column)) = self.input.entries[k as usize] else { continue };
            let value = self.memory[k as usize];
            let constant = self
                .input
                .constants
                .get(k as usize)
                .copied()
                .flatten()
                .filter(|constant| *constant == value);
            if constant == Some(0.0) {
                continue;
            }
            let cell = match last {
                Some((place, cell)) if place == (row, column) => cell,
                _ => self.active.insert(row, column),
            };
            last = Some(((row, column), cell));
            match constant {
                Some(constant) => self.active.cells[cell as usize].constant += constant,
                None => self.add_term(cell, k, PLUS),
            }
            self.active.cells[cell as usize].value += self.input.row_units[row as usize]
                * value
                * self.input.column_units[column as usize];
        }
        for line in (0..self.input.n as u32).rev() {
            self.active.recount(Side::Row, line);
            self.active.recount(Side::Column, line);
        }
    }

    /// Returns the next pivot, if there is one.
    fn choose(&mut self) -> Option<u32> {
        let mut best = Candidate::default();
        let mut compared = 0;
        for count in 1..=self.input.n {
            for side in [Side::Row, Side::Column] {
                let bound =
                    if side == Side::Row { (count - 1).pow(2) } else { (count - 1) * count };
                if best.cost <= bound {
                    return best.cell;
                }
                let mut line = self.active.counts[side as usize].first(count);
                while line != NONE {
                    let next = self.active.counts[side as usize].next(line);
                    if !self.compare(side, line, &mut best) {
                        self.active.counts[side as usize].remove(line);
                    } else if best.cost <= bound || compared + 1 == COMPARED {
                        return best.cell;
                    } else {
                        compared += 1;
                    }
                    line = next;
                }
            }
        }
        best.cell
    }

    /// Compares the possible pivots of a line with the best so far. Returns false if there are
    /// none.
    fn compare(&mut self, side: Side, line: u32, best: &mut Candidate) -> bool {
        let count = self.active.line(side, line).len();
        let mut found = false;
        for k in 0..count {
            let id = self.active.line(side, line)[k];
            let cell = &self.active.cells[id as usize];
            let row = cell.row;
            let column = cell.column;
            let size = cell.value.abs();
            let unit = cell.terms == NONE && cell.constant.abs() == 1.0;
            let alone = side == Side::Column && count == 1;
            let enough = if alone { 0.0 } else { THRESHOLD * self.active.top(row) };
            if size.is_nan() || size <= SINGULAR || size < enough {
                continue;
            }
            found = true;
            let rows = self.active.line(Side::Column, column).len();
            let columns = self.active.line(Side::Row, row).len();
            best.take(Candidate { cell: Some(id), cost: (rows - 1) * (columns - 1), unit, size });
        }
        found
    }

    /// Writes the steps of the pivot and updates the remaining cells.
    fn eliminate(&mut self, pivot: u32) {
        let cell = self.active.cells[pivot as usize].clone();
        let (lower, upper) = self.active.take_out(pivot);
        let divided = !lower.is_empty() && !upper.is_empty();
        let inverse = self.inverse(pivot);
        let from = self.upper.len();
        for &id in &upper {
            let number =
                if divided { self.multiplier(id, inverse, cell.column) } else { self.number(id) };
            self.upper.push((self.active.cells[id as usize].column, number));
        }
        self.pivots.push(Pivot {
            row: cell.row,
            column: cell.column,
            inverse,
            has_lower: !lower.is_empty(),
            upper: from..self.upper.len(),
        });
        for &id in &lower {
            let row = self.active.cells[id as usize].row;
            let number = self.number(id);
            let next =
                std::mem::replace(&mut self.lower_first[row as usize], self.lower.len() as u32);
            self.lower.push((cell.column, number, next));
            if divided {
                self.update(
                    row,
                    number,
                    self.active.cells[id as usize].value / cell.value,
                    from,
                    &upper,
                );
            }
        }
    }

    /// Subtracts in one row: a_ij −= l_i u_j.
    fn update(&mut self, row: u32, l: Number, share: f64, from: usize, upper: &[u32]) {
        self.active.mark(row);
        for (k, &source) in upper.iter().enumerate() {
            let (column, u) = self.upper[from + k];
            let cell = self.active.marked(column).unwrap_or_else(|| {
                let cell = self.active.insert(row, column);
                self.active.recount(Side::Column, column);
                cell
            });
            let change = share * self.active.cells[source as usize].value;
            self.active.cells[cell as usize].value -= change;
            self.subtract(cell, l, u);
            let now = &self.active.cells[cell as usize];
            if now.terms == NONE && now.constant == 0.0 {
                self.active.vanish(cell);
            }
        }
        self.active.unmark(row);
    }
}

/// A possible pivot.
struct Candidate {
    /// The index of the cell; `None` before the first candidate.
    cell: Option<u32>,
    /// Markowitz' count.
    cost: usize,
    /// True if it is always 1 or −1.
    unit: bool,
    size: f64,
}

impl Default for Candidate {
    fn default() -> Self {
        Candidate { cell: None, cost: usize::MAX, unit: false, size: 0.0 }
    }
}

impl Candidate {
    /// Takes the other candidate if it is better: cheaper, without a division, larger.
    fn take(&mut self, other: Candidate) {
        let order = self
            .cost
            .cmp(&other.cost)
            .then(other.unit.cmp(&self.unit))
            .then(other.size.total_cmp(&self.size));
        if order == std::cmp::Ordering::Greater {
            *self = other;
        }
    }
}
