//! Measures of joints by name: `JOINT.MEASURE`.

use std::f64::consts::TAU;

use crate::model::constraint::Measured;
use crate::model::error::{Error, Result};
use crate::solve::motion::{Motion, Quantity};
use crate::system::System;

/// One measure of one constraint.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    pub block: usize,
    pub number: usize,
    pub told: Measured,
}

impl System {
    /// Names of all measures of its joints, such as `slot.slide`, in the order of the constraints: what [`System::measure`] can be asked for
    /// beside coordinates.
    pub fn measures(&self) -> Vec<String> {
        self.constraints().flat_map(|(name, constraint)| constraint.measures().iter().map(move |m| format!("{name}.{}", m.name))).collect()
    }

    /// Where a measure is, by its name.
    pub(crate) fn place_of(&self, name: &str) -> Option<Place> {
        let (joint, measure) = name.rsplit_once('.')?;
        let (block, (_, constraint)) = self.constraints().enumerate().find(|(_, (known, _))| *known == joint)?;
        let number = constraint.measures().iter().position(|known| known.name == measure)?;
        Some(Place { block, number, told: constraint.measures()[number] })
    }

    /// The error for a name that no measure has: what can be asked of that joint, or of all.
    pub(crate) fn no_measure(&self, name: &str) -> Error {
        let joint = |name: &str| self.constraints().find(|(known, _)| *known == name);
        let Some((joint, constraint)) = joint(name).or_else(|| joint(name.rsplit_once('.')?.0)) else {
            let known = self.measures().into_iter().chain(self.coordinate_names().iter().cloned()).collect();
            return Error::UnknownName { what: "measure or coordinate", name: name.to_string(), known };
        };
        let known: Vec<String> = constraint.measures().iter().map(|measure| format!("`{joint}.{}`", measure.name)).collect();
        let reason = match known[..] {
            [] => {
                format!("there is no `{name}`: this joint has no measure. Ask for a point, an angle between bodies or a coordinate instead")
            }
            _ => format!("there is no `{name}`; what can be asked of this joint is {}", known.join(" and ")),
        };
        Error::InvalidConstraint { constraint: joint.to_string(), kind: constraint.kind().to_string(), reason }
    }

    /// An error unless the motion is one of this system.
    pub(crate) fn own(&self, motion: &Motion) -> Result<()> {
        let (expected, found) = (self.n_coordinates(), motion.names().len());
        match motion.names() == self.coordinate_names() {
            true => Ok(()),
            false => {
                Err(Error::WrongLength { what: format!("a motion of \"{}\", not of \"{}\"", motion.name(), self.name()), expected, found })
            }
        }
    }
}

/// The measure or coordinate of that name.
pub(super) fn named(system: &System, motion: &Motion, name: &str) -> Result<Quantity> {
    match system.place_of(name) {
        Some(place) => quantity(system, motion, name, place),
        None => motion.named(name).map_err(|_| system.no_measure(name)),
    }
}

/// The measure over time, with its rates.
fn quantity(system: &System, motion: &Motion, name: &str, place: Place) -> Result<Quantity> {
    let equations = system.equations();
    let block = &equations.blocks[place.block];
    let mut orders: [Vec<f64>; 4] = Default::default();
    let mut last: Option<(f64, [f64; 4])> = None;
    for (k, &t) in motion.times().iter().enumerate() {
        let mut x = equations.measure(block, place.number, t, motion.orders(k, 0..system.n_coordinates()));
        if let (true, Some((before, from))) = (place.told.turns, last) {
            x[0] += TAU * ((continued(from, x, t - before) - x[0]) / TAU).round();
        }
        if let Some(value) = x.iter().find(|x| !x.is_finite()) {
            return Err(Error::OutputNotFinite { output: name.to_string(), t, units: motion.unit_words().clone(), value: *value });
        }
        last = Some((t, x));
        let known = if motion.has_jerk() { 4 } else { 3 };
        orders.iter_mut().zip(x).take(known).for_each(|(order, x)| order.push(x));
    }
    Ok(Quantity::new(name, &motion.unit_words().told(place.told.unit), motion.clock(), orders))
}

/// x a step h later, from the rates at both ends.
fn continued(from: [f64; 4], to: [f64; 4], h: f64) -> f64 {
    from[0] + 0.5 * h * (from[1] + to[1]) + h * h / 12.0 * (from[2] - to[2])
}
