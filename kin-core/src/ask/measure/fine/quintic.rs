//! Quintic polynomials over 0 ≤ u ≤ 1, and their zeros.

use super::super::between;

/// The number of bisections after which no number is left between two numbers of 0 … 1.
const HALVINGS: usize = 60;

/// The polynomial c0 + c1 u + … with the values, velocities and accelerations of a step at its
/// ends.
pub(in crate::ask::measure) struct Quintic([f64; 6]);

impl Quintic {
    /// Creates the polynomial from x, ẋ and ẍ at both times.
    pub(in crate::ask::measure) fn between([a, b]: [f64; 2], ends: [[f64; 3]; 2]) -> Self {
        let h = b - a;
        Quintic(between::quintic(ends.map(|[x, rate, second]| [x, h * rate, h * h * second])))
    }

    pub(in crate::ask::measure) fn at(&self, u: f64) -> f64 {
        value(&self.0, u)
    }

    /// Returns the slope by u.
    pub(in crate::ask::measure) fn slope(&self, u: f64) -> f64 {
        value(&derivative(&self.0), u)
    }

    /// Returns the coefficients of the polynomial minus a level, or of its slope.
    pub(in crate::ask::measure) fn coefficients(&self, level: Option<f64>) -> Vec<f64> {
        match level {
            None => derivative(&self.0),
            Some(level) => {
                let mut c = self.0.to_vec();
                c[0] -= level;
                c
            }
        }
    }
}

/// Evaluates Σ c_k u^k.
pub(in crate::ask::measure) fn value(c: &[f64], u: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * u + c)
}

/// Returns the coefficients of the slope.
pub(in crate::ask::measure) fn derivative(c: &[f64]) -> Vec<f64> {
    c.iter().enumerate().skip(1).map(|(k, c)| k as f64 * c).collect()
}

/// Returns the places between 0 and 1 where a polynomial changes its sign, in order. Between two
/// zeros of its slope there is at most one.
pub(in crate::ask::measure) fn zeros(c: &[f64]) -> Vec<f64> {
    if c.len() < 2 || c.iter().any(|c| !c.is_finite()) {
        return Vec::new();
    }
    let turns = zeros(&derivative(c));
    let places: Vec<f64> = std::iter::once(0.0).chain(turns).chain([1.0]).collect();
    let differ = |pair: &&[f64]| value(c, pair[0]).signum() != value(c, pair[1]).signum();
    places.windows(2).filter(differ).map(|pair| halved(c, pair[0], pair[1])).collect()
}

fn halved(c: &[f64], mut low: f64, mut high: f64) -> f64 {
    let sign = value(c, low).signum();
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if value(c, middle).signum() == sign { low = middle } else { high = middle }
    }
    high
}

/// Returns true if a polynomial certainly keeps its sign, clear of zero by a share of its size, or
/// changes it exactly once. The signs of its coefficients in Bernstein form decide (Descartes' rule
/// for 0 < u < 1).
pub(in crate::ask::measure) fn is_simple(c: &[f64], margin: f64) -> bool {
    let bernstein = bernstein(c);
    let largest = bernstein.iter().fold(0.0_f64, |m, b| m.max(b.abs()));
    let changes = bernstein.windows(2).filter(|pair| pair[0].signum() != pair[1].signum()).count();
    match changes {
        0 => bernstein.iter().all(|b| b.abs() > margin * largest),
        changes => changes == 1,
    }
}

/// Returns b_i = Σ_(k ≤ i) C(i, k) / C(n, k) c_k.
fn bernstein(c: &[f64]) -> Vec<f64> {
    let n = c.len().saturating_sub(1);
    let choose =
        |n: usize, k: usize| (0..k).fold(1.0, |all, j| all * (n - j) as f64 / (j + 1) as f64);
    (0..=n).map(|i| (0..=i).map(|k| choose(i, k) / choose(n, k) * c[k]).sum()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial by its zeros.
    fn product(zeros: &[f64]) -> Vec<f64> {
        zeros.iter().fold(vec![1.0], |c, zero| {
            let mut next = vec![0.0; c.len() + 1];
            c.iter()
                .enumerate()
                .for_each(|(k, c)| (next[k], next[k + 1]) = (next[k] - zero * c, *c));
            next
        })
    }

    #[test]
    fn zeros_of_polynomials() {
        for expected in
            [vec![0.3, 0.7], vec![0.1, 0.2, 0.9], vec![0.5], vec![0.01, 0.4, 0.5, 0.6, 0.99]]
        {
            for beyond in [vec![], vec![1.5], vec![-0.2, 7.0]] {
                let all: Vec<f64> = expected.iter().chain(&beyond).copied().take(5).collect();
                let inner: Vec<f64> =
                    all.iter().copied().filter(|u| (0.0..1.0).contains(u)).collect();
                let c = product(&all);
                let found = zeros(&c);
                assert_eq!(found.len(), inner.len(), "{all:?}");
                assert!(found.iter().zip(&inner).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
                assert!(inner.len() < 2 || !is_simple(&c, 1e-5));
            }
        }
        // (u − ½)² touches, u² + 1 stays above
        assert_eq!((zeros(&[0.25, -1.0, 1.0]).len(), zeros(&[1.0, 0.0, 1.0]).len()), (0, 0));
        assert!(is_simple(&[1.0, 0.0, 1.0], 1e-5) && is_simple(&[-0.5, 1.0], 1e-5));
        assert!(zeros(&[f64::NAN, 1.0]).is_empty() && zeros(&[]).is_empty());
    }
}
