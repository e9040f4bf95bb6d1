//! The conditions under which a mechanism accepts a constraint.

use crate::coordinates::layout::{Layout, Place};
use crate::coordinates::{Argument, Target};
use crate::model::constraint::{Constraint, Entry};
use crate::outcome::error::surface::Surface;
use crate::outcome::error::{Error, Result};

/// Returns an error, by name, for parameters that are not finite or contradict each other, bodies
/// of other mechanisms, the same body or coordinate twice, rows without coordinates, and
/// hand-written constraints that contradict themselves.
pub(crate) fn admit(
    mechanism: &str,
    layout: &Layout,
    name: &str,
    constraint: &dyn Constraint,
) -> Result<()> {
    finite_parameters(name, constraint)?;
    sensible_parameters(name, constraint)?;
    let arguments = constraint.arguments();
    let places = places(mechanism, layout, name, &arguments)?;
    different(layout, name, &arguments, &places)?;
    consistent(name, constraint, &arguments)?;
    movable(name, constraint, &arguments, &places)
}

/// Returns an error for an energy in place of a constraint: its row is no equation.
pub(crate) fn holds(name: &str, constraint: &dyn Constraint) -> Result<()> {
    if !constraint.facts().is_energy {
        return Ok(());
    }
    let reason = format!("an energy is a load, not a constraint. {}", Surface::chosen().load());
    Err(Error::InvalidParameters {
        constraint: name.to_string(),
        kind: constraint.facts().kind.to_string(),
        reason,
    })
}

pub(crate) fn finite_parameters(name: &str, constraint: &dyn Constraint) -> Result<()> {
    let mut bad = None;
    constraint.parameters(&mut |parameter, value| {
        if !value.is_finite() && bad.is_none() {
            bad = Some((parameter.to_string(), value));
        }
    });
    match bad {
        Some((parameter, value)) => {
            Err(Error::ParameterNotFinite { constraint: name.to_string(), parameter, value })
        }
        None => Ok(()),
    }
}

/// Tests the constraint's conditions on its parameters (`#[require]`).
pub(crate) fn sensible_parameters(name: &str, constraint: &dyn Constraint) -> Result<()> {
    match constraint.refusal() {
        Some(reason) => Err(Error::InvalidParameters {
            constraint: name.to_string(),
            kind: constraint.facts().kind.to_string(),
            reason,
        }),
        None => Ok(()),
    }
}

fn places(
    mechanism: &str,
    layout: &Layout,
    name: &str,
    arguments: &[Argument],
) -> Result<Vec<Place>> {
    let place = |argument: &Argument| {
        layout.place(&argument.target).ok_or_else(|| Error::ForeignBody {
            mechanism: mechanism.to_string(),
            place: name.to_string(),
            argument: argument.name.to_string(),
        })
    };
    arguments.iter().map(place).collect()
}

/// Checks that no coordinate comes in through two arguments: a body twice, a coordinate twice, or a
/// body and one of its coordinates.
fn different(layout: &Layout, name: &str, arguments: &[Argument], places: &[Place]) -> Result<()> {
    let range = |k: usize| match places[k] {
        Place::Own { first, .. } => Some(first..first + arguments[k].target.columns()),
        Place::Ground(_) => None,
    };
    for second in 0..arguments.len() {
        for first in 0..second {
            let (Some(a), Some(b)) = (range(first), range(second)) else { continue };
            if a.start < b.end && b.start < a.end {
                let both_bodies = [first, second]
                    .iter()
                    .all(|&k| !matches!(arguments[k].target, Target::Coord(..)));
                let body = layout.owner(a.start).map(|item| item.name.clone()).unwrap_or_default();
                let coordinate =
                    layout.names.get(a.start.max(b.start)).cloned().unwrap_or_default();
                return Err(Error::RepeatedBody {
                    constraint: name.to_string(),
                    first: arguments[first].name.to_string(),
                    second: arguments[second].name.to_string(),
                    name: if both_bodies { body } else { coordinate },
                });
            }
        }
    }
    Ok(())
}

/// Checks that the rows and the pattern of a hand-written constraint fit each other.
fn consistent(name: &str, constraint: &dyn Constraint, arguments: &[Argument]) -> Result<()> {
    let columns: usize = arguments.iter().map(|argument| argument.target.columns()).sum();
    let facts = constraint.facts();
    let rows = facts.rows.len();
    let reason = if rows == 0 {
        "the constraint has no row".to_string()
    } else if let Some(Entry { row, column }) =
        facts.pattern.iter().find(|entry| entry.row >= rows || entry.column >= columns)
    {
        format!(
            "the pattern names row {row}, column {column}, but the constraint has {rows} rows and {columns} columns"
        )
    } else {
        return Ok(());
    };
    Err(Error::InvalidConstraint {
        constraint: name.to_string(),
        kind: constraint.facts().kind.to_string(),
        reason,
    })
}

/// Checks that every row has a coordinate that can move.
fn movable(
    name: &str,
    constraint: &dyn Constraint,
    arguments: &[Argument],
    places: &[Place],
) -> Result<()> {
    let own: Vec<bool> = arguments
        .iter()
        .zip(places)
        .flat_map(|(argument, place)| {
            std::iter::repeat_n(matches!(place, Place::Own { .. }), argument.target.columns())
        })
        .collect();
    let facts = constraint.facts();
    let rows = facts.rows;
    let moves = |row: usize| {
        facts
            .pattern
            .iter()
            .any(|entry| entry.row == row && own.get(entry.column).copied().unwrap_or(false))
    };
    let Some(row) = (0..rows.len()).find(|&row| !moves(row)) else { return Ok(()) };
    let grounded =
        arguments.iter().zip(places).filter(|(_, place)| matches!(place, Place::Ground(_)));
    let names: Vec<String> = grounded.map(|(argument, _)| format!("`{}`", argument.name)).collect();
    Err(Error::NoCoordinates {
        constraint: name.to_string(),
        row: if rows.len() == 1 { String::new() } else { rows[row].to_string() },
        reason: match names.as_slice() {
            [] => {
                "the row is empty in the pattern. List the columns in which C_q may differ from zero".to_string()
            }
            [one] => format!("{one} is the ground. Give the constraint a body that can move"),
            [rest @ .., last] => {
                format!(
                    "{} and {last} are the ground. Give the constraint a body that can move",
                    rest.join(", ")
                )
            }
        },
    })
}
