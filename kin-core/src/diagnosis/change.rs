//! The least change that makes a mechanism exactly constrained.

use serde::{Deserialize, Serialize};

use super::contradiction::{Asks, Gap};
use super::dependency::{Class, Dependency};
use super::examine::Examined;
use super::freedom::{Freedom, Persistence};
use crate::layout::Unit;

/// One thing to change in the model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Change {
    /// Leave a constraint out.
    Remove {
        /// The constraint.
        constraint: String,
        /// Constraints of which any could be left out in its place: other drivers that contradict it, or joints of one row.
        or: Vec<String>,
    },
    /// Change a dimension by which a joint can be met.
    Fit {
        /// The joint.
        constraint: String,
        /// What is missing.   \[unit of the joint's rows\]
        missing: f64,
        /// Names of its rows that could be left out in place of it; all of them if the whole joint could.
        or_drop: Vec<String>,
        /// How many rows it has.
        of: usize,
    },
    /// Ask less of a driver: what it asks for is beyond what the mechanism can reach.
    Limit {
        /// The driver.
        constraint: String,
        /// For a driver of one coordinate: what it asks for, and the nearest to it that was found.
        asks: Option<Asks>,
    },
    /// Leave some rows of a constraint out: a joint that holds less.
    Drop {
        /// The constraint.
        constraint: String,
        /// Names of its rows that are superfluous.
        rows: Vec<String>,
        /// A joint of the library that holds just the rest, in words.
        instead: Option<String>,
    },
    /// Drive a coordinate, or hold it.
    Drive {
        /// The coordinate.
        coordinate: String,
        /// Whether it is an Euler parameter: then the turn of its body is meant.
        turn: bool,
        /// The bodies that would move with it.
        moves: Vec<String>,
    },
}

/// Rows to leave out for what is superfluous, coordinates to drive for what is free. A dependency or freedom of this pose alone asks for
/// another pose, not for another model.
pub(super) fn least(examined: &Examined<'_>, gaps: &[Gap], dependencies: &[Dependency], freedoms: &[Freedom]) -> Vec<Change> {
    let mut changes: Vec<Change> = Vec::new();
    changes.extend(gaps.iter().map(|gap| for_gap(examined, gap, dependencies)));
    let gone = |row: usize| gaps.iter().any(|gap| gap.rows.contains(&row));
    let lasting = dependencies.iter().filter(|found| found.class != Class::OnlyHere);
    let (mut rows, mut conflicts) = (Vec::new(), Vec::new());
    for found in lasting {
        match found.terms.first() {
            Some(own) if gone(own.row) => {}
            Some(own) if found.class != Class::Redundant && examined.model().drives(own.row) => {
                conflicts.push((own.constraint.clone(), found))
            }
            Some(own) => rows.push(own.row),
            None => {}
        }
    }
    conflicts.dedup_by(|a, b| a.0 == b.0);
    changes.extend(
        conflicts.into_iter().map(|(constraint, found)| Change::Remove { or: others(examined, &constraint, &[found]), constraint }),
    );
    changes.extend(leave_out(examined, &rows));
    let lasting = freedoms.iter().filter(|freedom| freedom.persistence == Persistence::Always);
    let names = &examined.model().layout.names;
    let turn = |name: &String| names.iter().position(|known| known == name).is_some_and(|k| examined.model().layout.units[k] == Unit::One);
    changes.extend(lasting.map(|freedom| Change::Drive {
        turn: turn(&freedom.coordinate),
        coordinate: freedom.coordinate.clone(),
        moves: freedom.motions.iter().flat_map(|motion| motion.names.iter().cloned()).collect(),
    }));
    changes
}

/// What closes a gap: less asked of a driver, one driver less, or another dimension.
fn for_gap(examined: &Examined<'_>, gap: &Gap, dependencies: &[Dependency]) -> Change {
    let model = examined.model();
    let constraint = gap.constraint.clone();
    if gap.rows.iter().all(|row| model.drives(*row)) {
        if !gap.lasting {
            return Change::Limit { constraint, asks: gap.asks.clone() };
        }
        let sets: Vec<&Dependency> =
            dependencies.iter().filter(|found| found.terms.iter().any(|term| gap.rows.contains(&term.row))).collect();
        return Change::Remove { or: others(examined, &constraint, &sets), constraint };
    }
    let own = |found: &Dependency| found.terms.first().map(|term| term.row).filter(|row| gap.rows.contains(row));
    let mut rows: Vec<usize> = dependencies.iter().filter_map(own).collect();
    rows.sort_unstable();
    let name = |row: &usize| model.equations.block_of(*row).map(|(block, local)| block.row(local).to_string());
    let or_drop = rows.iter().filter_map(name).collect();
    Change::Fit { constraint, missing: gap.size(), or_drop, of: gap.rows.len() }
}

/// What could be removed in place of a driver that is in conflict: other drivers; where there are none, joints of one row.
fn others(examined: &Examined<'_>, own: &str, sets: &[&Dependency]) -> Vec<String> {
    let names = |wanted: &dyn Fn(usize) -> bool| {
        let mut all: Vec<String> = Vec::new();
        for term in sets.iter().flat_map(|found| &found.terms).filter(|term| term.constraint != own && wanted(term.row)) {
            if !all.contains(&term.constraint) {
                all.push(term.constraint.clone());
            }
        }
        all
    };
    let model = examined.model();
    let drivers = names(&|row| model.drives(row));
    if !drivers.is_empty() {
        return drivers;
    }
    names(&|row| model.equations.block_of(row).is_some_and(|(block, _)| block.rows().len() == 1))
}

/// The rows by constraint.
fn leave_out(examined: &Examined<'_>, rows: &[usize]) -> Vec<Change> {
    let mut changes = Vec::new();
    for block in &examined.model().equations.blocks {
        let own: Vec<usize> = rows.iter().filter(|row| block.rows().contains(row)).map(|row| row - block.rows().start).collect();
        if own.is_empty() {
            continue;
        }
        let constraint = block.name.clone();
        changes.push(if own.len() == block.rows().len() {
            Change::Remove { constraint, or: Vec::new() }
        } else {
            let mut own = own;
            own.sort_unstable();
            let instead = instead(block.constraint.kind(), block.constraint.rows().len(), &own).map(str::to_string);
            Change::Drop { constraint, rows: own.iter().map(|local| block.row(*local).to_string()).collect(), instead }
        });
    }
    changes
}

/// The joint that is left when rows are taken from a planar one of the library.
fn instead(kind: &str, of: usize, rows: &[usize]) -> Option<&'static str> {
    match (kind, of, rows) {
        ("prismatic", 2, [0]) => Some("a point on a line"),
        ("prismatic", 2, [1]) => Some("a constraint of the angle alone"),
        ("revolute", 2, [_]) => Some("a point on a line"),
        _ => None,
    }
}
