//! The first pose of any mechanism: start after start, the same ones every time.

use super::squares::{Place, STEPS, Squares};
use super::turn;
use crate::layout::Unit;
use crate::model::{Measures, Model, Random};

/// How firmly preferred coordinates are held, stage by stage, against rows of norm 1.   \[-\]
const HOLDS: [f64; 3] = [1.0, 0.1, 0.0];

/// Where a search has ended, and how.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub place: Place,
    pub measures: Measures,
    /// Whether C = 0 holds there, in the rows that were asked for.
    pub met: bool,
    /// How many starts were tried.
    pub starts: usize,
}

/// The pose nearest the guess that meets the active rows; where no start leads to one, the place of the smallest gap.
/// `None` where nothing is finite.
pub(crate) fn search(model: Model<'_>, guess: &[f64], t: f64, active: &dyn Fn(usize) -> bool, starts: usize) -> Option<Found> {
    let guess = turn::turned(&model, guess, t, active);
    let mut best: Option<Found> = None;
    for start in 0..starts.max(1) {
        let known = best.as_ref().map(|found| &found.measures);
        let from = start_from(&model, &guess, known, start, starts);
        let Some(found) = descend(model, &from, t, active, start == 0) else { continue };
        let met = found.met;
        if met || best.as_ref().is_none_or(|best| found.place.merit < best.place.merit) {
            best = Some(Found { starts: start + 1, ..found });
        }
        if met {
            break;
        }
    }
    best.map(|found| if found.met { found } else { Found { starts: starts.max(1), ..found } })
}

/// Least squares from one start, measured anew where that has changed much.
pub(crate) fn descend(model: Model<'_>, from: &[f64], t: f64, active: &dyn Fn(usize) -> bool, preferred: bool) -> Option<Found> {
    let held: &[(usize, f64)] = if preferred { model.preferred } else { &[] };
    let mut measures = model.measure(from, t);
    let mut q = from.to_vec();
    let mut steps = 0;
    for round in 0.. {
        let stages: &[f64] = if round > 0 || held.is_empty() { &HOLDS[2..] } else { &HOLDS };
        let place = minimise(model, &measures, &q, t, active, held, stages)?;
        steps += place.steps;
        let met = model.met(&place.point, &place.q, &measures, active);
        let again = model.measure(&place.q, t);
        let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (0.25..4.0).contains(&(a / b)));
        if round == 2 || (close(&again.sizes, &measures.sizes) && close(&again.norms, &measures.norms)) {
            return Some(Found { place: Place { steps, ..place }, measures, met, starts: 1 });
        }
        (measures, q) = (again, place.q);
    }
    None
}

fn minimise(
    model: Model<'_>,
    measures: &Measures,
    from: &[f64],
    t: f64,
    active: &dyn Fn(usize) -> bool,
    held: &[(usize, f64)],
    stages: &[f64],
) -> Option<Place> {
    let mut q = from.to_vec();
    let (mut last, mut steps) = (None, 0);
    for &hold in stages {
        let holds = if hold > 0.0 { held.iter().map(|&(column, value)| (column, value, hold)).collect() } else { Vec::new() };
        let mut squares = Squares::new(model, measures, holds, false);
        (0..model.m()).filter(|row| !active(*row)).for_each(|row| squares.weights[row] = 0.0);
        let place = squares.minimise(squares.place(&q, t)?, STEPS);
        steps += place.steps;
        q.clone_from(&place.q);
        last = Some(Place { steps, ..place });
    }
    last
}

/// The guess; from the second start on with everything moved at random, more at later starts.
fn start_from(model: &Model<'_>, guess: &[f64], measures: Option<&Measures>, start: usize, starts: usize) -> Vec<f64> {
    if start == 0 {
        return guess.to_vec();
    }
    let reach = 3.0 * (start as f64 / starts as f64).sqrt();
    let mut random = Random::new(start as u64);
    let moved = |(column, q): (usize, &f64)| {
        let share = if model.layout.units[column] == Unit::One { 0.3 } else { 1.0 };
        let size = measures.map_or(1.0, |measures| measures.sizes[column]);
        q + share * reach * size * random.number()
    };
    guess.iter().enumerate().map(moved).collect()
}
