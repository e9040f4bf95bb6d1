//! Where a function changes its sign.

/// Evaluations of one search; each second one halves the bracket at least.
const EVALUATIONS: usize = 100;

/// s between a and b, where f has the signs of `at_a` and `at_b`, to rounding of s, or where f is at most `enough`: secants that let no end
/// stand still (Illinois). `None` where f gives none.
pub(super) fn root(mut a: (f64, f64), mut b: (f64, f64), enough: f64, mut f: impl FnMut(f64) -> Option<f64>) -> Option<f64> {
    if a.1 == 0.0 {
        return Some(a.0);
    }
    for k in 0..EVALUATIONS {
        let secant = (a.0 * b.1 - b.0 * a.1) / (b.1 - a.1);
        let (low, high) = (a.0.min(b.0), a.0.max(b.0));
        let s = if k % 8 == 7 || !(low..=high).contains(&secant) { 0.5 * (a.0 + b.0) } else { secant };
        let value = f(s)?;
        if value.abs() <= enough || s == a.0 || s == b.0 || high - low <= f64::EPSILON * high.abs() {
            return Some(s);
        }
        if (value > 0.0) == (b.1 > 0.0) {
            a.1 *= 0.5;
        } else {
            a = b;
        }
        b = (s, value);
    }
    Some(b.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_found_to_rounding() {
        type Case = (fn(f64) -> f64, f64);
        let functions: [Case; 3] = [(|s| s.cos(), 0.5 * std::f64::consts::PI), (|s| s.powi(9) - 1.0, 1.0), (|s| 1.0 - s, 1.0)];
        for (f, expected) in functions {
            let mut evaluations = 0;
            let found = root((0.0, f(0.0)), (3.0, f(3.0)), 1e-15, |s| {
                evaluations += 1;
                Some(f(s))
            });
            assert!((found.unwrap() - expected).abs() < 1e-14 && evaluations < 60, "{found:?} {evaluations}");
        }
        assert_eq!(root((0.0, -1.0), (1.0, 1.0), 0.0, |_| None), None);
    }
}
