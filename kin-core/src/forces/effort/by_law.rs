//! Multipliers along the laws of a driver: λ · ∂C/∂f of each.

use super::unit_of_row;
use crate::forces::Forces;
use crate::model::coordinates::{Coordinate, Target};
use crate::model::formula::jerk::Along;
use crate::model::formula::laws::{are_rows, lengths, of_time, slopes};
use crate::model::formula::{Given, Outside, Table};
use crate::model::law::Law;
use crate::model::units::Unit;
use crate::system::evaluate::Block;

/// A slope nearer to −1 or 0 than this is rounded to it. \[-\]
const ROUNDED: f64 = 1e-9;

/// The factors of multipliers.
pub(super) enum Share {
    /// The factor −1 in this row of the driver, which is x(q) − f(t).
    Row(usize),
    /// ∂C/∂f of all rows of the driver, one list for each time.
    Law(Vec<Vec<f64>>),
}

/// One quantity that a driver prescribes.
pub(super) struct Led {
    pub name: String,
    /// The unit, `m` or `rad`; `None` if it is unknown.
    pub unit: Option<String>,
    pub share: Share,
}

impl Led {
    /// Returns all quantities of a driver.
    pub(super) fn all(forces: &Forces<'_>, block: &Block) -> Vec<Led> {
        let led = block.constraint.formula(|table, parameters, outside| {
            by_formula(forces, block, (table, parameters, outside))
        });
        led.flatten().unwrap_or_else(|| by_rows(forces, block))
    }

    /// Returns its share of multipliers, or of a vector of the null space, at time k.
    pub(super) fn of(&self, block: &Block, y: &[f64], k: usize) -> f64 {
        let own = &y[block.rows()];
        match &self.share {
            Share::Row(row) => 0.0 - own[*row],
            Share::Law(slopes) => slopes[k].iter().zip(own).map(|(slope, y)| slope * y).sum(),
        }
    }
}

fn by_rows(forces: &Forces<'_>, block: &Block) -> Vec<Led> {
    let led = |k: usize| {
        let unit = unit_of_row(forces.system, block, k);
        Led { name: block.equation(k), unit, share: Share::Row(k) }
    };
    (0..block.rows().len()).map(led).collect()
}

/// Returns `None` if the value of no law of time alone is known, or if each row is x(q) − f(t).
fn by_formula(
    forces: &Forces<'_>,
    block: &Block,
    (table, parameters, outside): (&Table, &[f64], Outside<'_>),
) -> Option<Vec<Led>> {
    let system = forces.system;
    let motion = forces.motion;
    let formula = table.formula();
    let equations = system.equations();
    let laws = of_time(formula).filter(|laws| !laws.is_empty() && !are_rows(formula, laws))?;
    let arguments = block.constraint.arguments();
    let at = |k: usize| {
        let instant = equations.instant_at(motion.times()[k], motion.q(k));
        let still = Along::still(&arguments, &equations.at(block, &instant), parameters, outside);
        slopes(formula, &laws, &still)
    };
    let all: Vec<Vec<Vec<f64>>> = (0..motion.len()).map(at).collect();
    let is_of_row = |law: usize, row: usize, slope: f64| {
        (slope + if law == row { 1.0 } else { 0.0 }).abs() < ROUNDED
    };
    let is_plain = |laws: &Vec<Vec<f64>>| {
        let all = laws.iter().enumerate();
        all.flat_map(|(law, rows)| {
            rows.iter().enumerate().map(move |(row, slope)| (law, row, *slope))
        })
        .all(|(law, row, slope)| is_of_row(law, row, slope))
    };
    if laws.len() == block.rows().len() && all.iter().all(is_plain) {
        return None;
    }
    let numbers: Vec<usize> = laws.iter().map(|(law, _)| *law).collect();
    let units = units(forces, block, (formula, &numbers));
    let names = names(forces, block, &numbers, outside);
    let led = |(k, (name, unit)): (usize, (String, Option<String>))| {
        let own = all.iter().map(|laws| laws[k].clone()).collect();
        Led { name, unit, share: Share::Law(own) }
    };
    Some(names.into_iter().zip(units).enumerate().map(led).collect())
}

/// Returns the units of laws from those of rows and coordinates.
fn units(
    forces: &Forces<'_>,
    block: &Block,
    (formula, laws): (&kin_graph::Formula, &[usize]),
) -> Vec<Option<String>> {
    let system = forces.system;
    let layout = forces.system.layout();
    let mut columns = Vec::new();
    for argument in block.constraint.arguments() {
        let own =
            layout.columns(&argument).into_iter().enumerate().map(|(k, column)| match column {
                Some(column) => f64::from(u8::from(layout.units[column] == Unit::Metre)),
                None => f64::from(u8::from(is_place(argument.target, k))),
            });
        columns.extend(own);
    }
    let of_row = |k: usize| match unit_of_row(system, block, k)?.as_str() {
        "m" => Some(1.0),
        "rad" | "-" | "–" => Some(0.0),
        _ => None,
    };
    let rows: Vec<Option<f64>> = (0..block.rows().len()).map(of_row).collect();
    let word = |length: Option<f64>| match length {
        Some(1.0) => Some("m".to_string()),
        Some(0.0) => Some("rad".to_string()),
        _ => None,
    };
    lengths(formula, laws, &columns, &rows).into_iter().map(word).collect()
}

/// Returns true if column k of the ground is a length: the position of a body precedes its
/// orientation.
fn is_place(target: Target, k: usize) -> bool {
    match target {
        Target::Planar(_) => k < 2,
        Target::Spatial(_) => k < 3,
        Target::Coord(Coordinate::Planar(_, axis), _) => axis < 2,
        Target::Coord(Coordinate::Spatial(_, axis), _) => axis < 3,
        Target::Coord(Coordinate::Own { .. }, _) => false,
    }
}

/// Returns `NAME.LAW` by the names of parameters, or the name of the driver if it has one law.
fn names(forces: &Forces<'_>, block: &Block, laws: &[usize], outside: Outside<'_>) -> Vec<String> {
    let motion = forces.motion;
    let equations = forces.system.equations();
    if laws.len() == 1 {
        return vec![block.name.clone()];
    }
    let mut told: Vec<(String, Law)> = Vec::new();
    if !motion.is_empty() {
        let instant = equations.instant_at(motion.times()[0], motion.q(0));
        block.constraint.laws(&equations.at(block, &instant), &mut |name, law, _| {
            told.push((name.to_string(), law.clone()));
        });
    }
    let mut name = |number: &usize| {
        let given = Given::by(outside, *number, &[]);
        let known = given.law().and_then(|law| told.iter().position(|(_, known)| known.is(law)));
        match known {
            Some(k) => format!("{}.{}", block.name, told.remove(k).0),
            None => format!("{}.law {}", block.name, number + 1),
        }
    };
    laws.iter().map(&mut name).collect()
}
