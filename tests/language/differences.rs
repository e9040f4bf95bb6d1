//! Derivatives along a curve by central differences, extrapolated to a step of zero (Richardson),
//! with an estimate of their error: the reference that knows nothing of Kin.

/// Steps are this, or a length that is given, divided by powers of [`SHRINK`].
pub const LONGEST: f64 = 0.06;
const SHRINK: f64 = 1.5;
const STEPS: usize = 9;

/// One derivative of each component, with an estimate of how far off the worst one is, relative to
/// 1 + the largest.
pub struct Estimate {
    pub value: Vec<f64>,
    pub error: f64,
}

/// The first `ORDERS` derivatives of `g` at 0, at most three.
pub fn derivatives<const ORDERS: usize>(g: &dyn Fn(f64) -> Vec<f64>) -> [Estimate; ORDERS] {
    derivatives_by(LONGEST, g)
}

/// The same by steps of a length: two lengths tell a function that jumps among the longer steps.
pub fn derivatives_by<const ORDERS: usize>(
    longest: f64,
    g: &dyn Fn(f64) -> Vec<f64>,
) -> [Estimate; ORDERS] {
    let middle = g(0.0);
    let mut tables: [Vec<Vec<f64>>; ORDERS] = std::array::from_fn(|_| Vec::new());
    let mut h = longest;
    for _ in 0..STEPS {
        let back = g(-h);
        let ahead = g(h);
        let far = if ORDERS > 2 { [g(-2.0 * h), g(2.0 * h)] } else { [vec![], vec![]] };
        for (order, table) in tables.iter_mut().enumerate() {
            let difference = |k: usize| match order {
                0 => (ahead[k] - back[k]) / (2.0 * h),
                1 => (ahead[k] - 2.0 * middle[k] + back[k]) / (h * h),
                _ => (far[1][k] - 2.0 * ahead[k] + 2.0 * back[k] - far[0][k]) / (2.0 * h * h * h),
            };
            table.push((0..middle.len()).map(difference).collect());
        }
        h /= SHRINK;
    }
    tables.map(|table| extrapolated(&table))
}

/// Richardson's scheme over differences whose error is even in the step; of all its entries the one
/// that differs least from those it is made of.
fn extrapolated(differences: &[Vec<f64>]) -> Estimate {
    let mut best = Estimate { value: differences[0].clone(), error: f64::INFINITY };
    let mut column = differences.to_vec();
    for level in 1..differences.len() {
        let factor = SHRINK.powi(2 * level as i32);
        let next: Vec<Vec<f64>> =
            column.windows(2).map(|pair| combined(&pair[0], &pair[1], factor)).collect();
        for (value, pair) in next.iter().zip(column.windows(2)) {
            let error = apart(value, &pair[0]).max(apart(value, &pair[1]));
            if error < best.error {
                best = Estimate { value: value.clone(), error };
            }
        }
        column = next;
    }
    best
}

fn combined(coarse: &[f64], fine: &[f64], factor: f64) -> Vec<f64> {
    coarse
        .iter()
        .zip(fine)
        .map(|(coarse, fine)| (factor * fine - coarse) / (factor - 1.0))
        .collect()
}

/// The largest difference of two lists relative to 1 + the largest entry of the first; NaN if there
/// is one.
pub fn apart(a: &[f64], b: &[f64]) -> f64 {
    let size = a.iter().fold(1.0, |size, x| size + x.abs());
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / size).fold(0.0, |m, x| if x <= m { m } else { x })
}

#[test]
fn derivatives_of_a_known_function() {
    let [first, second, third] = derivatives::<3>(&|s| vec![(2.0 * s).exp(), s.cos()]);
    for (found, known) in [(first, [2.0, 0.0]), (second, [4.0, -1.0]), (third, [8.0, 0.0])] {
        assert!(found.error < 1e-7 && apart(&known, &found.value) < 1e-7, "{:?}", found.value);
    }
}

#[test]
fn a_kink_within_the_steps_is_seen_by_the_error() {
    let [first] = derivatives::<1>(&|s| vec![(s - 0.001).abs()]);
    assert!(first.error > 1e-4, "{:?}", first.value);
}
