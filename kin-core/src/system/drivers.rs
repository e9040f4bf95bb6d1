//! The numbers that drivers prescribe, the values of their laws of time: names and units.

use kin_graph::Formula;

use super::System;
use super::evaluate::{Block, Equations};
use crate::coordinates::layout::Layout;
use crate::coordinates::units::Unit;
use crate::coordinates::{Coordinate, Target};
use crate::law::Law;
use crate::model::constraint::Constraint;
use crate::model::formula::laws::lengths;
use crate::model::formula::{Given, Outside};

/// A constraint with its name.
type Named = (String, Box<dyn Constraint>);

/// Returns the unit of the coordinate of a constraint that acts on one coordinate only.
fn unit_of_coordinate(layout: &Layout, block: &Block) -> Option<String> {
    let arguments = block.constraint.arguments();
    let [only] = arguments.as_slice() else { return None };
    let Target::Coord(..) = only.target else { return None };
    let column = layout.columns(only).first().copied().flatten()?;
    Some(match layout.units[column] {
        Unit::Metre => "m".to_string(),
        Unit::Radian => "rad".to_string(),
        Unit::One => "-".to_string(),
    })
}

/// Returns the units in the documentation of a constraint: `[m]`, `[rad, m]`.
fn documented_units(block: &Block) -> Option<Vec<String>> {
    let facts = block.constraint.facts();
    let text = facts.description.split("\n\n").next()?.replace('\\', "");
    let (_, after) = text.rsplit_once('[')?;
    Some(after.split(']').next()?.split(',').map(|word| word.trim().to_string()).collect())
}

/// Returns the unit of each row of a constraint; `None` where it is unknown. The documentation
/// gives one unit for all rows, one for each row, or one for each part of the result, such as
/// `[m, –]` for the rows `point.x`, `point.y`, `point.z` and `turn`.
pub(crate) fn units_of_rows(layout: &Layout, block: &Block) -> Vec<Option<String>> {
    let rows = block.constraint.facts().rows;
    if let Some(unit) = unit_of_coordinate(layout, block) {
        return vec![Some(unit); rows.len()];
    }
    let units = documented_units(block).unwrap_or_default();
    let mut part = 0;
    let parts: Vec<usize> = (0..rows.len())
        .map(|k| {
            let vector = |row: &str| row.rsplit_once('.').map(|(name, _)| name.to_string());
            let is_new =
                k > 0 && (vector(rows[k]).is_none() || vector(rows[k]) != vector(rows[k - 1]));
            part += usize::from(is_new);
            part
        })
        .collect();
    let of_row = |k: usize| match units.len() {
        1 => units.first().cloned(),
        all if all == rows.len() => units.get(k).cloned(),
        all if all == part + 1 => units.get(parts[k]).cloned(),
        _ => None,
    };
    (0..rows.len()).map(of_row).collect()
}

impl System {
    /// Replaces one law of a constraint. Returns false if the constraint has no law with this name.
    pub(crate) fn set_law(&mut self, block: usize, parameter: &str, law: &Law) -> bool {
        self.forget_derived();
        self.equations.blocks[block].constraint.set_law(parameter, law)
    }

    /// Replaces a constraint by one with the same facts.
    pub(crate) fn change_constraint(
        &mut self,
        block: usize,
        change: impl FnOnce(Box<dyn Constraint>) -> Box<dyn Constraint>,
    ) {
        self.forget_derived();
        let place = &mut self.equations.blocks[block].constraint;
        *place = change(place.clone());
    }

