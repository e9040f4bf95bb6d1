//! Finds the arguments at which derivatives of a law jump, from the derivatives on both sides.

use super::{Break, Law};

/// The largest number of breaks in one answer. A law that repeats has any number of breaks.
pub(crate) const MOST_BREAKS: usize = 10_000;

/// The largest difference of two values that meet, relative to the largest value of either part.
/// Users write tables and heights with nine digits or more.
const MEETS: f64 = 1e-9;

/// The largest difference of two derivatives that do not jump, relative to the largest value of
/// that derivative.
const AGREES: f64 = 1e-7;

/// Rounding error of a derivative, relative to the largest change that the other derivatives can
/// cause over the length.
const ROUNDING: f64 = 1e-13;

/// The largest |f|, |f′|, … |f⁗| of a law over 0 ≤ x ≤ length, sampled at 34 points. Each
/// derivative needs its own scale: a fast and small vibration has a large f‴, and on that scale
/// every jump of the value would seem small.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sizes([f64; 5]);

impl Sizes {
    pub(super) fn of(law: &Law, length: f64) -> Self {
        let places = (1..=32).map(|k| length * (f64::from(k) * 0.618_033_988_749_894_9).fract());
        places.chain([0.0, length]).fold(Sizes::default(), |sizes, x| {
            let [f, f1, f2, f3] = law.jet(x);
            sizes.with(Sizes([f, f1, f2, f3, law.fourth(x)].map(f64::abs)))
        })
    }

    /// Returns the larger size of each derivative. NaN does not count.
    pub(super) fn with(self, other: Sizes) -> Self {
        Sizes(std::array::from_fn(|k| self.0[k].max(other.0[k])))
    }

    /// Returns the distance before an end at which to evaluate the left side. It is small compared
    /// with the length and with the scale on which the law changes, and large compared with
    /// rounding.
    fn step(&self, length: f64) -> f64 {
        let change = 1e-4 * self.0[0] / self.0[1];
        let near = if change > 0.0 { change.min(1e-9 * length) } else { 1e-9 * length };
        near.max(64.0 * f64::EPSILON * length)
    }

    /// Returns the difference of two jets in derivative k that is not a jump. Taylor's formula
    /// extrapolates one of the jets by `step`; the part is about `length` long.
    fn allowed(&self, k: usize, step: f64, length: f64) -> f64 {
        let Sizes(size) = self;
        let next = size[k + 1];
        if k == 0 {
            // x is rounded, so the value of a steep law has an error too.
            return MEETS * size[0] + 8.0 * f64::EPSILON * length * next;
        }
        let others = (0..4).map(|j| size[j] * length.powi(j as i32 - k as i32)).fold(0.0, f64::max);
        AGREES * size[k] + 2.0 * step * next + ROUNDING * others
    }
}

/// The seam between the end of one part of a law and the start of the next.
pub(super) struct Seam {
    left: [f64; 4],
    right: [f64; 4],
    sizes: Sizes,
    step: f64,
    length: f64,
}

impl Seam {
    /// Returns the seam between the end of `law`, which is `length` long, and the next part.
    /// `shorter` is the typical length in x.
    pub(super) fn after(
        law: &Law,
        length: f64,
        sizes: Sizes,
        (right, sizes_after, shorter): ([f64; 4], Sizes, f64),
    ) -> Self {
        let step = sizes.step(length);
        Seam {
            left: left_jet(law, length, step),
            right,
            sizes: sizes.with(sizes_after),
            step,
            length: shorter,
        }
    }

    /// Returns the seam between a constant value and the part that follows.
    pub(super) fn before(held: f64, right: [f64; 4], sizes: Sizes, length: f64) -> Self {
        Seam { left: [held, 0.0, 0.0, 0.0], right, sizes, step: 0.0, length }
    }

    /// Returns the lowest derivative that jumps, or `None` if none up to the third jumps.
    pub(super) fn order(&self) -> Option<usize> {
        (0..4).find(|&k| {
            let apart = (self.left[k] - self.right[k]).abs();
            let meets = apart <= self.sizes.allowed(k, self.step, self.length);
            // A derivative that is NaN does not count as a jump. A value that is NaN never meets.
            !meets && (k == 0 || !apart.is_nan())
        })
    }

    /// Returns the value at the end of the left side.
    pub(super) fn end(&self) -> f64 {
        self.left[0]
    }
}

