//! One number over time.

use crate::model::units::Units;

/// One number over time, with its name and unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    name: String,
    unit: String,
    units: Units,
    times: Vec<f64>,
    values: Vec<f64>,
}

impl Series {
    /// Values in `unit` at times in the unit that `units` calls it by.
    pub(crate) fn new(
        name: impl Into<String>,
        unit: impl Into<String>,
        (times, units): (&[f64], &Units),
        values: Vec<f64>,
    ) -> Self {
        Series { name: name.into(), unit: unit.into(), units: units.clone(), times: times.to_vec(), values }
    }

    pub(crate) fn rename(&mut self, name: String) {
        self.name = name;
    }

    pub(crate) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// Its name, such as `crank.theta'`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its unit, such as `rad/s`.
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// The times.   \[s\]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Names of the units of length and time; the times are in the latter.
    pub fn unit_words(&self) -> &Units {
        &self.units
    }

    /// One value a time.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The largest value; NaN of an empty series.
    pub fn max(&self) -> f64 {
        self.best(|a, b| a > b).map_or(f64::NAN, |k| self.values[k])
    }

    /// The smallest value; NaN of an empty series.
    pub fn min(&self) -> f64 {
        self.best(|a, b| a < b).map_or(f64::NAN, |k| self.values[k])
    }

    /// The time of the largest value, the first one of several; NaN of an empty series.   \[s\]
    pub fn at_max(&self) -> f64 {
        self.best(|a, b| a > b).map_or(f64::NAN, |k| self.times[k])
    }

    /// The time of the smallest value, the first one of several; NaN of an empty series.   \[s\]
    pub fn at_min(&self) -> f64 {
        self.best(|a, b| a < b).map_or(f64::NAN, |k| self.times[k])
    }

    /// Index of the first value that no other is better than.
    fn best(&self, better: impl Fn(f64, f64) -> bool) -> Option<usize> {
        (0..self.values.len().min(self.times.len()))
            .reduce(|best, k| if better(self.values[k], self.values[best]) { k } else { best })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_and_their_times() {
        let series =
            Series::new("x", "m", (&[0.0, 1.0, 2.0, 3.0], &Units::default()), vec![1.0, 5.0, -2.0, 5.0]);
        assert_eq!((series.max(), series.at_max(), series.min(), series.at_min()), (5.0, 1.0, -2.0, 2.0));
        assert!(Series::new("x", "m", (&[], &Units::default()), vec![]).max().is_nan());
    }
}
