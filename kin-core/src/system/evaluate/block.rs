//! One constraint in a system, and where its numbers stand.

use std::ops::Range;

use crate::model::constraint::Constraint;

/// One constraint in a system.
#[derive(Clone)]
pub(crate) struct Block {
    pub name: String,
    pub constraint: Box<dyn Constraint>,
    /// Where its numbers of time, its arguments, its rows and its values stand.
    pub(super) timed: Span,
    pub(super) arguments: Span,
    pub(super) rows: Span,
    pub(super) values: Span,
    /// True if none of its values of C_q ever changes.
    pub(super) constant: bool,
    /// True if the constraint drives.
    pub drives: bool,
}

/// A stretch of a list. 32 bits: no sum of two overflows, so that taking it costs one check.
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
    /// Where its rows stand among all rows.
    pub(crate) fn rows(&self) -> Range<usize> {
        self.rows.range()
    }

    /// Where its values stand among all values of C_q.
    pub(crate) fn values(&self) -> Range<usize> {
        self.values.range()
    }

    /// Name of local row `k`; empty for a constraint of one row.
    pub(crate) fn row(&self, k: usize) -> &str {
        match self.constraint.facts().rows {
            [_] => "",
            rows => rows.get(k).copied().unwrap_or(""),
        }
    }

    /// Name of the equation in local row `k`, such as `A.x`.
    pub(crate) fn equation(&self, k: usize) -> String {
        match self.row(k) {
            "" => self.name.clone(),
            row => format!("{}.{row}", self.name),
        }
    }
}

/// The numbers from that place on: a constraint knows how many of them are its own.
#[inline(always)]
pub(super) fn from(all: &[f64], first: u32) -> &[f64] {
    &all[first as usize..]
}
