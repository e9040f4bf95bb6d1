//! Tests a cure before it is reported: the mechanism with the cure must close, and its drivers must
//! have something to drive.

use super::super::generic::Walk;
use crate::linear::Echelon;
use crate::numbers::random::Random;
use crate::solve::assembly::search::{self, Found};
use crate::solve::assembly::turned_over;
use crate::system::scaled::{Measures, Model};

/// The largest number of free motions to test alone, and of mixtures of all of them.
const BESIDE: usize = 12;
const MIXED: u64 = 4;

/// A mechanism with a change or with removed equations, to be assembled.
#[derive(Clone, Copy)]
pub(crate) struct Trial<'a> {
    pub model: Model<'a>,
    pub t: f64,
    /// The removed equations.
    pub without: &'a [usize],
    /// The largest number of least-squares steps.
    pub steps: usize,
}

/// The smallest change of a driver's row along a free motion, for rows of order 1. \[-\]
const DRIVES: f64 = 1e-4;

impl Trial<'_> {
    /// Returns the pose near another one at which the mechanism closes on the right branch.
    pub(crate) fn closed(&self, from: &[f64]) -> Option<Found> {
        let active = |row: usize| !self.without.contains(&row);
        let found = search::descend(self.model, from, self.t, &active, false, self.steps)
            .filter(|found| found.met)?;
        if turned_over::wrong(&self.model, &found.place.q, self.t, &active).is_empty() {
            return Some(found);
        }
        turned_over::mended(self.model, &found.place.q, self.t, &active, self.steps)
    }

    /// Returns such a pose from the given one or from beside it. If bodies are in line, nothing
    /// determines to which side they move.
    pub(crate) fn closed_beside(&self, from: &[f64]) -> Option<Found> {
        const BESIDE: f64 = 0.1;
        let mut random = Random::new(7);
        let sizes = self.model.measure(from, self.t).sizes;
        let beside: Vec<f64> =
            from.iter().zip(&sizes).map(|(q, size)| q + BESIDE * size * random.number()).collect();
        self.closed(from).or_else(|| self.closed(&beside))
    }

    /// Returns true if every one of these drivers' equations has something to drive at a pose: a
    /// motion of the joints that changes it and leads somewhere. Without drivers the joints must
    /// have some motion, unless by count they form a structure.
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
        // In a toggle a driver drives nothing, so Kin also tests poses beside the toggle.
        let beside = ways(&free).into_iter().filter_map(|v| walk.beside(q, self.t, &v));
        let poses: Vec<Vec<f64>> = beside.collect();
        drivers.iter().all(|row| poses.iter().any(|q| self.drives(q, measures, *row)))
    }

    /// Returns true if drivers still agree a little later, where there are more drivers than
    /// freedoms. Without this check Kin could propose a length that fits at this time only.
    pub(crate) fn goes_on(&self, found: &Found) -> bool {
        /// The times of this comparison, in units of the time in which the fastest driver moves
        /// something by one. \[-\]
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
        // At a change point the joints leave more freedoms than elsewhere.
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

    /// Returns true if a driver's equation changes along a motion of the joints.
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

/// Returns the motions that the joints allow, each with a largest component of 1.
fn free(
    model: &Model<'_>,
    measures: &Measures,
    values: &[f64],
    without: &[usize],
) -> Vec<Vec<f64>> {
    /// The smallest pivot. A smallest gap is accurate to half of the digits, and so is a cure.
    /// \[-\]
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

/// Returns the directions to test: each free motion, and mixtures of all if there are several.
/// Loops that toggle together move only together, because the others lock each single one.
fn ways(free: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut ways: Vec<Vec<f64>> = free.iter().take(BESIDE).cloned().collect();
    for seed in 0..if free.len() > 1 { MIXED } else { 0 } {
        let mut random = Random::new(seed);
        let mut way = vec![0.0; free[0].len()];
        for v in free {
            // Each motion has a component that is not small, in either direction.
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

/// Returns the equations of the drivers that are not removed.
pub(crate) fn drivers(model: &Model<'_>, without: &[usize]) -> Vec<usize> {
    (0..model.m()).filter(|row| model.drives(*row) && !without.contains(row)).collect()
}
