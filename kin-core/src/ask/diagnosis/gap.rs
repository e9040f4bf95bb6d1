//! Reports constraints that cannot be satisfied, their residuals, and the required values of their
//! drivers.

use crate::outcome::verdict::{Against, Asks, Gap, Step};

use crate::coordinates::layout::Layout;
use crate::coordinates::units::Unit;
use crate::solve::assembly::search::Found;
use crate::system::drivers::units_of_rows;
use crate::system::evaluate::Block;
use crate::system::scaled::Model;

pub(super) fn gap(model: &Model<'_>, found: &Found, t: f64, block: usize, starts: usize) -> Gap {
    let block = &model.equations.blocks[block];
    let rows = block.rows();
    let point = &found.place.point;
    Gap {
        constraint: block.name.clone(),
        equations: rows.clone().map(|row| model.equations.equation(row)).collect(),
        residual: point.c[rows.clone()].to_vec(),
        row_units: units_of_rows(model.layout, block),
        asks: asks(model, found, t, rows.clone()),
        rows: rows.collect(),
        lasting: false,
        starts,
        against: against(model, found, t, block.name.as_str()),
        can_jump: !model.equations.jumping().is_empty(),
        steps: steps(model, found, t),
    }
}

/// Returns jumps of equations near the pose. It moves one coordinate of each constraint that can
/// jump a little to either side.
fn steps(model: &Model<'_>, found: &Found, t: f64) -> Vec<Step> {
    /// The largest number of constraints to examine.
    const LOOKED_AT: usize = 8;
    let blocks = model.equations.jumping().iter().take(LOOKED_AT);
    blocks.filter_map(|block| step(model, found, t, &model.equations.blocks[*block])).collect()
}

/// Returns the jump of one constraint nearest to the pose.
fn step(model: &Model<'_>, found: &Found, t: f64, block: &Block) -> Option<Step> {
    /// The displacements of coordinates to either side, in units of their sizes. \[-\]
    const BESIDE: [f64; 8] = [1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4];
    /// A jump is larger than this multiple of the change that slopes explain, and than this share
    /// of the norm. \[-\]
    const STEEP: f64 = 30.0;
    const LEAST: f64 = 1e-6;
    let q = &found.place.q;
    let sizes = &found.measures.sizes;
    let norms = &found.measures.norms;
    let mut columns: Vec<usize> = model
        .entries(&found.place.point.values)
        .filter(|(row, ..)| block.rows().contains(row))
        .map(|(_, column, _)| column)
        .collect();
    columns.sort_unstable();
    columns.dedup();
    let at = |column: usize, by: f64| {
        let mut beside = q.clone();
        beside[column] += by;
        model.linearize(&beside, t).ok().map(|point| point.c)
    };
    for (beside, column) in
        BESIDE.iter().flat_map(|beside| columns.iter().map(move |column| (beside, *column)))
    {
        let by = beside * sizes[column];
        let (Some(below), Some(above)) = (at(column, -by), at(column, by)) else { continue };
        let jumps = |row: &usize| {
            (above[*row] - below[*row]).abs() > norms[*row] * (STEEP * 2.0 * beside).max(LEAST)
        };
        if let Some(row) = block.rows().find(jumps) {
            let equation = model.equations.equation(row);
            let coordinate = model.layout.names[column].clone();
            let constraint = block.name.clone();
            let at = q[column];
            return Some(Step {
                constraint,
                equation,
                coordinate,
                at,
                from: below[row],
                to: above[row],
            });
        }
    }
    None
}

/// Returns all drivers except one.
fn against(model: &Model<'_>, found: &Found, t: f64, but: &str) -> Vec<Against> {
    let drivers = model.equations.blocks.iter().filter(|block| block.drives && block.name != but);
    drivers
        .map(|block| Against {
            constraint: block.name.clone(),
            asks: asks(model, found, t, block.rows()),
        })
        .collect()
}

/// For a driver a q_j − f(t) = 0: returns the required value of the coordinate.
fn asks(model: &Model<'_>, found: &Found, t: f64, rows: std::ops::Range<usize>) -> Option<Asks> {
    if rows.len() != 1 || !model.drives(rows.start) {
        return None;
    }
    let mut own = model
        .entries(&found.place.point.values)
        .filter(|(row, _, value)| *row == rows.start && *value != 0.0);
    let (Some((_, column, value)), None) = (own.next(), own.next()) else { return None };
    let stands = found.place.q[column];
    let c = found.place.point.c[rows.start];
    let mut q = found.place.q.clone();
    q[column] -= c / value;
    let rounding = 1e-9 * c.abs() + 1e-12 * (value * found.measures.sizes[column]).abs();
    let reached = model.linearize(&q, t).is_ok_and(|point| point.c[rows.start].abs() <= rounding);
    reached.then(|| Asks::of(model.layout, column, q[column], stands))
}

impl Asks {
    /// Returns the values of a coordinate of the layout, by its column.
    pub(super) fn of(layout: &Layout, column: usize, asked: f64, stands: f64) -> Asks {
        let unit = match layout.units[column] {
            Unit::One => String::new(),
            unit => layout.words.text(unit, 0),
        };
        Asks::new(layout.names[column].clone(), unit, asked, stands)
    }

    fn seen_from(&mut self, layout: &Layout, guess: &[f64]) {
        let column = layout.names.iter().position(|name| *name == self.coordinate);
        self.beyond_guess = column
            .filter(|column| layout.units[*column] == Unit::Radian)
            .map(|column| self.asked - guess[column]);
    }
}

impl Gap {
    /// Records the differences of required angles from their guess.
    pub(crate) fn seen_from(&mut self, layout: &Layout, guess: &[f64]) {
        let others = self.against.iter_mut().filter_map(|other| other.asks.as_mut());
        self.asks.iter_mut().chain(others).for_each(|asks| asks.seen_from(layout, guess));
    }
}
