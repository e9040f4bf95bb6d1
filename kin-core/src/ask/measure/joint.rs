//! Computes measures of joints by name: `JOINT.MEASURE`.

use std::f64::consts::TAU;

use crate::outcome::error::{Error, Result};
use crate::solve::motion::{Motion, Quantity};
use crate::system::System;
use crate::system::measures::MeasurePlace;

/// Returns the measure or coordinate with this name.
pub(super) fn named(system: &System, motion: &Motion, name: &str) -> Result<Quantity> {
    match system.place_of(name) {
        Some(place) => quantity(system, motion, name, place),
        None => motion.named(name).map_err(|_| system.no_measure(name)),
    }
}

/// Returns the measure over time, with its derivatives.
fn quantity(system: &System, motion: &Motion, name: &str, place: MeasurePlace) -> Result<Quantity> {
    let equations = system.equations();
    let block = &equations.blocks[place.block];
    let mut orders: [Vec<f64>; 4] = Default::default();
    let mut last: Option<(f64, [f64; 4])> = None;
    for (k, &t) in motion.times().iter().enumerate() {
        let mut x =
            equations.measure(block, place.number, t, motion.orders(k, 0..system.n_coordinates()));
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
    Ok(Quantity::new(
        name,
        &motion.unit_words().in_own_words(place.measured.unit),
        motion.clock(),
        orders,
    ))
}

/// Extrapolates x by a step h, from the derivatives at both ends.
fn continued(from: [f64; 4], to: [f64; 4], h: f64) -> f64 {
    from[0] + 0.5 * h * (from[1] + to[1]) + h * h / 12.0 * (from[2] - to[2])
}
