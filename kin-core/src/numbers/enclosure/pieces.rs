//! Computes interval bounds of piecewise functions.
//!
//! To test that two adjacent pieces of a law meet, the code compares the bounds of both pieces. The
//! bounds must touch at the seam and must be narrow at the seam. The code treats rounded numbers,
//! such as the position and the value at which a piece begins, as exact. The code detects a jump
//! that is larger than rounding. If the bounds are too wide to exclude a jump, the result is
//! unknown.

use super::interval::{Interval, ONE};
use super::series::{ORDER, Series, Turns, UNKNOWN};

/// The most pieces at once: the bounds over more pieces are too wide to be useful.
const MOST: usize = 64;

/// The gap that rounding may leave between two pieces, as a share of the largest number in them,
/// and in units of the last place of the seam.   \[-\]
const ROUNDING: f64 = 1e-12;
const PLACES: f64 = 16.0 * f64::EPSILON;

/// The largest gap between pieces that meet, whatever its cause.   \[-\]
const APART: f64 = 1e-9;

impl Interval {
    /// Returns bounds of x with the rounding errors of numbers of size `size`.
    pub(crate) fn near(x: f64, size: f64) -> Self {
        Interval::from(x) + Interval::ball(PLACES * size)
    }
}

/// A function of one number, with bounds.
type Piece<'a> = &'a dyn Fn(&Series) -> Option<Series>;

