//! Stores one quantity over time.

use std::sync::Arc;

use crate::coordinates::units::Units;

/// One quantity over time, with its name and unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    name: String,
    unit: String,
    units: Units,
    times: Arc<[f64]>,
    values: Vec<f64>,
}

impl Series {
    /// Creates a series of values in `unit`, at times in the time unit of `units`.
    pub(crate) fn new(
        name: impl Into<String>,
        unit: impl Into<String>,
        (times, units): (&[f64], &Units),
        values: Vec<f64>,
    ) -> Self {
        Series {
            name: name.into(),
            unit: unit.into(),
            units: units.clone(),
            times: times.into(),
            values,
        }
    }

    /// Creates a series of other values at the same times.
    pub(crate) fn beside(
        &self,
        name: impl Into<String>,
        unit: impl Into<String>,
        values: Vec<f64>,
    ) -> Self {
        let units = self.units.clone();
        let times = self.times.clone();
        Series { name: name.into(), unit: unit.into(), units, times, values }
    }

    pub(crate) fn rename(&mut self, name: String) {
        self.name = name;
    }

    pub(crate) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// Returns the name, such as `crank.theta'`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the unit, such as `rad/s`.
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// Returns the times. \[s\]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Returns the names of the units of length and time.
    pub fn unit_words(&self) -> &Units {
        &self.units
    }

    /// Returns the values, one for each time.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Returns the largest value, or NaN for an empty series.
    pub fn max(&self) -> f64 {
        self.best(|a, b| a > b).map_or(f64::NAN, |k| self.values[k])
    }

    /// Returns the smallest value, or NaN for an empty series.
    pub fn min(&self) -> f64 {
        self.best(|a, b| a < b).map_or(f64::NAN, |k| self.values[k])
    }

    /// Returns the first time at which the series has its largest value, or NaN for an empty
    /// series. \[s\]
    pub fn at_max(&self) -> f64 {
        self.best(|a, b| a > b).map_or(f64::NAN, |k| self.times[k])
    }

    /// Returns the first time at which the series has its smallest value, or NaN for an empty
    /// series. \[s\]
    pub fn at_min(&self) -> f64 {
        self.best(|a, b| a < b).map_or(f64::NAN, |k| self.times[k])
    }

    /// Returns the root mean square over time, √(1/T ∫ x² dt), by the trapezoidal rule.
    ///
    /// The heating of a motor depends on this value. The result is NaN for an empty series.
    pub fn rms(&self) -> f64 {
        let all: Vec<(f64, f64)> =
            self.times.iter().copied().zip(self.values.iter().copied()).collect();
        match all[..] {
            [] => f64::NAN,
            [(_, x)] => x.abs(),
            [(from, _), .., (to, _)] => {
                let area = |two: &[(f64, f64)]| {
                    0.5 * (two[1].0 - two[0].0) * (two[0].1 * two[0].1 + two[1].1 * two[1].1)
                };
                (all.windows(2).map(area).sum::<f64>() / (to - from)).sqrt()
            }
        }
    }

    /// Returns the index of the first value such that no other value is better.
    pub(crate) fn best(&self, better: impl Fn(f64, f64) -> bool) -> Option<usize> {
        (0..self.values.len().min(self.times.len()))
            .reduce(|best, k| if better(self.values[k], self.values[best]) { k } else { best })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn root_mean_squares_are_those_of_time() {
        let rms = |times: &[f64], values: &[f64]| {
            Series::new("x", "m", (times, &Units::default()), values.to_vec()).rms()
        };
        // 3 for one second, 1 for three of them, backwards too; squares are joined by lines.
        let times = [0.0, 1.0, 1.0 + 1e-12, 4.0];
        let values = [3.0, -3.0, 1.0, 1.0];
        assert!((rms(&times, &values) - 3.0_f64.sqrt()).abs() < 1e-9);
        assert!((rms(&times.map(|t| -t), &values) - 3.0_f64.sqrt()).abs() < 1e-9);
        let sine: Vec<f64> =
            (0..=40).map(|k| 2.0 * (f64::from(k) * 0.05 * std::f64::consts::PI).sin()).collect();
        let times: Vec<f64> = (0..=40).map(f64::from).collect();
        assert!((rms(&times, &sine) - 2.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(rms(&[7.0], &[-4.0]), 4.0);
        assert!(rms(&[], &[]).is_nan());
    }

    #[test]
    fn extremes_and_their_times() {
        let series = Series::new(
            "x",
            "m",
            (&[0.0, 1.0, 2.0, 3.0], &Units::default()),
            vec![1.0, 5.0, -2.0, 5.0],
        );
        assert_eq!(
            (series.max(), series.at_max(), series.min(), series.at_min()),
            (5.0, 1.0, -2.0, 2.0)
        );
        assert!(Series::new("x", "m", (&[], &Units::default()), vec![]).max().is_nan());
    }
}
