//! The drivers of a follower: the laws of time whose values it moves.

use crate::ask::follower::frozen::Frozen;
use crate::law::Law;
use crate::model::formula::laws;
use crate::outcome::named_value::NamedValue;
use crate::system::System;
use crate::system::evaluate::Block;

/// One law of time of a driver.
#[derive(Clone, Debug)]
pub(super) struct Driver {
    /// The place of the constraint among all constraints.
    block: usize,
    /// The parameter of the constraint that is the law.
    parameter: String,
    /// The name, unit and value.
    pub value: NamedValue,
}

/// Finds the drivers of a system at time t0 and pose q, and freezes time in all other constraints.
/// Returns the drivers and the names of the constraints in which time stands still.
pub(super) fn take(system: &mut System, t0: f64, q: &[f64]) -> (Vec<Driver>, Vec<String>) {
    let mut drivers = Vec::new();
    let mut frozen = Vec::new();
    for k in 0..system.equations().blocks.len() {
        let block = &system.equations().blocks[k];
        if !block.constraint.facts().dependence.c_on_t {
            continue;
        }
        let found = of_block(system, block, k, (t0, q));
        if found.is_empty() {
            frozen.push(block.name.clone());
            system.change_constraint(k, |inner| Box::new(Frozen { inner, t0 }));
        }
        drivers.extend(found);
    }
    for driver in &drivers {
        driver.set(system, Law::constant(driver.value.value));
    }
    (drivers, frozen)
}

/// Returns the laws of time of one constraint, or none if it reads time in another way too.
fn of_block(system: &System, block: &Block, k: usize, (t0, q): (f64, &[f64])) -> Vec<Driver> {
    let start = Some((t0, q));
    let known = block.constraint.formula(|table, _, outside| {
        let formula = table.formula();
        let numbers = laws::alone(formula)?;
        let names = system.names_of_laws(block, start, &numbers, outside);
        let units = system.units_of_laws(block, formula, &numbers);
        let parameters: Option<Vec<String>> =
            system.parameters_of_laws(block, start, &numbers, outside).into_iter().collect();
        Some((names, units, parameters?))
    });
    let Some((names, units, parameters)) = known.flatten() else { return Vec::new() };
    let mut values = Vec::new();
    let instant = system.equations().instant_at(t0, q);
    block.constraint.laws(&system.equations().at(block, &instant), &mut |name, law, _| {
        values.push((name.to_string(), law.at(t0)));
    });
    let driver = |((name, unit), parameter): ((String, Option<String>), String)| {
        let value = values.iter().find(|(known, _)| *known == parameter)?.1;
        let unit = unit.map(|unit| system.unit_words().in_own_words(&unit).to_string());
        Some(Driver { block: k, parameter, value: NamedValue { name, unit, value } })
    };
    let found: Option<Vec<Driver>> =
        names.into_iter().zip(units).zip(parameters).map(driver).collect();
    let settable = |driver: &Driver| {
        block.constraint.clone_boxed().set_law(&driver.parameter, &Law::constant(0.0))
    };
    found.filter(|found| found.iter().all(settable)).unwrap_or_default()
}

impl Driver {
    /// Replaces the law of the driver.
    pub(super) fn set(&self, system: &mut System, law: Law) {
        system.set_law(self.block, &self.parameter, &law);
    }
}
