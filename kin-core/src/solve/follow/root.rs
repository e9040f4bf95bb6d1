//! Finds where a function changes its sign.

/// The largest number of evaluations; every second one at least halves the bracket.
const EVALUATIONS: usize = 100;

/// Returns s between a and b at which f changes its sign from `at_a` to `at_b`, or is at most
/// `enough`, to rounding of s. It uses secants that move both ends (Illinois). Returns `None` if f
/// returns `None`.
pub(crate) fn root(
    mut a: (f64, f64),
    mut b: (f64, f64),
    enough: f64,
    mut f: impl FnMut(f64) -> Option<f64>,
) -> Option<f64> {
    if a.1 == 0.0 {
        return Some(a.0);
    }
    for k in 0..EVALUATIONS {
        let secant = (a.0 * b.1 - b.0 * a.1) / (b.1 - a.1);
        let low = a.0.min(b.0);
        let high = a.0.max(b.0);
        let s =
            if k % 8 == 7 || !(low..=high).contains(&secant) { 0.5 * (a.0 + b.0) } else { secant };
        let value = f(s)?;
        if value.abs() <= enough || high - low <= f64::EPSILON * high.abs() {
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
        type Case = (fn(f64) -> f64, f64, u32);
        let functions: [Case; 3] = [
            (|s| s.cos(), 0.5 * std::f64::consts::PI, 10),
            (|s| s.powi(9) - 1.0, 1.0, 60),
            (|s| 1.0 - s, 1.0, 2),
        ];
        for (f, expected, most) in functions {
            let mut evaluations = 0;
            let found = root((0.0, f(0.0)), (3.0, f(3.0)), 1e-15, |s| {
                evaluations += 1;
                Some(f(s))
            });
            assert!(
                (found.unwrap() - expected).abs() < 1e-14 && evaluations <= most,
                "{found:?} {evaluations}"
            );
        }
        assert_eq!(root((0.0, -1.0), (1.0, 1.0), 0.0, |_| None), None);
        assert_eq!(root((2.0, 0.0), (3.0, 1.0), 0.0, |_| None), Some(2.0));
        // Where it is small enough, before it is zero; backwards as well; and where there is no
        // number left between a jump.
        let small = root((0.0, -1.0), (1.0, 7.0), 0.1, |s| Some(8.0 * s * s * s - 1.0)).unwrap();
        assert!((8.0 * small.powi(3) - 1.0).abs() <= 0.1 && (small - 0.5).abs() > 1e-6);
        let back = root((3.0, 2.0), (0.0, -1.0), 0.0, |s| Some(s - 1.0)).unwrap();
        assert!((back - 1.0).abs() < 1e-15, "{back}");
        for (from, to, at) in [
            (0.0, 3.0, 1.0),
            (-3.0, -0.5, -1.0),
            (-0.5, -3.0, -1.0),
            (0.0, 3e3, 1e3),
            (-1e-3, -3e-3, -2e-3),
        ] {
            let mut evaluations = 0;
            let jump = root(
                (from, if from < at { -1.0 } else { 1.0 }),
                (to, if to < at { -1.0 } else { 1.0 }),
                0.0,
                |s| {
                    evaluations += 1;
                    Some(if s < at { -1.0 } else { 1.0 })
                },
            );
            assert!(
                jump.is_some_and(|jump| (jump / at - 1.0).abs() < 1e-15)
                    && evaluations < EVALUATIONS,
                "{jump:?} {evaluations}"
            );
        }
    }
}