/// Returns a function of x that is `piece(k, x)` between seam k − 1 and seam k; the seams increase.
pub(crate) fn piecewise(
    x: &Series,
    seams: &[f64],
    piece: &dyn Fn(usize, &Series) -> Option<Series>,
) -> Option<Series> {
    let agreement = |k: usize| {
        let from = k.checked_sub(1).and_then(|before| seams.get(before));
        let [one, other]: [Piece<'_>; 2] = [&|x| piece(k, x), &|x| piece(k + 1, x)];
        agreement([one, other], [seams[k]; 2], [from.copied(), seams.get(k + 1).copied()])
    };
    along(x, seams, piece, &agreement)
}

/// Returns the same function as [`piecewise`]; `agreement(k)` is the number of equal coefficients
/// of both pieces at seam k.
fn along(
    x: &Series,
    seams: &[f64],
    piece: &dyn Fn(usize, &Series) -> Option<Series>,
    agreement: &dyn Fn(usize) -> Option<usize>,
) -> Option<Series> {
    if x.is_open() {
        return Some(UNKNOWN);
    }
    let around = |seam: &f64| Interval::near(*seam, *seam);
    let seam = |k: usize| seams.get(k).map(around);
    let values = x.value();
    let first = seams.partition_point(|seam| around(seam).hi() < values.lo());
    let mut whole: Option<Series> = None;
    for k in first..=seams.len() {
        let from = k.checked_sub(1).and_then(seam).map_or(f64::NEG_INFINITY, Interval::lo);
        let to = seam(k).map_or(f64::INFINITY, Interval::hi);
        let Some(part) = values.common(Interval::new(from, to)) else { break };
        if k - first > MOST {
            return Some(UNKNOWN);
        }
        let y = piece(k, &x.with_value(part))?;
        whole = Some(match whole.zip(k.checked_sub(1)) {
            None => y,
            Some((before, seam)) => before.joined(&y, agreement(seam)?),
        });
    }
    let y = whole?;
    Some(if x.is_constant() && y.len() > 0 { Series::constant(y.value()) } else { y })
}

/// Returns how many coefficients, from the first, agree at the seam between two pieces. `others`
/// are the other ends of both pieces, if they have any. No piece ends nearer to 0 than the next one
/// begins.
fn agreement(pieces: [Piece<'_>; 2], at: [f64; 2], others: [Option<f64>; 2]) -> Option<usize> {
    let of = |k: usize, x: Interval| pieces[k](&Series::variable(x, ONE, ORDER + 1));
    let exact = [of(0, Interval::from(at[0]))?, of(1, Interval::from(at[1]))?];
    let around = [of(0, Interval::near(at[0], at[0]))?, of(1, Interval::near(at[1], at[1]))?];
    let mut all = around.to_vec();
    for (k, other) in others.into_iter().enumerate() {
        all.extend(other.map_or(Some(None), |other| {
            of(k, Interval::from(at[k]).hull(Interval::from(other))).map(Some)
        })?);
    }
    let place = PLACES * at[0].abs();
    let same = (0..=ORDER).take_while(|&j| {
        let size = all
            .iter()
            .map(|series| series.at(j).mag())
            .filter(|size| size.is_finite())
            .fold(0.0, f64::max);
        let slope = (j + 1) as f64 * (around[0].at(j + 1).mag() + around[1].at(j + 1).mag());
        let rounding = (ROUNDING * size + place * slope).min(APART * size) + f64::MIN_POSITIVE;
        around[0].at(j).meets(around[1].at(j))
            && (exact[0].at(j) - exact[1].at(j)).mag() <= rounding
    });
    Some(same.count())
}

/// Returns a periodic function of x: `one` of the distance from x to the last beginning of a
/// period.
pub(crate) fn repeated(
    x: &Series,
    start: f64,
    period: f64,
    one: &dyn Fn(&Series) -> Option<Series>,
) -> Option<Series> {
    let Some(local) = wound(&x.plus(-start), period) else { return Some(UNKNOWN) };
    let periods = local.value() / Interval::from(period);
    let first = periods.lo().floor();
    let last = periods.hi();
    let repeats = || agreement([one, one], [period, 0.0], [Some(0.0), Some(period)]);
    if !(last - first <= MOST as f64 && first.abs() < 1e9) {
        // The values over one whole period contain those of every x.
        let whole = one(
            &local.with_value(Interval::near(0.0, period).hull(Interval::near(period, period)))
        )?;
        return Some(whole.joined(&whole, repeats()?));
    }
    let seams: Vec<f64> =
        (1..=(last - first) as u32).map(|k| (first + f64::from(k)) * period).collect();
    let piece = |k: usize, x: &Series| {
        let begin = Interval::from(first + k as f64) * Interval::from(period);
        let local = *x - Series::constant(begin);
        // A number outside the period, by rounding, counts as the end of the period.
        let inside = Interval::near(0.0, begin.mag()).hull(Interval::near(period, begin.mag()));
        local.value().common(inside).map_or(Some(UNKNOWN), |inside| one(&local.with_value(inside)))
    };
    along(&local, &seams, &piece, &|_| repeats())
}

/// Returns x for a function with a period: whole turns of x that are periods, up to rounding, do
/// not change the function.
fn wound(x: &Series, period: f64) -> Option<Series> {
    let Turns { unit, most } = x.turns();
    if x.turns().is_none() {
        return Some(*x);
    }
    let turns = Interval::pi(2.0 * f64::from(unit));
    let count = (turns.mid() / period).round();
    let lost = (turns - Interval::from(period) * Interval::from(count)).mag();
    // The error of so many periods, and of those between x and the first period.
    let all = Interval::ball(lost)
        * Interval::from(f64::from(most) + (x.value() / Interval::from(period)).mag() + 1.0);
    (lost <= 4.0 * f64::EPSILON * turns.mag())
        .then(|| x.up_to(Turns::NONE).with_value(x.value() + all))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A turn differs slightly from the period that replaces it: the error includes each turn by
    /// which the angle may be wrong, and each turn between the number and zero.
    #[test]
    fn what_turns_lose_is_in_the_number() {
        let x = Series::variable(Interval::from(3.0 * TAU), ONE, ORDER + 1);
        let lost = (Interval::pi(2.0) - Interval::from(TAU)).mag();
        let found = wound(&x.up_to(Turns { unit: 1, most: 2 }), TAU).unwrap();
        let off = found.value() - x.value();
        assert!(
            found.turns().is_none()
                && off.lo() < -5.9 * lost
                && off.hi() > 5.9 * lost
                && off.mag() < 6.0 * lost + 1e-14,
            "{off:?}"
        );
        let zero = Series::variable(Interval::from(0.0), ONE, ORDER + 1);
        let found = wound(&zero.up_to(Turns { unit: 1, most: 2 }), TAU).unwrap().value();
        assert!(found.hi() > 2.99 * lost && found.mag() < 3.01 * lost, "{found:?}");
        let many =
            wound(&x.up_to(Turns { unit: 1, most: 100_000 }), TAU).unwrap().value() - x.value();
        assert!(many.hi() > 1e5 * lost && many.mag() < 1.001e5 * lost, "{many:?}");
        assert!(
            [100.0, 0.9 * TAU, TAU * (1.0 + 1e-14)].iter().all(|period| wound(
                &x.up_to(Turns::ONE),
                *period
            )
            .is_none())
        );
    }
}
