//! A cure is tried before it is told: the mechanism with it must close, and what drives must have
//! something to drive.

use super::super::generic::Walk;
use crate::linear::Echelon;
use crate::numbers::random::Random;
use crate::solve::assembly::search::{self, Found};
use crate::solve::assembly::turned_over;
use crate::system::scaled::{Measures, Model};

/// Free motions that are tried one by one, and mixtures of all of them.
const BESIDE: usize = 12;
const MIXED: u64 = 4;

/// A mechanism with something changed or left out, to be put together.
#[derive(Clone, Copy)]
pub(crate) struct Trial<'a> {
    pub model: Model<'a>,
    pub t: f64,
    /// Equations that are left out.
    pub without: &'a [usize],
    /// Steps to least squares at most.
    pub steps: usize,
}

/// How much of the way a driver has to itself must be left; a share of a row of order 1.   \[-\]
const DRIVES: f64 = 1e-4;

impl Trial<'_> {
    /// The pose near another one at which it closes as it is meant.
    pub(crate) fn closed(&self, from: &[f64]) -> Option<Found> {
        let active = |row: usize| !self.without.contains(&row);
        let found = search::descend(self.model, from, self.t, &active, false, self.steps)
            .filter(|found| found.met)?;
        if turned_over::wrong(&self.model, &found.place.q, self.t, &active).is_empty() {
            return Some(found);
        }
        turned_over::mended(self.model, &found.place.q, self.t, &active, self.steps)
    }

    /// The same from the pose, or from beside it: where bodies stand in line, nothing says to which
    /// side they are to give way.
    pub(crate) fn closed_beside(&self, from: &[f64]) -> Option<Found> {
        const BESIDE: f64 = 0.1;
        let mut random = Random::new(7);
        let sizes = self.model.measure(from, self.t).sizes;
        let beside: Vec<f64> =
            from.iter().zip(&sizes).map(|(q, size)| q + BESIDE * size * random.number()).collect();
        self.closed(from).or_else(|| self.closed(&beside))
    }

    /// True if every one of these drivers' equations has something to drive at a pose: a motion of
    /// the joints along which it changes, and that leads somewhere. With no driver at all the
    /// joints must have some motion, unless by count they are a structure.
    pub(crate) fn moves(&self, found: &Found, drivers: &[usize]) -> bool {
        let model = &self.model;
        let measures = &found.measures;
        let q = &found.place.q;
        let walk = Walk { model, measures, open: &[], without: self.without, steps: self.steps };
        let free = free(model, measures, &found.place.point.values, self.without);
        if drivers.is_empty() {
            let joints = (0..model.m()).filter(|row| !self.without.contains(row)).count();
            return joints >= model.n()
                || ways(&free).iter().any(|v| walk.beside(q, self.t, v).is_some());
        }
        // In a toggle a driver drives nothing, so poses beside the toggle are tried.
        let beside = ways(&free).into_iter().filter_map(|v| walk.beside(q, self.t, &v));
        let poses: Vec<Vec<f64>> = beside.collect();
        drivers.iter().all(|row| poses.iter().any(|q| self.drives(q, measures, *row)))
    }

    /// True if drivers still agree a little later, where there are more of them than the joints
    /// leave freedoms. Without this check Kin could propose a length that fits at this moment and
    /// at no other.
    pub(crate) fn goes_on(&self, found: &Found) -> bool {
        /// Times at which they are compared, in units of the time in which the fastest driver moves
        /// something by one.   \[-\]
        const LATER: [f64; 3] = [0.03, 0.3, 1.0];
        let model = &self.model;
        let measures = &found.measures;
        let q = &found.place.q;
        let count = drivers(model, self.without).len();
        if count < 2 {
            return true;
        }
        let walk = Walk { model, measures, open: &[], without: self.without, steps: self.steps };
        let here = free(model, measures, &found.place.point.values, self.without);
        // At a change point the joints leave more than elsewhere.
        let beside = ways(&here).into_iter().filter_map(|v| walk.beside(q, self.t, &v));
        let left = beside.filter_map(|q| model.linearize(&q, self.t).ok());
        let least =
            left.map(|point| free(model, measures, &point.values, self.without).len()).min();
        if count <= least.unwrap_or(here.len()).min(here.len()) {
            return true;
        }
        LATER.iter().map(|later| self.t + later * measures.time).all(|t| {
            let later = Trial { t, ..*self };
            model.linearize(q, t).is_err() || later.closed(q).is_some()
        })
    }

    /// True if a driver's equation changes along a motion of the joints.
    fn drives(&self, q: &[f64], measures: &Measures, row: usize) -> bool {
        let Ok(point) = self.model.linearize(q, self.t) else { return false };
        let rows = self.model.scaled(&point.values, measures, &|k| k == row);
        let along =
            |v: &Vec<f64>| rows[row].iter().map(|(column, value)| value * v[*column]).sum::<f64>();
        free(&self.model, measures, &point.values, self.without)
            .iter()
            .any(|v| along(v).abs() > DRIVES)
    }
}

/// The motions that the joints leave, the largest share of each 1.
fn free(
    model: &Model<'_>,
    measures: &Measures,
    values: &[f64],
    without: &[usize],
) -> Vec<Vec<f64>> {
    /// A smallest gap is found to half the digits, so a cure is too.   \[-\]
    const LEAST: f64 = 1e-6;
    let joints =
        model.scaled(values, measures, &|row| !model.drives(row) && !without.contains(&row));
    let dense = |vector: Vec<(usize, f64)>| {
        let largest = vector.iter().fold(f64::MIN_POSITIVE, |m, (_, x)| m.max(x.abs()));
        let mut v = vec![0.0; model.n()];
        vector.into_iter().for_each(|(k, x)| v[k] = x / largest);
        v
    };
    Echelon::new(joints, model.n(), LEAST).null_space().into_iter().map(dense).collect()
}

/// The directions that are tried: each free motion, and where there are several also mixtures of
/// all of them. Loops that toggle together move together only, because each of them alone is locked
/// by the others.
fn ways(free: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut ways: Vec<Vec<f64>> = free.iter().take(BESIDE).cloned().collect();
    for seed in 0..if free.len() > 1 { MIXED } else { 0 } {
        let mut random = Random::new(seed);
        let mut way = vec![0.0; free[0].len()];
        for v in free {
            // Each motion takes part with a share that is not small, to either side.
            let share = random.number();
            let share = share + share.signum();
            way.iter_mut().zip(v).for_each(|(sum, x)| *sum += share * x);
        }
        let largest = way.iter().fold(f64::MIN_POSITIVE, |m, x| m.max(x.abs()));
        way.iter_mut().for_each(|x| *x /= largest);
        ways.push(way);
    }
    ways
}

/// The equations of driving constraints, of those that are not left out.
pub(crate) fn drivers(model: &Model<'_>, without: &[usize]) -> Vec<usize> {
    (0..model.m()).filter(|row| model.drives(*row) && !without.contains(row)).collect()
}
