//! Measures of joints by name: `JOINT.MEASURE`.

use std::f64::consts::TAU;

use crate::model::error::{Error, OtherMotion, Result};
use crate::solve::motion::{Motion, Quantity};
use crate::system::System;
use crate::system::measures::MeasurePlace;
use crate::system::scale;

/// An equation that is further off than this share of its terms, and twice what it was when the motion was
/// computed, is one of another system.   \[-\]
const OFF: f64 = 1e-8;

impl System {
    /// An error unless the motion is one of this system.
    pub(crate) fn own(&self, motion: &Motion) -> Result<()> {
        let (expected, found) = (self.n_coordinates(), motion.names().len());
        match motion.names() == self.coordinate_names() {
            true => Ok(()),
            false => Err(Error::WrongLength {
                what: format!("a motion of \"{}\", not of \"{}\"", motion.name(), self.name()),
                expected,
                found,
            }),
        }
    }

    /// An error unless the motion is one of this system as it is now: its first, middle and last times are
    /// looked at.
    pub(crate) fn own_as_it_is(&self, motion: &Motion) -> Result<()> {
        self.own(motion)?;
        let last = motion.len().saturating_sub(1);
        [0, last / 2, last].into_iter().filter(|k| *k < motion.len()).try_for_each(|k| self.holds(motion, k))
    }

    /// An error where C = 0 does not hold at a time of the motion as far as it was told to.
    fn holds(&self, motion: &Motion, k: usize) -> Result<()> {
        let (t, q, told) = (motion.times()[k], motion.q(k), 2.0 * motion.residuals()[k]);
        // Where C or C_q is not finite something else is told.
        let Ok(point) = self.model().linearize(q, t) else { return Ok(()) };
        let equations = self.equations();
        let sizes = scale::sizes(self.layout(), equations, &point.values, q, self.links());
        let mut terms = vec![0.0; point.c.len()];
        for (entry, value) in equations.entries.iter().zip(&point.values) {
            if let Some((row, column)) = *entry {
                terms[row] += value.abs() * (q[column].abs() + sizes[column]);
            }
        }
        let is_off = |row: &usize| point.c[*row].abs() > told + OFF * terms[*row];
        match (0..point.c.len()).find(is_off) {
            None => Ok(()),
            Some(row) => Err(Box::new(OtherMotion {
                system: self.name().to_string(),
                equation: equations.equation(row),
                off: point.c[row].abs(),
                t,
                units: self.unit_words().clone(),
            })
            .into()),
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
fn quantity(system: &System, motion: &Motion, name: &str, place: MeasurePlace) -> Result<Quantity> {
    let equations = system.equations();
    let block = &equations.blocks[place.block];
    let mut orders: [Vec<f64>; 4] = Default::default();
    let mut last: Option<(f64, [f64; 4])> = None;
    for (k, &t) in motion.times().iter().enumerate() {
        let mut x = equations.measure(block, place.number, t, motion.orders(k, 0..system.n_coordinates()));
        if let (true, Some((before, from))) = (place.measured.turns, last) {
            x[0] += TAU * ((continued(from, x, t - before) - x[0]) / TAU).round();
        }
        if let Some(value) = x.iter().find(|x| !x.is_finite()) {
            return Err(Error::OutputNotFinite {
                output: name.to_string(),
                t,
                units: motion.unit_words().clone(),
                value: *value,
            });
        }
        last = Some((t, x));
        let known = if motion.has_jerk() { 4 } else { 3 };
        orders.iter_mut().zip(x).take(known).for_each(|(order, x)| order.push(x));
    }
    Ok(Quantity::new(name, &motion.unit_words().in_own_words(place.measured.unit), motion.clock(), orders))
}

/// x a step h later, from the rates at both ends.
fn continued(from: [f64; 4], to: [f64; 4], h: f64) -> f64 {
    from[0] + 0.5 * h * (from[1] + to[1]) + h * h / 12.0 * (from[2] - to[2])
}
