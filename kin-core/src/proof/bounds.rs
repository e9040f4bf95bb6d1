//! C and C_q of a whole system over boxes and intervals of time.

use std::collections::HashSet;

use super::equation::Inputs;
use super::interval::{Interval, ONE, ZERO};
use super::series::Series;
use crate::blame::graph::Graph;
use crate::blame::{Source, columns, kind};
use crate::dual_route::each_coordinate;
use crate::error::Error;
use crate::system::System;
use crate::system::evaluate::Block;

/// An equation of which no bounds are known over a box, and the expression that makes it so.
#[derive(Clone, Debug)]
pub(super) struct Unknown {
    pub row: usize,
    pub expression: Option<(&'static str, Option<Source>)>,
}

/// The equations of a system, to be asked for bounds.
pub(super) struct Bounds<'a> {
    pub system: &'a System,
    parts: Vec<Part<'a>>,
}

/// One constraint, and what stands behind its columns.
struct Part<'a> {
    block: &'a Block,
    columns: Vec<Column>,
}

#[derive(Clone, Copy)]
enum Column {
    Own(usize),
    /// On the ground.
    Fixed(f64),
}

impl<'a> Bounds<'a> {
    /// The constraints of a system; an error by name for one that is not known as steps.
    pub(super) fn new(system: &'a System) -> Result<Self, Error> {
        let equations = system.equations();
        let instant = equations.instant_at(0.0, system.initial());
        let part = |block: &'a Block| {
            readable(block)?;
            let (arguments, mut values) = (block.constraint.arguments(), Vec::new());
            each_coordinate(arguments.iter().map(kind), &instant.of(block), &mut |value| values.push(value));
            let places = arguments.iter().flat_map(|argument| columns(argument, system.layout()));
            let columns = places.zip(values).map(|(place, value)| place.map_or(Column::Fixed(value), Column::Own)).collect();
            Ok(Part { block, columns })
        };
        Ok(Bounds { system, parts: equations.blocks.iter().map(part).collect::<Result<_, Error>>()? })
    }

    /// Every row of C along q and t.
    pub(super) fn residual(&self, q: &[Series], t: Series) -> Result<Vec<Series>, Unknown> {
        let mut c = Vec::with_capacity(self.system.n_equations());
        for part in &self.parts {
            let local: Vec<Series> = part.columns.iter().map(|column| column.of(q)).collect();
            part.run(&local, t, 1, &mut |_| true, &mut |_, y| c.push(y))?;
        }
        Ok(c)
    }

    /// The entries (row, column, values) of C_q over a box of positions and an interval of time.
    pub(super) fn jacobian(&self, q: &[Interval], t: Interval) -> Result<Vec<(usize, usize, Interval)>, Unknown> {
        let (mut entries, t) = (Vec::new(), Series::constant(t));
        for part in &self.parts {
            let still: Vec<Series> = part.columns.iter().map(|column| Series::constant(column.of(q).into())).collect();
            for (k, column) in part.columns.iter().enumerate() {
                let Column::Own(column) = *column else { continue };
                let rows = part.entries(k);
                let first = part.block.rows().start;
                if let Some(constants) = rows.iter().map(|(row, constant)| Some((*row, (*constant)?))).collect::<Option<Vec<_>>>() {
                    entries.extend(constants.into_iter().map(|(row, value)| (first + row, column, Interval::from(value))));
                    continue;
                }
                let mut local = still.clone();
                local[k] = Series::variable(still[k].value(), ONE, 2);
                let asked: HashSet<usize> = rows.iter().map(|(row, _)| *row).collect();
                part.run(&local, t, 2, &mut |row| asked.contains(&row), &mut |row, y| entries.push((row, column, y.at(1))))?;
            }
        }
        Ok(entries)
    }
}

impl Column {
    fn of<T: Copy + From<Fixed>>(self, q: &[T]) -> T {
        match self {
            Column::Own(k) => q.get(k).copied().unwrap_or(T::from(Fixed(f64::NAN))),
            Column::Fixed(x) => T::from(Fixed(x)),
        }
    }
}

/// A number that does not move.
struct Fixed(f64);

impl From<Fixed> for Interval {
    fn from(x: Fixed) -> Self {
        Interval::from(x.0)
    }
}

impl From<Fixed> for Series {
    fn from(x: Fixed) -> Self {
        Series::constant(Interval::from(x.0))
    }
}

impl Part<'_> {
    /// The rows that depend on a local column, each with its entry if that never changes.
    fn entries(&self, column: usize) -> Vec<(usize, Option<f64>)> {
        let constraint = &self.block.constraint;
        let constants = constraint.constants();
        let all = constraint.pattern().iter().enumerate();
        all.filter(|(_, entry)| entry.1 == column).map(|(k, entry)| (entry.0, constants.get(k).copied().flatten())).collect()
    }

    /// Gives the rows that are asked for, at least `len` coefficients of each.
    fn run(
        &self,
        columns: &[Series],
        t: Series,
        len: usize,
        asked: &mut dyn FnMut(usize) -> bool,
        give: &mut dyn FnMut(usize, Series),
    ) -> Result<(), Unknown> {
        let (first, mut unknown) = (self.block.rows().start, None);
        self.block.constraint.graph(&mut |graph: &Graph, parameters, outside| {
            let results = graph.series(&Inputs { columns, t, parameters, outside });
            for row in (0..graph.rows.len()).filter(|row| asked(*row)) {
                let y = graph.row(row, &results);
                if y.len() < len || !y.known().iter().all(|c| c.is_finite()) {
                    unknown = Some(Unknown { row: first + row, expression: graph.unknown(row, &results, len) });
                    return;
                }
                give(first + row, y);
            }
        });
        unknown.map_or(Ok(()), Err)
    }
}

/// An error by name unless bounds of a constraint can be had.
fn readable(block: &Block) -> Result<(), Error> {
    let mut reason = Some(format!(
        "it takes the {} route, and only the symbolic one leaves its equation as steps of which bounds over an interval can be had",
        block.constraint.route()
    ));
    block.constraint.graph(&mut |graph, _, outside| reason = graph.opaque(outside));
    let what = || format!("a motion with `{}` ({})", block.name, block.constraint.kind());
    reason.map_or(Ok(()), |reason| Err(Error::CannotBeProved { what: what(), reason }))
}

/// Σ c_j σʲ over −1 ≤ σ ≤ 1, by Taylor's formula: its coefficients at σ = 0 and, for the remainder, over all σ.
pub(super) fn taylor(at: &Series, over: &Series) -> Interval {
    let Some(last) = over.len().checked_sub(1) else { return over.value() };
    let unit = |k: usize| if k == 0 { ONE } else if k.is_multiple_of(2) { ZERO.hull(ONE) } else { Interval::ball(1.0) };
    (0..last).map(|k| at.at(k) * unit(k)).fold(over.at(last) * unit(last), |sum, term| sum + term)
}
