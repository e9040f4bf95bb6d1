//! Finds nearby poses of the same assembly by random steps along free directions, each followed by
//! a correction to C = 0.
//!
//! The random numbers are the same in every run.

use super::nearest::nearest;
use super::rank::{Orders, Ranked, ranked};
use crate::linear::{Echelon, RANK, Sparse};
use crate::numbers::random::Random;
use crate::solve::assembly::levenberg_marquardt::LevenbergMarquardt;
use crate::system::scaled::{Measures, Model};

/// The sizes of steps; if one leads nowhere, the next is tried. In units of the model's length and
/// of a radian. \[-\]
const REACH: [f64; 3] = [0.1, 0.03, 0.3];

/// A pose that returns to within this share of its step has not moved. \[-\]
const MOVED: f64 = 0.3;

/// A nearby pose and its rank.
pub(super) struct Nearby {
    pub q: Vec<f64>,
    pub t: f64,
    pub ranked: Ranked,
}

/// A walk to nearby poses: the equations that it keeps, and its effort.
#[derive(Clone, Copy)]
pub(super) struct Walk<'a> {
    pub model: &'a Model<'a>,
    pub measures: &'a Measures,
    /// Equations that cannot be satisfied. Kin makes their residuals as small as the other
    /// equations allow.
    pub open: &'a [usize],
    /// The removed equations.
    pub without: &'a [usize],
    /// The largest number of least-squares steps.
    pub steps: usize,
}

/// The equations that a walk keeps, and whether time moves on.
#[derive(Clone, Copy, PartialEq)]
enum Rows {
    /// All equations, with time moving on.
    AllInTime,
    /// All equations at constant time.
    All,
    /// The equations that do not drive, at constant time.
    Joints,
}

