//! Checking a law: each derivative against central differences of the one before, and the breaks it lists
//! against those it has.

use std::fmt;

use crate::model::law::Law;

/// Where a law's derivatives do not agree with it.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub struct LawMismatch {
    /// Kind of the law, such as `ramp`.
    pub kind: String,
    /// The disagreements, one a line.
    pub lines: Vec<String>,
}

impl fmt::Display for LawMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the law `{}` does not agree with itself:", self.kind)?;
        self.lines.iter().try_for_each(|line| write!(f, "\n  {line}"))
    }
}

impl fmt::Debug for LawMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for LawMismatch {}

/// Asserts that f′, f″ and f‴ of a law are the derivatives of f, f′ and f″ between `from` and `to`, that its
/// breaks are as it lists them, and that all of these lie within their interval bounds, where it knows those.
///
/// For a test: panics with a table. [`compare_law`] returns the same as a value.
pub fn law(law: &Law, from: f64, to: f64) {
    if let Err(mismatch) = compare_law(law, from, to) {
        panic!("{mismatch}");
    }
}

/// Compares the derivatives of a law with central differences at 200 places between `from` and `to` and on
/// both sides of its breaks; gives the largest relative difference.
pub fn compare_law(law: &Law, from: f64, to: f64) -> Result<f64, LawMismatch> {
    let breaks = law.breaks(from, to);
    let h = 1e-6 * (to - from);
    let (mut lines, mut worst) = (Vec::new(), 0.0_f64);
    let sizes = sizes(law, from, to);
    for k in 0..200 {
        let x = from + (to - from) * (f64::from(k) + 0.5) / 200.0;
        if breaks.iter().any(|b| (b.x - x).abs() <= 2.0 * h) {
            continue;
        }
        let (at, before, after) = (law.jet(x), law.jet(x - h), law.jet(x + h));
        for order in 0..3 {
            let slope = (after[order] - before[order]) / (2.0 * h);
            let difference =
                (slope - at[order + 1]).abs() / (sizes[order + 1] + sizes[order] * 1e-3 / (to - from));
            worst = worst.max(difference);
            if difference.is_nan() || difference > 1e-6 {
                lines.push(format!(
                    "derivative {} at x = {x}: {:e}, by central differences {slope:e}",
                    order + 1,
                    at[order + 1]
                ));
            }
        }
    }
    lines.extend(breaks.iter().filter_map(|b| at_break(law, b.x, b.order, h, &sizes)));
    lines.extend(super::bounds::of_law(law, from, to, &sizes));
    lines.truncate(16);
    if lines.is_empty() { Ok(worst) } else { Err(LawMismatch { kind: law.kind().to_owned(), lines }) }
}

/// The largest of each derivative, so far as 100 places show it.
fn sizes(law: &Law, from: f64, to: f64) -> [f64; 4] {
    let all = (0..=100).map(|k| law.jet(from + (to - from) * f64::from(k) / 100.0));
    let largest = all.fold([0.0_f64; 4], |m, jet| std::array::from_fn(|k| m[k].max(jet[k].abs())));
    largest.map(|size| if size > 0.0 { size } else { 1.0 })
}

/// The fault of one break, if it has one: a derivative below its order jumps, or the one of its order does
/// not.
fn at_break(law: &Law, x: f64, order: usize, h: f64, sizes: &[f64; 4]) -> Option<String> {
    let (before, after, at) = (law.jet(x - h), law.jet(x + h), law.jet(x));
    let jump = |k: usize, a: &[f64; 4], b: &[f64; 4]| {
        let drift = if k < 3 { 2.0 * h * before[k + 1].abs().max(after[k + 1].abs()) } else { 0.0 };
        (a[k] - b[k]).abs() > 1e-4 * sizes[k] + 2.0 * drift
    };
    if let Some(k) = (0..order.min(3)).find(|&k| jump(k, &before, &after)) {
        return Some(format!(
            "break at x = {x} of order {order}, but derivative {k} jumps there: {:e} to {:e}",
            before[k], after[k]
        ));
    }
    if order <= 3 && !jump(order, &before, &after) {
        return Some(format!(
            "break at x = {x} of order {order}, but that derivative does not jump there: {:e}",
            at[order]
        ));
    }
    let left = (0..4).find(|&k| jump(k, &at, &after))?;
    Some(format!(
        "at the break x = {x} derivative {left} is {:e}, not that of the right side, {:e}",
        at[left], after[left]
    ))
}
