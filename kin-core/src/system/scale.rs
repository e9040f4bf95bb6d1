//! Characteristic sizes: what makes tolerances and ranks the same in mm, m and km.

use crate::model::layout::Layout;
use crate::model::units::Unit;
use crate::system::evaluate::Equations;

/// The characteristic size s_j of every coordinate: 1 for angles and Euler parameters, for lengths a typical
/// length of the model.
///
/// That length is found where the model itself compares lengths with angles: a row that moves by |∂C/∂R| a
/// metre and by |∂C/∂θ| a radian has the lever |∂C/∂θ| / |∂C/∂R|. The typical length is the median lever of
/// the constraints; without any, the largest link, else the largest length coordinate, else 1.
pub(crate) fn sizes(
    layout: &Layout,
    equations: &Equations,
    values: &[f64],
    q: &[f64],
    links: &[f64],
) -> Vec<f64> {
    let length = lever(layout, equations, values).unwrap_or_else(|| stated(layout, q, links));
    layout.units.iter().map(|unit| if *unit == Unit::Metre { length } else { 1.0 }).collect()
}

/// The median lever of the constraints that have one.
fn lever(layout: &Layout, equations: &Equations, values: &[f64]) -> Option<f64> {
    let mut levers: Vec<f64> = Vec::new();
    for block in &equations.blocks {
        let (mut per_length, mut per_angle) = (0.0_f64, 0.0_f64);
        let entries = equations.entries.get(block.values()).unwrap_or_default();
        for (entry, value) in entries.iter().zip(values.get(block.values()).unwrap_or_default()) {
            match entry.and_then(|(_, column)| layout.units.get(column)) {
                Some(Unit::Metre) => per_length = per_length.max(value.abs()),
                Some(_) => per_angle = per_angle.max(value.abs()),
                None => {}
            }
        }
        levers.push(per_angle / per_length);
    }
    levers.retain(|lever| lever.is_finite() && *lever > 0.0);
    let middle = levers.len() / 2;
    (middle < levers.len()).then(|| *levers.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The largest length that the model states.
fn stated(layout: &Layout, q: &[f64], links: &[f64]) -> f64 {
    let largest = |lengths: &mut dyn Iterator<Item = f64>| lengths.fold(0.0_f64, |m, x| m.max(x.abs()));
    let link = largest(&mut links.iter().copied());
    let coordinate =
        largest(&mut q.iter().zip(&layout.units).filter(|(_, unit)| **unit == Unit::Metre).map(|(q, _)| *q));
    [link, coordinate].into_iter().find(|length| *length > 0.0).unwrap_or(1.0)
}