impl Walk<'_> {
    /// Returns the nearby pose of the highest rank. Returns `None` if the mechanism cannot move,
    /// neither with time nor with its drivers released.
    ///
    /// First everything moves on with time, including the drivers. If that leads nowhere (drivers
    /// at rest, or contradictory ones), or if something is open (which time may close or open
    /// further), the walk keeps only the joints.
    pub(super) fn nearby(
        &self,
        q: &[f64],
        t: f64,
        poses: usize,
        orders: &Orders,
    ) -> Option<Nearby> {
        let in_time = if self.open.is_empty() {
            self.highest(q, t, Rows::AllInTime, poses, orders)
        } else {
            None
        };
        let full = self.model.n().min(self.model.m());
        if in_time.as_ref().is_some_and(|found| found.ranked.rank == full) {
            return in_time;
        }
        // A walk that keeps all equations may stay at a singular position: a motor at a dead centre
        // is at rest.
        let joints = self.highest(q, t, Rows::Joints, poses, orders);
        match (in_time, joints) {
            (Some(a), Some(b)) => Some(if b.ranked.rank > a.ranked.rank { b } else { a }),
            (a, b) => a.or(b),
        }
    }

    fn highest(
        &self,
        q: &[f64],
        t: f64,
        rows_kept: Rows,
        poses: usize,
        orders: &Orders,
    ) -> Option<Nearby> {
        let mut best: Option<Nearby> = None;
        for seed in 0..poses as u64 {
            let mut random = Random::new(1 + seed);
            let tried = REACH.iter().find_map(|reach| {
                let v = self.tangent(q, t, rows_kept, &mut random)?;
                self.step((q, t), &v, *reach, rows_kept)
            });
            let Some((q, t)) = tried else { continue };
            let Ok(point) = self.model.linearize(&q, t) else { continue };
            let ranked = ranked(self.model, &point.values, self.measures, orders, self.least());
            if best.as_ref().is_none_or(|best| ranked.rank > best.ranked.rank) {
                let highest = ranked.rank == self.model.n().min(self.model.m());
                best = Some(Nearby { q, t, ranked });
                if highest {
                    break;
                }
            }
        }
        best
    }

    /// Returns the pivot below which a pivot counts as zero. A smallest gap is accurate to half of
    /// the digits of a pose. \[-\]
    pub(super) fn least(&self) -> f64 {
        const OPEN: f64 = 1e-5;
        if self.open.is_empty() { RANK } else { OPEN }
    }

    fn keeps(&self, rows_kept: Rows, row: usize) -> bool {
        (rows_kept != Rows::Joints || !self.model.drives(row)) && !self.without.contains(&row)
    }

    /// Returns a random direction in which nothing changes to first order, with a largest component
    /// of 1. Returns `None` if only time could move on.
    fn tangent(&self, q: &[f64], t: f64, rows_kept: Rows, random: &mut Random) -> Option<Vec<f64>> {
        let Walk { model, measures, .. } = *self;
        let n = model.n();
        let time_is_free = rows_kept == Rows::AllInTime;
        let point = model.linearize(q, t).ok()?;
        let mut rows: Vec<Sparse> =
            model.scaled(&point.values, measures, &|row| self.keeps(rows_kept, row));
        if time_is_free {
            let c_t = model.c_t(q, t).ok()?;
            rows.iter_mut().enumerate().for_each(|(row, entries)| {
                entries.push((n, c_t[row] * measures.time / measures.norms[row]))
            });
        }
        let mut v = vec![0.0; n + 1];
        for vector in Echelon::new(rows, n + usize::from(time_is_free), self.least()).null_space() {
            let largest = vector.iter().fold(0.0_f64, |m, (_, x)| m.max(x.abs()));
            let share = random.number() / largest;
            vector.iter().for_each(|(k, x)| v[*k] += share * x);
        }
        let largest = v[..n].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        (largest > 1e-6 * v[n].abs() && largest > 0.0)
            .then(|| v.iter().map(|x| x / largest).collect())
    }

    /// Returns true if the mechanism can move along v at constant time; v is in units of the
    /// coordinates' sizes.
    pub(super) fn moves(&self, q: &[f64], t: f64, v: &[f64]) -> bool {
        REACH.iter().any(|reach| self.step((q, t), v, *reach, Rows::All).is_some())
    }

    /// Returns the pose to which the joints alone, with released drivers, can move along v.
    pub(super) fn beside(&self, q: &[f64], t: f64, v: &[f64]) -> Option<Vec<f64>> {
        let v: Vec<f64> = v.iter().copied().chain([0.0]).collect();
        REACH.iter().find_map(|reach| self.step((q, t), &v, *reach, Rows::Joints)).map(|(q, _)| q)
    }

    /// Makes a step along v and back onto C = 0. Returns `None` if that leads back or nowhere.
    fn step(
        &self,
        (q, t): (&[f64], f64),
        v: &[f64],
        reach: f64,
        rows_kept: Rows,
    ) -> Option<(Vec<f64>, f64)> {
        let Walk { model, measures, .. } = *self;
        let n = model.n();
        let time_is_free = rows_kept == Rows::AllInTime;
        let mut moved: Vec<f64> = q
            .iter()
            .zip(v)
            .zip(&measures.sizes)
            .map(|((q, v), size)| q + reach * v * size)
            .collect();
        let open: Vec<usize> =
            self.open.iter().copied().filter(|row| self.keeps(rows_kept, *row)).collect();
        if !open.is_empty() {
            moved = nearest(
                model,
                measures,
                &moved,
                t,
                &|row| self.keeps(rows_kept, row),
                &open,
                self.steps,
            );
        }
        let active = |row: usize| self.keeps(rows_kept, row) && !self.open.contains(&row);
        let mut minimiser = LevenbergMarquardt::new(*model, measures, Vec::new(), time_is_free);
        (0..model.m()).filter(|row| !active(*row)).for_each(|row| minimiser.weights[row] = 0.0);
        let from = minimiser
            .place(&moved, t + if time_is_free { reach * v[n] * measures.time } else { 0.0 })?;
        let place = minimiser.minimise(from, self.steps);
        let shares =
            place.q.iter().zip(q).zip(&measures.sizes).map(|((a, b), size)| ((a - b) / size).abs());
        let far = shares.fold(0.0_f64, f64::max) >= MOVED * reach;
        (far && model.met(&place.point, &place.q, measures, &active)).then_some((place.q, place.t))
    }
}
