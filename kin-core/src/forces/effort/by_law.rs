//! Computes the effort λ · ∂C/∂f of each law of a driver.

use crate::forces::Forces;
use crate::model::formula::jerk::Along;
use crate::model::formula::laws::{are_rows, of_time, slopes};
use crate::model::formula::{Outside, Table};
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
        let unit = forces.system.unit_of_row(block, k);
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
    let units = system.units_of_laws(block, formula, &numbers);
    let start = (!motion.is_empty()).then(|| (motion.times()[0], motion.q(0)));
    let names = system.names_of_laws(block, start, &numbers, outside);
    let led = |(k, (name, unit)): (usize, (String, Option<String>))| {
        let own = all.iter().map(|laws| laws[k].clone()).collect();
        Led { name, unit, share: Share::Law(own) }
    };
    Some(names.into_iter().zip(units).enumerate().map(led).collect())
}
