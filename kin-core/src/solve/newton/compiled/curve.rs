//! Where the last three times lead a coordinate.

use crate::program::times::Curve;

/// q as a polynomial of time: the integral of that of fifth degree which meets q̇ and q̈ at three times, the
/// first of which is 0.
pub(super) fn curve(q: f64, times: [f64; 3], rates: [[f64; 2]; 3]) -> Curve {
    let at = |k: usize| times[k / 2];
    // Divided differences over each time twice.
    let mut table = [0, 1, 2, 3, 4, 5].map(|k| rates[k / 2][0]);
    let mut newton = [table[0], 0.0, 0.0, 0.0, 0.0, 0.0];
    for (level, own) in newton.iter_mut().enumerate().skip(1) {
        for k in 0..6 - level {
            let h = at(k + level) - at(k);
            table[k] = if h == 0.0 { rates[k / 2][1] } else { (table[k + 1] - table[k]) / h };
        }
        *own = table[0];
    }
    // From Newton's form to powers of time.
    let mut powers = [0.0; 6];
    for level in (0..6).rev() {
        for k in (1..6).rev() {
            powers[k] = powers[k - 1] - at(level) * powers[k];
        }
        powers[0] = newton[level] - at(level) * powers[0];
    }
    let mut curve = [q, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    (0..6).for_each(|k| curve[k + 1] = powers[k] / (k as f64 + 1.0));
    curve
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_of_sixth_degree_is_met_by_what_its_rates_are_at_three_times() {
        let c = [0.3, -1.0, 0.7, 0.2, -0.5, 0.1, 0.05];
        let q = |s: f64| c.iter().rev().fold(0.0, |sum, c| sum * s + c);
        let qd = |s: f64| (1..7).rev().fold(0.0, |sum, k| sum * s + k as f64 * c[k]);
        let qdd = |s: f64| (2..7).rev().fold(0.0, |sum, k| sum * s + (k * (k - 1)) as f64 * c[k]);
        for times in [[0.0, -0.1, -0.2], [0.0, -0.05, -0.3], [0.0, 0.2, 0.4]] {
            let found = curve(q(0.0), times, times.map(|s| [qd(s), qdd(s)]));
            for (found, exact) in found.iter().zip(c) {
                assert!((found - exact).abs() < 1e-7, "{times:?}: {found} is not {exact}");
            }
        }
    }
}
