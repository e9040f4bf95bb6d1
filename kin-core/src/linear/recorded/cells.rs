//! Stores the terms of a cell while Kin records the elimination, and writes the step that computes
//! the cell.

use super::active::NONE;
use super::program::Kind;
use super::record::{Inverse, Lists, Number, Recorder};

/// One term of a cell: a product, or a number with a sign.
#[derive(Clone, Copy)]
pub(crate) struct Term {
    /// The place of the first factor, or of the number.
    a: u32,
    /// The place of the second factor, or one of the special values below.
    b: u32,
    /// The index of the next term of the cell.
    next: u32,
}

/// Special values of the second factor: the first factor is added or subtracted.
pub(crate) const PLUS: u32 = NONE;
const MINUS: u32 = NONE - 1;

impl Recorder<'_> {
    /// Subtracts a product from a cell, with its constant factors folded.
    pub(crate) fn subtract(&mut self, cell: u32, l: Number, u: Number) {
        match (l, u) {
            (Number::Constant(l), Number::Constant(u)) => {
                self.active.cells[cell as usize].constant -= l * u
            }
            (Number::At(l), Number::At(u)) => self.add_term(cell, l, u),
            (Number::Constant(c), Number::At(k)) | (Number::At(k), Number::Constant(c)) => {
                match c {
                    1.0 => self.add_term(cell, k, MINUS),
                    -1.0 => self.add_term(cell, k, PLUS),
                    _ => {
                        let constant = self.constant(c);
                        self.add_term(cell, constant, k);
                    }
                }
            }
        }
    }

    pub(crate) fn add_term(&mut self, cell: u32, a: u32, b: u32) {
        let next =
            std::mem::replace(&mut self.active.cells[cell as usize].terms, self.terms.len() as u32);
        self.terms.push(Term { a, b, next });
    }

    /// Returns the place of a constant in the memory.
    pub(crate) fn constant(&mut self, value: f64) -> u32 {
        if value == 0.0 {
            return self.places.zero;
        }
        *self.constants.entry(value.to_bits()).or_insert_with(|| {
            self.memory.push(value);
            self.memory.len() as u32 - 1
        })
    }

    /// Returns a new place in the memory.
    pub(crate) fn place(&mut self) -> u32 {
        self.memory.push(0.0);
        self.memory.len() as u32 - 1
    }

    /// Returns the final number of a cell, and writes a step if something must be computed.
    pub(crate) fn number(&mut self, id: u32) -> Number {
        let cell = &self.active.cells[id as usize];
        if cell.terms == NONE {
            return Number::Constant(cell.constant);
        }
        let Term { a, b, next } = self.terms[cell.terms as usize];
        if next == NONE && b == PLUS && cell.constant == 0.0 {
            return Number::At(a);
        }
        Number::At(self.compute(id, Kind::Plain, self.places.zero, self.weight(id)))
    }

    /// Returns the number of a cell of U divided by its pivot.
    pub(crate) fn multiplier(&mut self, id: u32, inverse: Inverse, pivot_column: u32) -> Number {
        let cell = &self.active.cells[id as usize];
        match (inverse, cell.terms) {
            (Inverse::One, _) => self.number(id),
            (Inverse::MinusOne, NONE) => Number::Constant(-cell.constant),
            (Inverse::MinusOne, _) => {
                Number::At(self.compute(id, Kind::Negated, self.places.zero, self.weight(id)))
            }
            (Inverse::At(inverse), _) => {
                let units = self.input.column_units;
                let weight = units[cell.column as usize] / units[pivot_column as usize];
                Number::At(self.compute(id, Kind::Scaled, inverse, weight))
            }
        }
    }

    /// Returns one divided by the number of a pivot.
    pub(crate) fn inverse(&mut self, id: u32) -> Inverse {
        let cell = &self.active.cells[id as usize];
        let row = cell.row;
        let column = cell.column;
        let constant = cell.constant;
        if cell.terms != NONE {
            self.recording.watched.push((self.recording.factor.len() as u32, row, column));
            return Inverse::At(self.compute(id, Kind::Pivot, self.places.zero, 0.0));
        }
        self.recording.constant.push((row, column, constant));
        match constant {
            1.0 => Inverse::One,
            -1.0 => Inverse::MinusOne,
            _ => Inverse::At(self.constant(constant.recip())),
        }
    }

    /// Returns the factor that scales a cell to order 1.
    pub(crate) fn weight(&self, id: u32) -> f64 {
        let cell = &self.active.cells[id as usize];
        self.input.row_units[cell.row as usize] * self.input.column_units[cell.column as usize]
    }

    /// Writes the step that computes a cell, and returns its place; the check uses `weight`.
    pub(crate) fn compute(&mut self, id: u32, kind: Kind, scale: u32, weight: f64) -> u32 {
        self.recording.weights.push(weight);
        let start = self.gather(id, kind == Kind::Negated);
        let out = self.place();
        let Lists { products, plus, minus } = &self.lists;
        self.recording.factor.push(kind, [out, start, scale], products, plus, minus);
        out
    }

    /// Collects the operands of a cell, with opposite signs if it is to be negated. Returns the
    /// place of its first operand.
    pub(crate) fn gather(&mut self, id: u32, negated: bool) -> u32 {
        let cell = &self.active.cells[id as usize];
        let mut start = None;
        let mut next = cell.terms;
        if cell.constant != 0.0 {
            start = Some(self.constant(cell.constant));
        }
        self.lists.clear();
        while next != NONE {
            let term = self.terms[next as usize];
            next = term.next;
            match term.b {
                PLUS if start.is_none() => start = Some(term.a),
                PLUS => self.lists.plus.push(term.a),
                MINUS => self.lists.minus.push(term.a),
                b => self.lists.products.push([term.a, b]),
            }
        }
        if negated {
            std::mem::swap(&mut self.lists.plus, &mut self.lists.minus);
        }
        start.unwrap_or(self.places.zero)
    }
}
