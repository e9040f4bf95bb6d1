//! Where derivatives jump, found from the jets on both sides.

use super::{Break, Law};

/// Breaks that one question is answered with at most: laws that repeat have any number of them.
pub(crate) const MOST_BREAKS: usize = 10_000;

/// Largest difference of two values that meet, beside the largest value of either part: parts are
/// written with nine digits or more.
const MEETS: f64 = 1e-9;

/// The same of two derivatives that do not jump, beside the largest of that derivative.
const AGREES: f64 = 1e-7;

/// Rounding error of a derivative, beside the largest that the other derivatives could make of it
/// over the length.
const ROUNDING: f64 = 1e-13;

/// The largest |f|, |f′|, … |f⁗| of a law over 0 ≤ x ≤ length, as far as 34 places show it. Each
/// derivative has a size of its own: a fast and small vibration has a large f‴, beside which every
/// jump of the value would be small.
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

    /// The larger one of each; a number that is none does not count.
    pub(super) fn with(self, other: Sizes) -> Self {
        Sizes(std::array::from_fn(|k| self.0[k].max(other.0[k])))
    }

    /// How far before an end its left side is looked at: near beside the length and beside what the
    /// law needs to change, far beside rounding.
    fn step(&self, length: f64) -> f64 {
        let change = 1e-4 * self.0[0] / self.0[1];
        let near = if change > 0.0 { change.min(1e-9 * length) } else { 1e-9 * length };
        near.max(64.0 * f64::EPSILON * length)
    }

    /// The difference that two jets may have in derivative k though nothing jumps, one of them
    /// carried on from `step` before, over about `length`.
    fn allowed(&self, k: usize, step: f64, length: f64) -> f64 {
        let Sizes(size) = self;
        let next = size[k + 1];
        if k == 0 {
            // x is rounded, and with a steep law so is f.
            return MEETS * size[0] + 8.0 * f64::EPSILON * length * next;
        }
        let others = (0..4).map(|j| size[j] * length.powi(j as i32 - k as i32)).fold(0.0, f64::max);
        AGREES * size[k] + 2.0 * step * next + ROUNDING * others
    }
}

/// The end of one part of a law and the beginning of the next.
pub(super) struct Seam {
    left: [f64; 4],
    right: [f64; 4],
    sizes: Sizes,
    step: f64,
    length: f64,
}

impl Seam {
    /// Between the end of `law` over `length` and what follows, lengths in x being about `shorter`.
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

    /// Between a value that is held and a part.
    pub(super) fn before(held: f64, right: [f64; 4], sizes: Sizes, length: f64) -> Self {
        Seam { left: [held, 0.0, 0.0, 0.0], right, sizes, step: 0.0, length }
    }

    /// The lowest derivative that jumps; `None` if none up to the third does.
    pub(super) fn order(&self) -> Option<usize> {
        (0..4).find(|&k| {
            let apart = (self.left[k] - self.right[k]).abs();
            let meets = apart <= self.sizes.allowed(k, self.step, self.length);
            // A derivative that is not a number jumps nowhere; a value that is none meets nothing.
            !meets && (k == 0 || !apart.is_nan())
        })
    }

    /// The value that the left side ends with.
    pub(super) fn end(&self) -> f64 {
        self.left[0]
    }
}

/// The jet of a law just before x, from `step` before it.
pub(super) fn left_jet(law: &Law, x: f64, step: f64) -> [f64; 4] {
    // The derivatives are carried on to x by Taylor's formula.
    let h = step;
    let [f, f1, f2, f3] = law.jet(x - step);
    let f4 = law.fourth(x - step);
    let f4 = if f4.is_finite() { f4 } else { 0.0 };
    let first = f1 + h * (f2 + 0.5 * h * f3);
    [f + h * (f1 + 0.5 * h * (f2 + h / 3.0 * f3)), first, f2 + h * (f3 + 0.5 * h * f4), f3 + h * f4]
}

/// All in one list, in order, the first [`MOST_BREAKS`] of them; of two breaks at one place the
/// lower order counts.
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

/// Breaks of one period that begins at `start`, over and over between two places: the first
/// [`MOST_BREAKS`] of them.
pub(super) fn repeated(one: &[Break], start: f64, period: f64, from: f64, to: f64) -> Vec<Break> {
    if one.is_empty() || period <= 0.0 {
        return Vec::new();
    }
    // One period earlier than it should be, for the sake of rounding.
    let first = ((from.max(f64::MIN) - start) / period).floor() - 1.0;
    let mut all: Vec<Break> = Vec::new();
    for turn in 0..MOST_BREAKS / one.len() + 3 {
        let moved = (first + turn as f64) * period;
        if start + moved > to {
            break;
        }
        // Where periods are shorter than rounding, many fall on one place.
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

/// The one of the lowest order, the first of these.
pub(super) fn sharpest(all: impl IntoIterator<Item = Break>) -> Option<Break> {
    all.into_iter().min_by_key(|found| found.order)
}

/// Values of a law at 65 places between two, by which it is known where it takes a value.
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

    /// The lowest and the highest of them.
    pub(super) fn range(&self) -> (f64, f64) {
        self.places.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (_, y)| {
            (low.min(*y), high.max(*y))
        })
    }

    /// Where the law takes the value `y`, no break of its own being between the two places, as far
    /// as the samples show it.
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

/// The first place between a and b that is beyond where f crosses zero: there a law has the
/// derivatives of its right side.
fn bisected(f: &dyn Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let sign = f(a).signum();
    let mut middle = a + 0.5 * (b - a);
    // Until no number is left between them.
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