/// Returns the jet of a law just before x, evaluated `step` before x.
pub(super) fn left_jet(law: &Law, x: f64, step: f64) -> [f64; 4] {
    // Taylor's formula extrapolates the derivatives to x.
    let h = step;
    let [f, f1, f2, f3] = law.jet(x - step);
    let f4 = law.fourth(x - step);
    let f4 = if f4.is_finite() { f4 } else { 0.0 };
    let first = f1 + h * (f2 + 0.5 * h * f3);
    [f + h * (f1 + 0.5 * h * (f2 + h / 3.0 * f3)), first, f2 + h * (f3 + 0.5 * h * f4), f3 + h * f4]
}

/// Sorts the breaks and returns the first [`MOST_BREAKS`]. Of two breaks at one place it keeps the
/// lower order.
pub(super) fn merged(mut all: Vec<Break>) -> Vec<Break> {
    all.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.order.cmp(&b.order)));
    let mut kept: Vec<Break> = Vec::with_capacity(all.len());
    for found in all {
        match kept.last_mut() {
            Some(last) if found.x - last.x <= 1e-12 * found.x.abs() => {
                last.order = last.order.min(found.order)
            }
            _ => kept.push(found),
        }
    }
    kept.truncate(MOST_BREAKS);
    kept
}

/// Repeats the breaks of one period between two places and returns the first [`MOST_BREAKS`]. The
/// first period begins at `start`.
pub(super) fn repeated(one: &[Break], start: f64, period: f64, from: f64, to: f64) -> Vec<Break> {
    if one.is_empty() || period <= 0.0 {
        return Vec::new();
    }
    // Begins one period earlier, because the division rounds.
    let first = ((from.max(f64::MIN) - start) / period).floor() - 1.0;
    let mut all: Vec<Break> = Vec::new();
    for turn in 0..MOST_BREAKS / one.len() + 3 {
        let moved = (first + turn as f64) * period;
        if start + moved > to {
            break;
        }
        // If periods are shorter than rounding, many breaks have the same place.
        let beyond = |all: &[Break], x: f64| all.last().is_none_or(|last| x > last.x);
        for found in one.iter().map(|b| Break { x: b.x + moved, ..*b }) {
            if (from..=to).contains(&found.x) && beyond(&all, found.x) {
                all.push(found);
            }
        }
    }
    all.truncate(MOST_BREAKS);
    all
}

/// Returns the first break of the lowest order.
pub(super) fn sharpest(all: impl IntoIterator<Item = Break>) -> Option<Break> {
    all.into_iter().min_by_key(|found| found.order)
}

/// Values of a law at 65 places of an interval. They locate the places where the law takes a given
/// value.
pub(super) struct Samples<'a> {
    law: &'a Law,
    places: Vec<(f64, f64)>,
}

impl<'a> Samples<'a> {
    pub(super) fn between(law: &'a Law, from: f64, to: f64) -> Self {
        const GAPS: u32 = 64;
        let place = |k: u32| {
            if k == GAPS { to } else { from + (to - from) * f64::from(k) / f64::from(GAPS) }
        };
        Samples { law, places: (0..=GAPS).map(place).map(|x| (x, law.at(x))).collect() }
    }

    /// Returns the lowest and the highest sampled value.
    pub(super) fn range(&self) -> (f64, f64) {
        self.places.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (_, y)| {
            (low.min(*y), high.max(*y))
        })
    }

    /// Returns the places where the law takes the value `y`, as far as the samples show them. The
    /// law must have no break in the interval.
    pub(super) fn preimages(&self, y: f64) -> Vec<f64> {
        let mut found: Vec<f64> =
            self.places.iter().filter(|(_, value)| *value == y).map(|(x, _)| *x).collect();
        let crosses = |pair: &&[(f64, f64)]| {
            let p = pair[0].1 - y;
            let q = pair[1].1 - y;
            (p < 0.0 && q > 0.0) || (p > 0.0 && q < 0.0)
        };
        found.extend(
            self.places
                .windows(2)
                .filter(crosses)
                .map(|pair| bisected(&|x| self.law.at(x) - y, pair[0].0, pair[1].0)),
        );
        found
    }
}

/// Returns the first place between a and b after f crosses zero. At that place a law has the
/// derivatives of its right side.
fn bisected(f: &dyn Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let sign = f(a).signum();
    let mut middle = a + 0.5 * (b - a);
    // Until no number is left between a and b.
    while a < middle && middle < b {
        if f(middle) * sign > 0.0 {
            a = middle
        } else {
            b = middle
        }
        middle = a + 0.5 * (b - a);
    }
    b
}

#[cfg(test)]
mod tests;
