//! The drivers of a follower: the laws of time whose values it moves.

use nalgebra::{DMatrix, DVector};

use crate::ask::follower::frozen::Frozen;
use crate::ask::follower::path::Path;
use crate::law::Law;
use crate::model::formula::laws;
use crate::outcome::named_value::NamedValue;
use crate::system::System;
use crate::system::evaluate::Block;

/// One law of time of a driver.
#[derive(Clone, Debug)]
pub(super) struct Driver {
    /// The place of the constraint among all constraints.
    pub block: usize,
    /// The parameter of the constraint that is the law.
    pub parameter: String,
    /// The name, unit and value.
    pub value: NamedValue,
    /// The law that the constraint reads.
    pub path: Path,
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
    install(&mut drivers, system);
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
        let path = Path::at(value);
        Some(Driver { block: k, parameter, value: NamedValue { name, unit, value }, path })
    };
    let found: Option<Vec<Driver>> =
        names.into_iter().zip(units).zip(parameters).map(driver).collect();
    let settable = |driver: &Driver| {
        block.constraint.clone_boxed().set_law(&driver.parameter, &Law::constant(0.0))
    };
    found.filter(|found| found.iter().all(settable)).unwrap_or_default()
}

/// Gives each driver a law that it shares with no other system, at rest at its value.
pub(super) fn install(drivers: &mut [Driver], system: &mut System) {
    for driver in drivers {
        driver.path = Path::at(driver.value.value);
        system.set_law(driver.block, &driver.parameter, &driver.path.law());
    }
}

impl Driver {
    /// Returns the law of the driver in a system at time t0 and pose q.
    pub(super) fn law(&self, system: &System, (t0, q): (f64, &[f64])) -> Option<Law> {
        let block = system.equations().blocks.get(self.block)?;
        let instant = system.equations().instant_at(t0, q);
        let mut found = None;
        block.constraint.laws(&system.equations().at(block, &instant), &mut |name, law, _| {
            if name == self.parameter {
                found = Some(law.clone());
            }
        });
        found
    }

    /// Gives the driver another law in a system.
    pub(super) fn replace(&self, system: &mut System, law: &Law) {
        system.set_law(self.block, &self.parameter, law);
    }

    /// Takes the driver to rest at its value.
    pub(super) fn rest(&self) {
        self.path.lead([self.value.value, 0.0, 0.0]);
    }

    /// Lets the driver run at this velocity, from its value at time 0.
    pub(super) fn run(&self, velocity: f64) {
        self.path.lead([self.value.value, velocity, 0.0]);
    }
}

/// The values of the laws of one constraint at a position, and how the rows depend on them.
pub(super) struct Laws {
    pub values: Vec<f64>,
    /// C_u: one row for each equation, one column for each law.
    pub c_u: DMatrix<f64>,
}

/// Sets the values of drivers to those that they have at the position q, near their present ones.
/// A driver whose equation no value satisfies keeps its value.
pub(super) fn values_at(drivers: &mut [Driver], system: &System, q: &[f64]) {
    let mut blocks: Vec<usize> = drivers.iter().map(|driver| driver.block).collect();
    blocks.dedup();
    for block in blocks {
        let mut own: Vec<&mut Driver> =
            drivers.iter_mut().filter(|driver| driver.block == block).collect();
        let laws: Vec<(&str, f64)> =
            own.iter().map(|driver| (driver.parameter.as_str(), driver.value.value)).collect();
        if let Some(Laws { values, .. }) = laws_at(system, block, &laws, q) {
            own.iter_mut().zip(values).for_each(|(driver, value)| driver.value.value = value);
        }
    }
}

/// Returns the values of the laws of a constraint with which it is satisfied at q, by Newton's
/// method from these values.
pub(super) fn laws_at(
    system: &System,
    block: usize,
    laws: &[(&str, f64)],
    q: &[f64],
) -> Option<Laws> {
    const STEPS: usize = 30;
    let block = &system.equations().blocks[block];
    let instant = system.equations().instant_at(0.0, q);
    // Numbers that the constraint has computed from other laws do not count.
    let at = system.equations().at(block, &instant).with_timed(&[]);
    let rows = block.rows().len();
    let mut constraint = block.constraint.clone();
    let mut values: Vec<f64> = laws.iter().map(|(_, value)| *value).collect();
    for _ in 0..STEPS {
        let mut c = DVector::zeros(rows);
        let mut c_u = DMatrix::zeros(rows, laws.len());
        for k in 0..laws.len() {
            for (j, (parameter, _)) in laws.iter().enumerate() {
                let rate = if j == k { 1.0 } else { 0.0 };
                constraint.set_law(parameter, &Law::polynomial(&[values[j], rate]));
            }
            let mut rhs = vec![0.0; rows];
            constraint.velocity_rhs(&at, &mut rhs);
            rhs.iter().enumerate().for_each(|(row, rhs)| c_u[(row, k)] = -rhs);
        }
        constraint.residual(&at, c.as_mut_slice());
        let step = least_squares(&c_u, &c)?;
        let mut large = false;
        for (value, step) in values.iter_mut().zip(step.iter()) {
            *value -= step;
            large |= step.abs() > 32.0 * f64::EPSILON * value.abs().max(1.0);
        }
        if values.iter().any(|value| !value.is_finite()) {
            return None;
        }
        if !large {
            return Some(Laws { values, c_u });
        }
    }
    None
}

/// Returns x with the least |A x − b|, for a matrix A with independent columns.
pub(super) fn least_squares(a: &DMatrix<f64>, b: &DVector<f64>) -> Option<DVector<f64>> {
    if a.iter().chain(b.iter()).any(|x| !x.is_finite()) {
        return None;
    }
    if let (1, 1) = a.shape() {
        return (a[0] != 0.0).then(|| b / a[0]);
    }
    let qr = a.clone().qr();
    qr.r().solve_upper_triangular(&(qr.q().transpose() * b))
}
