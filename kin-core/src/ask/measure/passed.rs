//! Finds the times at which a series passes a value.

use super::Crossing;
use crate::outcome::motion::Series;

impl Series {
    /// Returns the times at which the series passes a value, by linear interpolation between its
    /// times.
    ///
    /// Use this function for the time at which a drive begins to brake, or at which a pin lifts.
    /// For a measure use [`crate::System::crossings`], which solves poses instead of interpolating.
    /// A series that reaches the value and returns to the same side does not pass the value.
    pub fn crossings(&self, value: f64) -> Vec<Crossing> {
        let times = self.times();
        let mut all = Vec::new();
        // The last time with a value off the level. Between it and the next one, values on the
        // level may follow.
        let mut last: Option<(usize, f64)> = None;
        for (k, off) in self.values().iter().map(|x| x - value).enumerate().take(times.len()) {
            if off == 0.0 || off.is_nan() {
                continue;
            }
            if let Some((before, from)) = last
                && (from < 0.0) != (off < 0.0)
            {
                let on = before + 1 < k;
                let share = if on { 1.0 } else { from / (from - off) };
                let t0 = times[before];
                let t1 = times[before + 1];
                let rises = (off > 0.0) == (times[k] > t0);
                all.push(Crossing { t: t0 + share * (t1 - t0), rises });
            }
            last = Some((k, off));
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coordinates::units::Units;

    fn crossings(times: &[f64], values: &[f64], level: f64) -> Vec<(f64, bool)> {
        let series = Series::new("x", "N", (times, &Units::default()), values.to_vec());
        series.crossings(level).into_iter().map(|one| (one.t, one.rises)).collect()
    }

    #[test]
    fn values_are_passed_once_and_on_the_way_of_time() {
        let times = [0.0, 1.0, 2.0, 4.0, 5.0];
        assert_eq!(
            crossings(&times, &[-1.0, 1.0, 3.0, -1.0, 0.0], 0.0),
            [(0.5, true), (3.5, false)]
        );
        // On the level at a time, at two times, and touched.
        assert_eq!(crossings(&times, &[-1.0, 0.0, 3.0, 0.0, 2.0], 0.0), [(1.0, true)]);
        assert_eq!(crossings(&times, &[5.0, 2.0, 2.0, 1.0, 1.5], 2.0), [(1.0, false)]);
        let back = times.map(|t| -t);
        assert_eq!(crossings(&back, &[-1.0, 1.0, 3.0, 3.0, 3.0], 0.0), [(-0.5, false)]);
        assert_eq!(crossings(&[], &[], 0.0), []);
    }
}
