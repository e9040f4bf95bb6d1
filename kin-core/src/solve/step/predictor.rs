//! Predicts the next position from the last solutions.
//!
//! The short formula is q + h q̇ + ½ h² q̈ from the last solution. After three equal steps of time
//! Kin can use the long formula: the polynomial through q̇ and q̈ at all three times (Hermite),
//! integrated over the step. The error of the long formula is proportional to h⁷, and the error of
//! the short formula to h³. If the grid is too coarse, the short formula is better. Kin uses the
//! formula that was nearer at the last time.

use wide::f64x4;

use crate::numbers::lanes::lanewise::gone;
use crate::numbers::padded::Padded;
use crate::solve::newton::largest;

/// The weights of q̇ (times h) and of q̈ (times h²) at the last three times, latest first.
const RATES: [f64; 3] = [-949.0 / 240.0, 38.0 / 15.0, 581.0 / 240.0];
const SECOND_RATES: [f64; 3] = [637.0 / 240.0, 4.5, 173.0 / 240.0];

/// Steps of time that differ by less than this share are equal.   \[-\]
const EQUAL: f64 = 1e-9;

/// The finished steps of time: the length of the last one, and the number of equal ones.
#[derive(Clone)]
struct Pace {
    h: f64,
    equal: usize,
}

impl Pace {
    /// The pace of a run that has not begun.
    const NONE: Pace = Pace { h: f64::NAN, equal: 0 };

    /// Records the end of a step h.
    fn advance(&mut self, h: f64) {
        self.equal = if is_same(h, self.h) { self.equal + 1 } else { 1 };
        self.h = h;
    }

    /// Returns true if the last three times are a step h apart.
    fn knows(&self, h: f64) -> bool {
        self.equal >= 2 && is_same(h, self.h)
    }
}

pub(in crate::solve) fn is_same(h: f64, other: f64) -> bool {
    (h - other).abs() <= EQUAL * h.abs()
}

/// The position a step after the last solution, from the velocities and accelerations at three
/// times with the same step.
#[derive(Clone, Copy)]
struct Long([f64x4; 3], [f64x4; 3]);

impl Long {
    /// Creates the weights for a step h.
    #[inline(always)]
    fn new(h: f64) -> Self {
        let all =
            |weights: [f64; 3], share: f64| weights.map(|weight| f64x4::splat(weight * share));
        Long(all(RATES, h), all(SECOND_RATES, h * h))
    }

    /// Returns the position from q, and from the velocities and accelerations, latest first.
    #[inline(always)]
    fn position(&self, q: f64x4, [x, y, z]: [f64x4; 3], [u, v, w]: [f64x4; 3]) -> f64x4 {
        let Long([a, b, c], [d, e, f]) = *self;
        q + ((a * x + b * y + c * z) + (d * u + e * v + f * w))
    }
}

/// The velocities and accelerations at the two times before the last one, and which formula to use.
#[derive(Clone)]
pub(in crate::solve) struct Predictor {
    past: [Rates; 2],
    pace: Pace,
    trusted: bool,
}

/// q̇ and q̈ at one time.
#[derive(Clone)]
struct Rates {
    qd: Padded,
    qdd: Padded,
}

/// The last solution.
#[derive(Clone, Copy)]
pub(in crate::solve) struct Last<'a> {
    pub q: &'a Padded,
    pub qd: &'a Padded,
    pub qdd: &'a Padded,
}

impl Predictor {
    pub(in crate::solve) fn new(n: usize) -> Self {
        let rates = || Rates { qd: Padded::new(n, 0.0), qdd: Padded::new(n, 0.0) };
        Predictor { past: [rates(), rates()], pace: Pace::NONE, trusted: true }
    }

    /// Writes the position a step h after the last solution into `q`.
    pub(in crate::solve) fn predict(&self, h: f64, last: Last<'_>, q: &mut Padded) {
        if self.trusted && self.pace.knows(h) {
            self.long(h, last)
                .zip(q.whole_mut())
                .for_each(|(predicted, q)| *q = predicted.to_array());
        } else {
            short(h, last).zip(q.whole_mut()).for_each(|(predicted, q)| *q = predicted.to_array());
        }
    }

    /// Compares both formulas with the end `q` of the step h, which took Newton steps.
    pub(in crate::solve) fn compare(&mut self, h: f64, last: Last<'_>, q: &[f64], sizes: &[f64]) {
        if self.pace.knows(h) {
            self.trusted = far(self.long(h, last), q, sizes) <= far(short(h, last), q, sizes);
        }
    }

    /// Records the end of a step h: the data of the last solution become the past, and their place
    /// is free for new ones.
    pub(in crate::solve) fn advance(&mut self, h: f64, qd: &mut Padded, qdd: &mut Padded) {
        self.pace.advance(h);
        self.past.swap(0, 1);
        std::mem::swap(&mut self.past[0].qd, qd);
        std::mem::swap(&mut self.past[0].qdd, qdd);
    }

