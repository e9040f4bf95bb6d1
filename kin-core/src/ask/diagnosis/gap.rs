//! Constraints that cannot be met, by how much, and the values that their drivers ask for.

use crate::model::verdict::{Against, Asks, Gap};

use crate::model::layout::Layout;
use crate::model::units::Unit;
use crate::solve::assembly::search::Found;
use crate::system::scaled::Model;

pub(super) fn gap(model: &Model<'_>, found: &Found, t: f64, block: usize, starts: usize) -> Gap {
    let block = &model.equations.blocks[block];
    let (rows, point) = (block.rows(), &found.place.point);
    Gap {
        constraint: block.name.clone(),
        equations: rows.clone().map(|row| model.equations.equation(row)).collect(),
        residual: point.c[rows.clone()].to_vec(),
        asks: asks(model, found, t, rows.clone()),
        rows: rows.collect(),
        lasting: false,
        starts,
        against: against(model, found, t, block.name.as_str()),
    }
}

/// The drivers but one.
fn against(model: &Model<'_>, found: &Found, t: f64, but: &str) -> Vec<Against> {
    let drivers = model.equations.blocks.iter().filter(|block| block.drives && block.name != but);
    drivers
        .map(|block| Against { constraint: block.name.clone(), asks: asks(model, found, t, block.rows()) })
        .collect()
}

/// For a driver a q_j − f(t) = 0: where the coordinate should be.
fn asks(model: &Model<'_>, found: &Found, t: f64, rows: std::ops::Range<usize>) -> Option<Asks> {
    if rows.len() != 1 || !model.drives(rows.start) {
        return None;
    }
    let mut own = model
        .entries(&found.place.point.values)
        .filter(|(row, _, value)| *row == rows.start && *value != 0.0);
    let (Some((_, column, value)), None) = (own.next(), own.next()) else { return None };
    let (stands, c) = (found.place.q[column], found.place.point.c[rows.start]);
    let mut q = found.place.q.clone();
    q[column] -= c / value;
    let rounding = 1e-9 * c.abs() + 1e-12 * (value * found.measures.sizes[column]).abs();
    let reached = model.linearize(&q, t).is_ok_and(|point| point.c[rows.start].abs() <= rounding);
    reached.then(|| Asks::new(model.layout.names[column].clone(), q[column], stands))
}

impl Asks {
    fn seen_from(&mut self, layout: &Layout, guess: &[f64]) {
        let column = layout.names.iter().position(|name| *name == self.coordinate);
        self.beyond_guess = column
            .filter(|column| layout.units[*column] == Unit::Radian)
            .map(|column| self.asked - guess[column]);
    }
}

impl Gap {
    /// Notes how far angles that are asked for are from their guess.
    pub(crate) fn seen_from(&mut self, layout: &Layout, guess: &[f64]) {
        let others = self.against.iter_mut().filter_map(|other| other.asks.as_mut());
        self.asks.iter_mut().chain(others).for_each(|asks| asks.seen_from(layout, guess));
    }
}
