//! Predicts a coordinate from earlier times.

use crate::program::times::Curve;
use crate::solve::motion::Motion;
use crate::solve::step::predictor::is_same;

/// The largest number of times through which a curve passes.
const MOST: usize = 4;

/// The number of coefficients of the velocity: two for each time.
const RATES: usize = 2 * MOST;

/// The linear map from q̇ and q̈ at some times to the polynomial of least degree through them. It
/// is the same for all coordinates, and on an even grid for all groups of times.
pub(super) struct Curves {
    /// The distance of each time from the last one, in times; the last one comes first.
    behind: Vec<usize>,
    times: [f64; MOST],
    /// The share of q̇ and q̈ at each time in each coefficient of q except the first.
    parts: [[f64; RATES]; RATES],
}

impl Curves {
    /// Creates a curve through at most four times.
    pub(super) fn through(behind: impl IntoIterator<Item = usize>) -> Self {
        let behind = behind.into_iter().take(MOST).collect();
        Curves { behind, times: [0.0; MOST], parts: [[0.0; RATES]; RATES] }
    }

    /// Returns the number of times that must precede the last one.
    pub(super) fn reach_back(&self) -> usize {
        self.behind.last().copied().unwrap_or_default()
    }

    /// Computes the map for the times before index `last` of a motion; that time is 0.
    pub(super) fn lead(&mut self, motion: &Motion, last: usize) {
        let mut times = [0.0; MOST];
        let all = motion.times();
        times
            .iter_mut()
            .zip(&self.behind)
            .for_each(|(t, behind)| *t = all[last - behind] - all[last]);
        if times.iter().zip(&self.times).all(|(t, known)| is_same(*t, *known)) {
            return;
        }
        self.times = times;
        let count = 2 * self.behind.len();
        for (k, parts) in self.parts.iter_mut().enumerate().take(count) {
            let mut unit = [0.0; RATES];
            unit[k] = 1.0;
            *parts = integral(&times, unit, count);
        }
    }

    /// Returns a coordinate as a polynomial of the time since index `last` of a motion.
    pub(super) fn of(&self, motion: &Motion, last: usize, column: usize) -> Curve {
        let mut sums = [0.0; RATES];
        for (behind, [first, second]) in self.behind.iter().zip(self.parts.as_chunks::<2>().0) {
            let qd = motion.qd(last - behind)[column];
            let qdd = motion.qdd(last - behind)[column];
            for (k, sum) in sums.iter_mut().enumerate() {
                *sum += qd * first[k] + qdd * second[k];
            }
        }
        let mut curve = [motion.q(last)[column]; RATES + 1];
        curve[1..].copy_from_slice(&sums);
        curve
    }
}

/// Returns the value of a curve.
pub(super) fn at(curve: &Curve, s: f64) -> f64 {
    curve.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

/// Returns the coefficients of the integral of the polynomial through `count` velocities and
/// accelerations, time by time.
fn integral(times: &[f64; MOST], rates: [f64; RATES], count: usize) -> [f64; RATES] {
    let at = |k: usize| times[k / 2];
    // Divided differences with each time twice.
    let mut table: [f64; RATES] = std::array::from_fn(|k| rates[k / 2 * 2]);
    let mut newton = [0.0; RATES];
    newton[0] = table[0];
    for (level, own) in newton.iter_mut().enumerate().take(count).skip(1) {
        for k in 0..count - level {
            let h = at(k + level) - at(k);
            table[k] = if h == 0.0 { rates[k / 2 * 2 + 1] } else { (table[k + 1] - table[k]) / h };
        }
        *own = table[0];
    }
    // Converts Newton's form to powers of time.
    let mut powers = [0.0; RATES];
    for level in (0..count).rev() {
        for k in (1..RATES).rev() {
            powers[k] = powers[k - 1] - at(level) * powers[k];
        }
        powers[0] = newton[level] - at(level) * powers[0];
    }
    (0..RATES).for_each(|k| powers[k] /= k as f64 + 1.0);
    powers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::tests::models::four_bar;

    #[test]
    fn a_curve_is_met_by_what_its_rates_are_at_its_times() {
        let c = [0.3, -1.0, 0.7, 0.2, -0.5, 0.1, 0.05, -0.02, 0.03];
        let mut motion = Motion::new(&four_bar(1.0), 8);
        let n = motion.names().len();
        for t in [0.0, 0.1, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7] {
            let s = t - 0.7;
            let (q, qd, qdd) = (0..9).rev().fold((0.0, 0.0, 0.0), |(q, qd, qdd), k| {
                (q * s + c[k], qd * s + q, qdd * s + 2.0 * qd)
            });
            motion.times.push(t);
            motion.q.extend(vec![q; n]);
            motion.qd.extend(vec![qd; n]);
            motion.qdd.extend(vec![qdd; n]);
        }
        for (behind, exact) in [(vec![0, 1, 4, 6], 9), (vec![0, 2, 3, 5], 9), (vec![0, 1, 2], 0)] {
            let mut curves = Curves::through(behind.clone());
            curves.lead(&motion, 7);
            let found = curves.of(&motion, 7, 4);
            for (found, c) in found.iter().zip(c).take(exact) {
                assert!((found - c).abs() < 1e-6, "{behind:?}: {found} is not {c}");
            }
            // Three times leave the last powers out, and are near all the same.
            let exact = c.iter().rev().fold(0.0, |sum, c| sum * 0.1 + c);
            assert!((at(&found, 0.1) - exact).abs() < 1e-5, "{behind:?}");
        }
    }
}
