//! Computes the distance of a pose from preferred values, and finds the nearest assembly if the
//! preferences are measures of joints.

use super::modes;
use super::options::SearchOptions;
use super::{Assembly, AssemblyOptions};
use crate::coordinates::layout::{Kind, Layout};
use crate::coordinates::units::Unit;
use crate::outcome::error::Result;
use crate::system::{PreferredMeasure, System};

/// If an assembly is this close to all preferred values, Kin does not search others. \[rad, or
/// typical lengths\]
const CLOSE: f64 = 1e-3;

/// Returns the distance of the worst preferred coordinate from its value: in radians for angles and
/// Euler parameters, otherwise relative to its size.
pub(crate) fn distance(
    layout: &Layout,
    preferred: &[(usize, f64)],
    q: &[f64],
    sizes: &[f64],
) -> f64 {
    let turns = layout.items.iter().filter(|item| item.kind == Kind::Spatial).map(|item| {
        let own = item.first + 3..item.first + 7;
        let pairs = || {
            preferred
                .iter()
                .filter(|(column, _)| own.contains(column))
                .map(|&(column, value)| (q[column], value))
        };
        // p and −p are one orientation; |p − p0| is about half of the angle between them.
        let sign = if pairs().map(|(q, value)| q * value).sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
        2.0 * pairs().map(|(q, value)| (sign * q - value).powi(2)).sum::<f64>().sqrt()
    });
    let others = preferred.iter().filter(|(column, _)| layout.units[*column] != Unit::One);
    others
        .map(|&(column, value)| (q[column] - value).abs() / sizes[column])
        .chain(turns)
        .fold(0.0, f64::max)
}

/// Returns the difference of two numbers, for angles without full revolutions.
pub(crate) fn apart(x: f64, value: f64, is_angle: bool) -> f64 {
    let d = x - value;
    if is_angle {
        (d - std::f64::consts::TAU * (d / std::f64::consts::TAU).round()).abs()
    } else {
        d.abs()
    }
}

impl System {
    /// Stores preferred measures by name. Errors: a name that nothing has.
    pub(crate) fn set_asked(&mut self, all: &[(String, f64)]) -> Result<()> {
        for (name, value) in all {
            if let Some(column) = self.coordinate_names().iter().position(|known| known == name) {
                self.prefer_column(column, *value);
                continue;
            }
            let place = self.place_of(name).ok_or_else(|| self.no_measure(name))?;
            let is_angle = place.measured.turns || place.measured.unit == "rad";
            self.asked.push(PreferredMeasure {
                block: place.block,
                number: place.number,
                is_angle,
                value: *value,
            });
        }
        Ok(())
    }

    /// Returns `None` if no measure is preferred, or if the pose is close enough to the preferred
    /// measures. Otherwise returns the assembly that is nearest to all preferred values.
    pub(crate) fn nearer(
        &self,
        q: Option<&[f64]>,
        t: f64,
        search: &SearchOptions,
    ) -> Option<Vec<f64>> {
        if self.asked.is_empty() || q.is_some_and(|q| self.is_close(q, t)) {
            return None;
        }
        let options = AssemblyOptions::new().seed(search.seed).time_limit(search.time_limit);
        let all = modes::all(self.model(), self.initial(), t, &options).ok()?;
        let all = all.into_iter().map(|Assembly { q, .. }| (self.far(&q, t), q));
        let nearest = all.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map(|(_, q)| q)
    }

    fn is_close(&self, q: &[f64], t: f64) -> bool {
        self.far(q, t) <= CLOSE
    }

    /// Returns the distance of the worst preferred value.
    fn far(&self, q: &[f64], t: f64) -> f64 {
        let sizes = self.model().measure(q, t).sizes;
        let length = self
            .layout()
            .units
            .iter()
            .zip(&sizes)
            .filter(|(unit, _)| **unit == Unit::Metre)
            .map(|(_, size)| *size)
            .fold(0.0, f64::max);
        let still = vec![0.0; q.len()];
        let measures = self.asked.iter().filter_map(|asked| {
            let block = self.equations().blocks.get(asked.block)?;
            let [x, ..] =
                self.equations().measure(block, asked.number, t, [q, &still, &still, &[]]);
            let unit = if asked.is_angle || length == 0.0 { 1.0 } else { length };
            Some(apart(x, asked.value, asked.is_angle) / unit)
        });
        measures.fold(distance(self.layout(), self.preferred(), q, &sizes), f64::max)
    }
}