    /// Undoes the step: restores the velocities and accelerations of the last solution.
    pub(in crate::solve) fn retreat(&mut self, qd: &mut Padded, qdd: &mut Padded) {
        std::mem::swap(&mut self.past[0].qd, qd);
        std::mem::swap(&mut self.past[0].qdd, qdd);
        self.forget();
    }

    /// Discards the data of times before the last one.
    pub(in crate::solve) fn forget(&mut self) {
        self.pace = Pace::NONE;
    }

    /// Returns q̇ and q̈ before the last step.
    pub(in crate::solve) fn before(&self) -> [&Padded; 2] {
        [&self.past[0].qd, &self.past[0].qdd]
    }

    fn long(&self, h: f64, last: Last<'_>) -> impl Iterator<Item = f64x4> {
        let long = Long::new(h);
        let [one, two] = &self.past;
        let rates = quads(last.qd).zip(quads(&one.qd)).zip(quads(&two.qd));
        let second_rates = quads(last.qdd).zip(quads(&one.qdd)).zip(quads(&two.qdd));
        quads(last.q)
            .zip(rates)
            .zip(second_rates)
            .map(move |((q, ((x, y), z)), ((u, v), w))| long.position(q, [x, y, z], [u, v, w]))
    }
}

fn quads(numbers: &Padded) -> impl Iterator<Item = f64x4> {
    numbers.whole().iter().map(|four| f64x4::new(*four))
}

/// Returns q + h q̇ + ½ h² q̈.
fn short(h: f64, Last { q, qd, qdd }: Last<'_>) -> impl Iterator<Item = f64x4> {
    let (h, half) = (f64x4::splat(h), f64x4::splat(0.5 * h));
    quads(q).zip(quads(qd)).zip(quads(qdd)).map(move |((q, qd), qdd)| q + gone(h, half, [qd, qdd]))
}

/// Returns the distance of a prediction from Newton's solution, in units of the coordinates' sizes.
fn far(predicted: impl Iterator<Item = f64x4>, q: &[f64], sizes: &[f64]) -> f64 {
    largest(
        predicted
            .flat_map(f64x4::to_array)
            .zip(q)
            .zip(sizes)
            .map(|((predicted, q), size)| (predicted - q).abs() / size),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(x: f64) -> Padded {
        Padded::new(1, x)
    }

    /// q = sin t, predicted at t = 1 from what is known a step h apart.
    fn error(h: f64, known: usize) -> f64 {
        let mut predictor = Predictor::new(1);
        for k in (1..known).rev() {
            let t = 1.0 - h * (k + 1) as f64;
            predictor.advance(h, &mut one(t.cos()), &mut one(-t.sin()));
        }
        let t = 1.0 - h;
        let mut q = one(0.0);
        predictor.predict(
            h,
            Last { q: &one(t.sin()), qd: &one(t.cos()), qdd: &one(-t.sin()) },
            &mut q,
        );
        (q[0] - 1.0_f64.sin()).abs()
    }

    #[test]
    fn error_falls_by_the_third_power_and_after_three_times_by_the_seventh() {
        for (known, order) in [(1, 3.0), (2, 3.0), (3, 7.0)] {
            let found = (error(0.2, known) / error(0.1, known)).log2();
            assert!((found - order).abs() < 0.6, "{known} times known: order {found}");
        }
        assert!(error(0.01, 3) < 1e-15);
    }

    #[test]
    fn short_formula_is_used_where_the_long_one_was_farther_off() {
        let mut predictor = Predictor::new(1);
        let last = Last { q: &one(0.0), qd: &one(1.0), qdd: &one(0.0) };
        predictor.advance(1.0, &mut one(5.0), &mut one(0.0));
        predictor.advance(1.0, &mut one(-5.0), &mut one(0.0));
        let mut q = one(0.0);
        predictor.predict(1.0, last, &mut q);
        assert!(q[0].abs() > 2.0);
        predictor.compare(1.0, last, &[1.1], &[1.0]);
        predictor.predict(1.0, last, &mut q);
        assert_eq!(q[0], 1.0);
    }

    #[test]
    fn another_step_of_time_begins_anew() {
        let mut predictor = Predictor::new(1);
        [0.1, 0.1].iter().for_each(|h| predictor.advance(*h, &mut one(0.0), &mut one(0.0)));
        assert!(predictor.pace.knows(0.1 * (1.0 + 1e-12)) && !predictor.pace.knows(0.05));
        predictor.advance(0.05, &mut one(0.0), &mut one(0.0));
        assert!(!predictor.pace.knows(0.05));
    }
}
