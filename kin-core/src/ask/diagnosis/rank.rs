//! Rank and null spaces of C_q at a pose.

use super::order;
use crate::linear::{Echelon, Sparse, reduced};
use crate::system::scaled::{Measures, Model};

/// Rank and null spaces at one pose, each vector with the row or column of its own.
pub(super) struct Ranked {
    pub rank: usize,
    pub gap: f64,
    /// y with yᵀ C_q = 0 in scaled units.
    pub dependent: Vec<(usize, Sparse)>,
    /// x with C_q x = 0 in scaled units.
    pub free: Vec<(usize, Sparse)>,
}

/// Rows and columns in the order in which they are called superfluous or free.
pub(super) struct Orders {
    pub rows: Vec<usize>,
    pub columns: Vec<usize>,
}

impl Orders {
    pub(super) fn new(model: &Model<'_>) -> Self {
        Orders { rows: order::of_rows(model), columns: order::of_columns(model) }
    }

    /// The same with these first.
    pub(super) fn after(&self, rows: &[usize], columns: &[usize]) -> Orders {
        let first = |first: &[usize], all: &[usize]| {
            let mut is_first = vec![false; all.len()];
            first.iter().for_each(|k| is_first[*k] = true);
            first.iter().chain(all.iter().filter(|k| !is_first[**k])).copied().collect()
        };
        Orders { rows: first(rows, &self.rows), columns: first(columns, &self.columns) }
    }
}

/// Rank at a pose, where pivots below `least` count as zero.
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
