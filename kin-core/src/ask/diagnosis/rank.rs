//! Rank and null spaces of C_q at a pose.

use super::order;
use crate::linear::{Echelon, Sparse, reduced};
use crate::system::scaled::{Measures, Model};

/// Rank and null spaces at one pose. Each null vector has a row or column that belongs to it alone.
pub(super) struct Ranked {
    pub rank: usize,
    pub gap: f64,
    /// The vectors y with yᵀ C_q = 0 in scaled units, each with its row.
    pub dependent: Vec<(usize, Sparse)>,
    /// The vectors x with C_q x = 0 in scaled units, each with its column.
    pub free: Vec<(usize, Sparse)>,
}

/// The order in which rows are called superfluous and columns free.
pub(super) struct Orders {
    pub rows: Vec<usize>,
    pub columns: Vec<usize>,
}

impl Orders {
    pub(super) fn new(model: &Model<'_>) -> Self {
        Orders { rows: order::of_rows(model), columns: order::of_columns(model) }
    }

    /// Returns the orders with these rows and columns first.
    pub(super) fn after(&self, rows: &[usize], columns: &[usize]) -> Orders {
        let first = |first: &[usize], all: &[usize]| {
            let mut is_first = vec![false; all.len()];
            first.iter().for_each(|k| is_first[*k] = true);
            first.iter().chain(all.iter().filter(|k| !is_first[**k])).copied().collect()
        };
        Orders { rows: first(rows, &self.rows), columns: first(columns, &self.columns) }
    }
}

/// Computes the rank at a pose, with pivots below `least` counted as zero.
pub(super) fn ranked(
    model: &Model<'_>,
    values: &[f64],
    measures: &Measures,
    orders: &Orders,
    least: f64,
) -> Ranked {
    let found = Echelon::new(model.scaled(values, measures, &|_| true), model.n(), least);
    Ranked {
        rank: found.rank(),
        gap: found.smallest / found.left.max(f64::EPSILON),
        dependent: reduced(found.left_null_space(), model.m(), &orders.rows),
        free: reduced(found.null_space(), model.n(), &orders.columns),
    }
}
