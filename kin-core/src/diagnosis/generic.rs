//! Nearby poses of the same assembly: random steps along what is free, back onto C = 0, with always the same random numbers.

use super::examine::{Orders, Ranked, ranked};
use crate::assembly::squares::Squares;
use crate::linear::{Echelon, Sparse};
use crate::model::{Measures, Model, Random};

/// Steps that are tried, of this size at most, in units of the model's length and of one radian.   \[-\]
const POSES: u64 = 3;
const REACH: [f64; 3] = [0.1, 0.03, 0.3];

/// A pose that has come back to within this share of its step has not moved.   \[-\]
const MOVED: f64 = 0.3;

/// A nearby pose and the rank there.
pub(super) struct Nearby {
    pub q: Vec<f64>,
    pub t: f64,
    pub ranked: Ranked,
}

/// The nearby pose of the highest rank; `None` where the mechanism cannot move, neither in the course of time nor with its drivers let go.
///
/// First everything moves on with time, drivers included; where that leads nowhere (drivers that stand still or contradict one another)
/// joints alone are kept.
pub(super) fn nearby(
    model: &Model<'_>,
    q: &[f64],
    t: f64,
    measures: &Measures,
    active: &dyn Fn(usize) -> bool,
    orders: &Orders,
) -> Option<Nearby> {
    walk(model, q, t, measures, active, true, orders)
        .or_else(|| walk(model, q, t, measures, &|row| active(row) && !model.drives(row), false, orders))
}

fn walk(
    model: &Model<'_>,
    q: &[f64],
    t: f64,
    measures: &Measures,
    active: &dyn Fn(usize) -> bool,
    time_is_free: bool,
    orders: &Orders,
) -> Option<Nearby> {
    let mut best: Option<Nearby> = None;
    for seed in 0..POSES {
        let mut random = Random::new(1 + seed);
        let tried = REACH.iter().find_map(|reach| {
            let v = tangent(model, q, t, measures, active, time_is_free, &mut random)?;
            step(model, (q, t), &v, *reach, measures, active, time_is_free)
        });
        let Some((q, t)) = tried else { continue };
        let Ok(point) = model.linearize(&q, t) else { continue };
        let ranked = ranked(model, &point.values, measures, orders);
        if best.as_ref().is_none_or(|best| ranked.rank > best.ranked.rank) {
            let highest = ranked.rank == model.n().min(model.m());
            best = Some(Nearby { q, t, ranked });
            if highest {
                break;
            }
        }
    }
    best
}

/// A random direction in which nothing changes to first order, the largest share 1; `None` where only time could go on.
fn tangent(
    model: &Model<'_>,
    q: &[f64],
    t: f64,
    measures: &Measures,
    active: &dyn Fn(usize) -> bool,
    time_is_free: bool,
    random: &mut Random,
) -> Option<Vec<f64>> {
    let n = model.n();
    let point = model.linearize(q, t).ok()?;
    let mut rows: Vec<Sparse> = model.scaled(&point.values, measures, active);
    if time_is_free {
        let c_t = model.c_t(q, t).ok()?;
        for (row, entries) in rows.iter_mut().enumerate().filter(|(row, _)| active(*row)) {
            entries.push((n, c_t[row] * measures.time / measures.norms[row]));
        }
    }
    let mut v = vec![0.0; n + 1];
    for vector in Echelon::new(rows, n + usize::from(time_is_free)).null_space() {
        let largest = vector.iter().fold(0.0_f64, |m, (_, x)| m.max(x.abs()));
        let share = random.number() / largest;
        vector.iter().for_each(|(k, x)| v[*k] += share * x);
    }
    let largest = v[..n].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    (largest > 1e-6 * v[n].abs() && largest > 0.0).then(|| v.iter().map(|x| x / largest).collect())
}

/// Whether the mechanism can move along v with its time standing still.
pub(super) fn moves(model: &Model<'_>, q: &[f64], t: f64, v: &[f64], measures: &Measures, active: &dyn Fn(usize) -> bool) -> bool {
    REACH.iter().any(|reach| step(model, (q, t), v, *reach, measures, active, false).is_some())
}

/// A step along v and back onto C = 0; `None` where that leads back, or nowhere.
fn step(
    model: &Model<'_>,
    (q, t): (&[f64], f64),
    v: &[f64],
    reach: f64,
    measures: &Measures,
    active: &dyn Fn(usize) -> bool,
    time_is_free: bool,
) -> Option<(Vec<f64>, f64)> {
    const STEPS: usize = 60;
    let n = model.n();
    let moved: Vec<f64> = q.iter().zip(v).zip(&measures.sizes).map(|((q, v), size)| q + reach * v * size).collect();
    let mut squares = Squares::new(*model, measures, Vec::new(), time_is_free);
    (0..model.m()).filter(|row| !active(*row)).for_each(|row| squares.weights[row] = 0.0);
    let from = squares.place(&moved, t + if time_is_free { reach * v[n] * measures.time } else { 0.0 })?;
    let place = squares.minimise(from, STEPS);
    let shares = place.q.iter().zip(q).zip(&measures.sizes).map(|((a, b), size)| ((a - b) / size).abs());
    let far = shares.fold(0.0_f64, f64::max) >= MOVED * reach;
    (far && model.met(&place.point, &place.q, measures, active)).then_some((place.q, place.t))
}
