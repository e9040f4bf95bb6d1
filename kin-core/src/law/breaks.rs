//! Where derivatives jump, found from the jets on both sides.

use super::{Break, Law};

/// Largest difference of two values that meet, beside the larger of them and of what the derivatives make of a length.
const MEETS: f64 = 1e-9;

/// The lowest derivative in which two jets differ, lengths in x being about `length`; `None` if they are alike up to the third.
pub(super) fn order_of_jump(left: [f64; 4], right: [f64; 4], length: f64) -> Option<usize> {
    let at = |k: usize| length.powi(k as i32);
    let size = (1..4).map(|k| left[k].abs().max(right[k].abs()) * at(k)).fold(0.0, f64::max);
    if !((left[0] - right[0]).abs() <= MEETS * size.max(left[0].abs()).max(right[0].abs())) {
        return Some(0);
    }
    (1..4).find(|&k| (left[k] - right[k]).abs() * at(k) > 1e-7 * size)
}

/// The jet of a law just before x, for parts of about `length`.
pub(super) fn left_jet(law: &Law, x: f64, length: f64) -> [f64; 4] {
    // its derivatives a little before, carried on to x by Taylor's formula: exact to the fourth power of the little
    let h = 1e-9 * length;
    let [f, f1, f2, f3] = law.jet(x - h);
    [f + h * (f1 + 0.5 * h * f2), f1 + h * (f2 + 0.5 * h * f3), f2 + h * f3, f3]
}

/// Both lists in one, in order; of two breaks at one place the lower order counts.
pub(super) fn merged(mut all: Vec<Break>) -> Vec<Break> {
    all.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.order.cmp(&b.order)));
    let mut kept: Vec<Break> = Vec::with_capacity(all.len());
    for found in all {
        match kept.last_mut() {
            Some(last) if (found.x - last.x).abs() <= 1e-12 * found.x.abs().max(last.x.abs()) => last.order = last.order.min(found.order),
            _ => kept.push(found),
        }
    }
    kept
}

/// Where `inner` takes the value `y` between two places without a break between them, as far as 64 samples show it.
pub(super) fn preimages(inner: &Law, y: f64, from: f64, to: f64) -> Vec<f64> {
    const SAMPLES: u32 = 64;
    let offset = |x: f64| inner.jet(x)[0] - y;
    let place = |k: u32| if k == SAMPLES { to } else { from + (to - from) * f64::from(k) / f64::from(SAMPLES) };
    let mut found = Vec::new();
    for k in 0..SAMPLES {
        let (a, b) = (place(k), place(k + 1));
        match (offset(a), offset(b)) {
            (0.0, _) => found.push(a),
            (p, q) if p * q < 0.0 => found.push(bisected(&offset, a, b)),
            _ => {}
        }
    }
    if offset(to) == 0.0 {
        found.push(to);
    }
    found
}

/// The first place between a and b that is beyond where f crosses zero: there a law has the derivatives of its right side.
fn bisected(f: &dyn Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let below = f(a) < 0.0;
    for _ in 0..100 {
        let middle = a + 0.5 * (b - a);
        if f(middle) != 0.0 && (f(middle) < 0.0) == below { a = middle } else { b = middle }
    }
    b
}
