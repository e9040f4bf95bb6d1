//! Checks a law: compares each derivative with central differences of the derivative below it, and
//! the listed breaks with the breaks that Kin finds.

use std::fmt;

use crate::law::Law;

/// The places at which a law's derivatives disagree with the law.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub struct LawMismatch {
    /// The kind of the law, such as `ramp`.
    pub kind: String,
    /// The disagreements, one per line.
    pub lines: Vec<String>,
}

impl fmt::Display for LawMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the values, derivatives and breaks of the law `{}` contradict each other:",
            self.kind
        )?;
        self.lines.iter().try_for_each(|line| write!(f, "\n  {line}"))
    }
}

impl fmt::Debug for LawMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for LawMismatch {}

/// Asserts that f′, f″ and f‴ of a law are the derivatives of f, f′ and f″ between `from` and `to`,
/// and that its breaks are complete.
///
/// If the law has interval bounds, the function also tests that all values are within the bounds.
///
/// Use the function in a test. If the law fails the check, the function panics with a table of the
/// differences. [`compare_law`] returns the table as a value.
pub fn law(law: &Law, from: f64, to: f64) {
    if let Err(mismatch) = compare_law(law, from, to) {
        panic!("{mismatch}");
    }
}

/// Compares the derivatives of a law with central differences and returns the largest relative
/// difference.
///
/// The function tests 200 arguments between `from` and `to`, and both sides of the breaks.
///
/// Errors: the derivatives, the breaks or the bounds disagree with the law.
pub fn compare_law(law: &Law, from: f64, to: f64) -> Result<f64, LawMismatch> {
    let breaks = law.breaks(from, to);
    let h = 1e-6 * (to - from);
    let mut lines = Vec::new();
    let mut worst = 0.0_f64;
    let sizes = sizes(law, from, to);
    let all = (0..200).map(|k| from + (to - from) * (f64::from(k) + 0.5) / 200.0);
    let places: Vec<f64> =
        all.filter(|x| breaks.iter().all(|b| (b.x - x).abs() > 2.0 * h)).collect();
    let noise = Noise::of(law, &places, h);
    for (k, &x) in places.iter().enumerate() {
        let at = law.jet(x);
        let before = law.jet(x - h);
        let after = law.jet(x + h);
        for order in 0..3 {
            let slope = (after[order] - before[order]) / (2.0 * h);
            let rounding = noise.at(k, order) / h + noise.at(k, order + 1);
            let off = ((slope - at[order + 1]).abs() - rounding).max(0.0);
            let off = if slope.is_nan() || at[order + 1].is_nan() { f64::NAN } else { off };
            let difference = off / (sizes[order + 1] + sizes[order] * 1e-3 / (to - from));
            worst = worst.max(difference);
            if difference.is_nan() || difference > 1e-6 {
                lines.push(format!(
                    "{} at x = {x} is {:e}, but central differences give {slope:e}",
                    derivative(order + 1),
                    at[order + 1]
                ));
            }
        }
    }
    lines.extend(breaks.iter().filter_map(|b| at_break(law, b.x, b.order, h, &sizes)));
    lines.extend(super::bounds::of_law(law, from, to, &sizes));
    lines.truncate(16);
    if lines.is_empty() {
        Ok(worst)
    } else {
        Err(LawMismatch { kind: law.kind().to_owned(), lines })
    }
}

/// The changes of a law and its derivatives by rounding at some places. If terms cancel, a law has
/// only this accuracy.
struct Noise {
    places: Vec<[f64; 4]>,
    /// The changes at three of four places are at most this large.
    usual: [f64; 4],
}

impl Noise {
    /// Shifts of the argument in units in the last place.
    const MOVED: [f64; 6] = [-11.0, -3.0, -1.0, 1.0, 4.0, 9.0];

    /// The allowed rounding of a central difference, as a multiple of the observed changes.
    const ALLOWED: f64 = 4.0;

    fn of(law: &Law, places: &[f64], h: f64) -> Noise {
        let places: Vec<[f64; 4]> = places
            .iter()
            .map(|x| {
                let around = [x - h, *x, x + h].map(|x| Noise::around(law, x));
                std::array::from_fn(|order| {
                    around.iter().fold(0.0, |m, own| f64::max(m, own[order]))
                })
            })
            .collect();
        let usual = std::array::from_fn(|order| {
            let mut all: Vec<f64> = places.iter().map(|own| own[order]).collect();
            all.sort_by(f64::total_cmp);
            all.get(3 * all.len() / 4).copied().unwrap_or(0.0)
        });
        Noise { places, usual }
    }

    /// Returns the distance of the law from its tangent if the argument moves by some units in the
    /// last place.
    fn around(law: &Law, x: f64) -> [f64; 4] {
        let at = law.jet(x);
        let mut most = [0.0_f64; 4];
        for units in Noise::MOVED {
            let near = x + units * f64::EPSILON * x.abs();
            let there = law.jet(near);
            for order in 0..4 {
                let slope = at.get(order + 1).copied().unwrap_or(0.0);
                most[order] =
                    most[order].max((there[order] - at[order] - slope * (near - x)).abs());
            }
        }
        most
    }

    fn at(&self, place: usize, order: usize) -> f64 {
        Noise::ALLOWED * self.places[place][order].max(self.usual[order])
    }
}

/// Returns the largest value of each derivative at 100 places.
fn sizes(law: &Law, from: f64, to: f64) -> [f64; 4] {
    let all = (0..=100).map(|k| law.jet(from + (to - from) * f64::from(k) / 100.0));
    let largest = all.fold([0.0_f64; 4], |m, jet| std::array::from_fn(|k| m[k].max(jet[k].abs())));
    largest.map(|size| if size > 0.0 { size } else { 1.0 })
}

/// "the value", "the derivative of order 2".
pub(super) fn derivative(order: usize) -> String {
    if order == 0 { "the value".to_string() } else { format!("the derivative of order {order}") }
}

/// Returns what is wrong with one break: a derivative below its order jumps, or the derivative of
/// its order does not.
fn at_break(law: &Law, x: f64, order: usize, h: f64, sizes: &[f64; 4]) -> Option<String> {
    let before = law.jet(x - h);
    let after = law.jet(x + h);
    let at = law.jet(x);
    let jump = |k: usize, a: &[f64; 4], b: &[f64; 4]| {
        let drift = if k < 3 { 2.0 * h * before[k + 1].abs().max(after[k + 1].abs()) } else { 0.0 };
        (a[k] - b[k]).abs() > 1e-4 * sizes[k] + 2.0 * drift
    };
    if let Some(k) = (0..order.min(3)).find(|&k| jump(k, &before, &after)) {
        return Some(format!(
            "the law lists a break of order {order} at x = {x}, but {} jumps at x = {x}, from {:e} to {:e}",
            derivative(k),
            before[k],
            after[k]
        ));
    }
    if order <= 3 && !jump(order, &before, &after) {
        return Some(format!(
            "the law lists a break of order {order} at x = {x}, but {} does not jump at x = {x}: it is {:e} on both sides",
            derivative(order),
            at[order]
        ));
    }
    let left = (0..4).find(|&k| jump(k, &at, &after))?;
    // At the end of its range a law has the derivatives of its left side.
    if law.range().is_some_and(|range| x >= range.to) && !(0..4).any(|k| jump(k, &at, &before)) {
        return None;
    }
    Some(format!(
        "at the break x = {x}, {} is {:e}, but must equal the limit from the right, {:e}",
        derivative(left),
        at[left],
        after[left]
    ))
}
