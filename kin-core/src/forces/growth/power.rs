//! Determines the exponent with which a quantity grows, from its values at places on the path.

/// Values at places on the path to a singular position, the furthest first.
pub(super) struct Values<'a> {
    /// |t − t*| of each place. \[s\]
    pub times: &'a [f64],
    /// The distance of each place along the path; each is smaller by the same factor. \[-\]
    pub ways: &'a [f64],
    /// The positive quantity at each place.
    pub sizes: &'a [f64],
}

/// Two extrapolations that differ by at most this value agree, and so do an exponent and a
/// fraction. \[-\]
const SETTLED: f64 = 0.01;
const FRACTION: f64 = 0.02;

/// Exponents are multiples of one twelfth: halves at a toggle, integers at a change point, thirds
/// and quarters where the path is flatter than usual.
const TWELFTHS: f64 = 12.0;

/// Returns p of a quantity proportional to |t − t*|^p, or `None` if the extrapolation does not
/// settle.
///
/// Along the path both the quantity and |t − t*| are a power times a series in the distance s. The
/// slope of logarithms between two places is p + a s + b s² + …; Richardson extrapolation
/// eliminates a and b.
pub(super) fn power(of: &Values<'_>) -> Option<f64> {
    let slope =
        |k: usize| (of.sizes[k + 1] / of.sizes[k]).ln() / (of.times[k + 1] / of.times[k]).ln();
    let slopes: Vec<f64> = (0..of.sizes.len().saturating_sub(1)).map(slope).collect();
    let ratio = |k: usize| of.ways[k] / of.ways[k + 1];
    let better = |from: &[f64], order: i32| -> Vec<f64> {
        let one =
            |k: usize| from[k + 1] + (from[k + 1] - from[k]) / (ratio(k + 1).powi(order) - 1.0);
        (0..from.len().saturating_sub(1)).map(one).collect()
    };
    let found = better(&better(&slopes, 1), 2);
    let settled = found.windows(2).find(|two| (two[1] - two[0]).abs() < SETTLED)?;
    let fraction = (settled[1] * TWELFTHS).round() / TWELFTHS;
    Some(if (fraction - settled[1]).abs() < FRACTION { fraction } else { settled[1] })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of t and of a quantity as functions of the way.
    fn of(t: impl Fn(f64) -> f64, size: impl Fn(f64) -> f64) -> Option<f64> {
        let ways: Vec<f64> = (0..8).map(|k| 0.2 * 0.5_f64.powi(k)).collect();
        let [times, sizes] =
            [ways.iter().map(|s| t(*s)).collect(), ways.iter().map(|s| size(*s)).collect()];
        let (times, sizes): (Vec<f64>, Vec<f64>) = (times, sizes);
        power(&Values { times: &times, ways: &ways, sizes: &sizes })
    }

    #[test]
    fn powers_of_series_are_found() {
        let toggle = |s: f64| s * s * (1.0 + 0.7 * s - 0.4 * s * s);
        assert_eq!(of(toggle, |s| 3.0 / s + 2.0 - s), Some(-0.5));
        assert_eq!(of(toggle, |s| s.powi(-4) * (1.0 + 2.0 * s)), Some(-2.0));
        assert_eq!(of(toggle, |s| 5.0 + s), Some(0.0));
        assert_eq!(of(toggle, |s| 2.0 * s), Some(0.5));
        assert_eq!(of(|s| s * (1.0 - s), |s| 1.0 / s + 4.0), Some(-1.0));
        // A path that leaves its end with the third power of the way.
        assert_eq!(of(|s| s.powi(3) * (1.0 + s), |s| 1.0 / s), Some(-1.0 / 3.0));
    }

    #[test]
    fn what_does_not_settle_has_no_power() {
        assert_eq!(of(|s| s * s, |s| 1.0 + 0.9 * (40.0 / s).sin()), None);
        let two = [0.2, 0.1];
        assert_eq!(power(&Values { times: &two, ways: &two, sizes: &two }), None);
    }
}