    /// Returns the system without the constraints with these indices, and with others in place of
    /// the first one. Dimensions and preferred measures are left out: the copy is not assembled
    /// again.
    pub(crate) fn with_others(&self, out: &[usize], others: Vec<Named>) -> System {
        let first = out.iter().min().copied();
        let norms = |block: &Block| block.constraint.facts().kind == "euler_norm";
        let all = &self.equations.blocks;
        let place = first.or_else(|| all.iter().position(norms)).unwrap_or(all.len());
        let kept = |range: std::ops::Range<usize>| {
            let kept = range.filter(|k| !out.contains(k)).map(|k| &all[k]);
            kept.map(|block| (block.name.clone(), block.constraint.clone()))
        };
        let constraints: Vec<Named> =
            kept(0..place).chain(others).chain(kept(place..all.len())).collect();
        let layout = (*self.layout).clone();
        let equations = Equations::new(&layout, constraints);
        let mut system = System::new(
            self.name.clone(),
            layout,
            equations,
            self.initial.clone(),
            self.preferred.clone(),
        );
        system.lengths.clone_from(&self.lengths);
        system.links.clone_from(&self.links);
        system.loads.clone_from(&self.loads);
        let limits = self.limits.iter().filter(|limit| system.is_measure(&limit.name));
        system.limits = limits.cloned().collect();
        system
    }

    /// Returns the unit of row k of a constraint from its documentation (`[m]`, `[rad, m]`), or
    /// from the coordinate that it drives.
    pub(crate) fn unit_of_row(&self, block: &Block, k: usize) -> Option<String> {
        unit_of_coordinate(self.layout(), block).or_else(|| {
            let units = documented_units(block)?;
            units.get(if units.len() == 1 { 0 } else { k }).cloned()
        })
    }

    /// Returns the units of the laws with these indices, from those of rows and coordinates: `m`,
    /// `rad`, or `None` if the unit is unknown.
    pub(crate) fn units_of_laws(
        &self,
        block: &Block,
        formula: &Formula,
        laws: &[usize],
    ) -> Vec<Option<String>> {
        let layout = self.layout();
        let mut columns = Vec::new();
        for argument in block.constraint.arguments() {
            let own =
                layout.columns(&argument).into_iter().enumerate().map(|(k, column)| match column {
                    Some(column) => f64::from(u8::from(layout.units[column] == Unit::Metre)),
                    None => f64::from(u8::from(is_place(argument.target, k))),
                });
            columns.extend(own);
        }
        let of_row = |k: usize| match self.unit_of_row(block, k)?.as_str() {
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

    /// Returns the names of the laws with these indices: `NAME.LAW` by the names of parameters, or
    /// the name of the driver if there is one law. `start` is a time and a pose at which Kin looks.
    pub(crate) fn names_of_laws(
        &self,
        block: &Block,
        start: Option<(f64, &[f64])>,
        laws: &[usize],
        outside: Outside<'_>,
    ) -> Vec<String> {
        if laws.len() == 1 {
            return vec![block.name.clone()];
        }
        self.parameters_of_laws(block, start, laws, outside)
            .into_iter()
            .zip(laws)
            .map(|(parameter, number)| match parameter {
                Some(parameter) => format!("{}.{parameter}", block.name),
                None => format!("{}.law {}", block.name, number + 1),
            })
            .collect()
    }

    /// Returns the parameters of the constraint that are the laws with these indices.
    pub(crate) fn parameters_of_laws(
        &self,
        block: &Block,
        start: Option<(f64, &[f64])>,
        laws: &[usize],
        outside: Outside<'_>,
    ) -> Vec<Option<String>> {
        let mut known: Vec<(String, Law)> = Vec::new();
        if let Some((t, q)) = start {
            let instant = self.equations().instant_at(t, q);
            block.constraint.laws(&self.equations().at(block, &instant), &mut |name, law, _| {
                known.push((name.to_string(), law.clone()));
            });
        }
        let mut parameter = |number: &usize| {
            let given = Given::by(outside, *number, &[]);
            let place =
                given.law().and_then(|law| known.iter().position(|(_, one)| one.is(law)))?;
            Some(known.remove(place).0)
        };
        laws.iter().map(&mut parameter).collect()
    }
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
