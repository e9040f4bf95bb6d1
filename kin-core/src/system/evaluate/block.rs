//! Stores one constraint in a system, with the places of its numbers.

use std::ops::Range;

use crate::model::constraint::Constraint;

/// One constraint in a system.
#[derive(Clone)]
pub(crate) struct Block {
    pub name: String,
    pub constraint: Box<dyn Constraint>,
    /// The places of its numbers of time, its arguments, its rows and its values of C_q.
    pub(super) timed: Span,
    pub(super) arguments: Span,
    pub(super) rows: Span,
    pub(super) values: Span,
    /// True if all its values of C_q are constant.
    pub(super) constant: bool,
    /// True for a driver.
    pub drives: bool,
}

/// A range of a list. With 32 bits no sum overflows, so taking the range costs one check.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub first: u32,
    pub len: u32,
}

impl Span {
    pub(super) fn new(range: Range<usize>) -> Self {
        Span { first: range.start as u32, len: range.len() as u32 }
    }

    pub(super) fn range(self) -> Range<usize> {
        self.first as usize..self.first as usize + self.len as usize
    }
}

impl Block {
    /// Returns the place of its rows among all rows.
    pub(crate) fn rows(&self) -> Range<usize> {
        self.rows.range()
    }

    /// Returns the place of its values among all values of C_q.
    pub(crate) fn values(&self) -> Range<usize> {
        self.values.range()
    }

    /// Returns the name of local row `k`, or an empty text for a constraint of one row.
    pub(crate) fn row(&self, k: usize) -> &str {
        match self.constraint.facts().rows {
            [_] => "",
            rows => rows.get(k).copied().unwrap_or(""),
        }
    }

    /// Returns the name of the equation in local row `k`, such as `A.x`.
    pub(crate) fn equation(&self, k: usize) -> String {
        match self.row(k) {
            "" => self.name.clone(),
            row => format!("{}.{row}", self.name),
        }
    }
}

/// Returns the numbers from index `first` on. The constraint knows how many of them it owns.
#[inline(always)]
pub(super) fn from(all: &[f64], first: u32) -> &[f64] {
    &all[first as usize..]
}
