//! Finds the first pose of any mechanism by a search from several starts.
//!
//! The starts are the same in every run.

use super::levenberg_marquardt::{Iterate, LevenbergMarquardt};
use super::options::SearchOptions;
use super::{turn, turned_over};
use crate::coordinates::units::Unit;
use crate::numbers::random::Random;
use crate::system::scaled::{Measures, Model};

/// The weights of preferred coordinates, stage by stage, for rows of norm 1. \[-\]
const HOLDS: [f64; 3] = [1.0, 0.1, 0.0];

/// A preferred coordinate that ends this close is in the preferred assembly. \[rad, or typical
/// lengths\]
const NEAR: f64 = std::f64::consts::FRAC_PI_4;

/// The end of a search.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub place: Iterate,
    pub measures: Measures,
    /// True if C = 0 holds in the active rows.
    pub met: bool,
    /// False only if [`search`] found a position on the wrong branch of a constraint.
    pub meant: bool,
    /// The number of starts.
    pub starts: usize,
}

/// Returns the pose nearest to the guess that satisfies the active rows, in the preferred assembly
/// if one is found. If no start leads to a pose, returns the place of the smallest gap. Returns
/// `None` if nothing is finite.
pub(crate) fn search(
    model: Model<'_>,
    guess: &[f64],
    t: f64,
    active: &dyn Fn(usize) -> bool,
    options: &SearchOptions,
) -> Option<Found> {
    let guess = turn::turned(&model, guess, t, active);
    let sizes = model.measure(&guess, t).sizes;
    let clock = options.clock();
    let mut starts = 0;
    let mut best: Option<Found> = None;
    for start in 0..options.starts.max(1) {
        if start > 0 && clock.is_up() {
            break;
        }
        starts = start + 1;
        let mut from = start_from(&model, &guess, &sizes, start, options);
        model.preferred.iter().for_each(|(column, value)| from[*column] = *value);
        let Some(found) = descend(model, &from, t, active, true, options.steps) else { continue };
        let found = right_way_up(model, found, t, active, options.steps);
        let done = found.met && found.meant && distance(&model, &found) <= NEAR;
        if best.as_ref().is_none_or(|best| better(&model, &found, best)) {
            best = Some(found);
        }
        if done {
            break;
        }
    }
    best.map(|found| if found.met { found } else { Found { starts, ..found } })
}

/// Returns the given place, with bodies turned over if an axis is turned by 180°.
fn right_way_up(
    model: Model<'_>,
    found: Found,
    t: f64,
    active: &dyn Fn(usize) -> bool,
    steps: usize,
) -> Found {
    if !found.met || turned_over::wrong(&model, &found.place.q, t, active).is_empty() {
        return found;
    }
    turned_over::mended(model, &found.place.q, t, active, steps)
        .unwrap_or(Found { meant: false, ..found })
}

/// Returns true if a place is better. A pose is better than none, the right branch better than a
/// wrong one, then the nearer to preferred values; then the smaller gap.
fn better(model: &Model<'_>, new: &Found, known: &Found) -> bool {
    match (new.met, known.met) {
        (true, true) if new.meant != known.meant => new.meant,
        (true, true) => distance(model, new) < distance(model, known),
        // If nothing is satisfied, the guess shows the user's intention, so another place must be
        // clearly better.
        (false, false) => new.place.merit < 0.01 * known.place.merit,
        (new, _) => new,
    }
}

/// Returns the distance of the worst preferred coordinate from its value.
fn distance(model: &Model<'_>, found: &Found) -> f64 {
    super::distance(model.layout, model.preferred, &found.place.q, &found.measures.sizes)
}

/// Minimises from one start. If the sizes change much, it measures them again.
pub(crate) fn descend(
    model: Model<'_>,
    from: &[f64],
    t: f64,
    active: &dyn Fn(usize) -> bool,
    preferred: bool,
    steps: usize,
) -> Option<Found> {
    let held: &[(usize, f64)] = if preferred { model.preferred } else { &[] };
    let mut measures = model.measure(from, t);
    let mut q = from.to_vec();
    let mut taken = 0;
    for round in 0.. {
        let stages: &[f64] = if round > 0 || held.is_empty() { &HOLDS[2..] } else { &HOLDS };
        let place = minimise(model, &measures, &q, t, active, held, (stages, steps))?;
        taken += place.steps;
        let met = model.met(&place.point, &place.q, &measures, active);
        let again = model.measure(&place.q, t);
        let close =
            |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (0.25..4.0).contains(&(a / b)));
        if round == 2
            || (close(&again.sizes, &measures.sizes) && close(&again.norms, &measures.norms))
        {
            return Some(Found {
                place: Iterate { steps: taken, ..place },
                measures,
                met,
                meant: true,
                starts: 1,
            });
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
    (stages, most): (&[f64], usize),
) -> Option<Iterate> {
    let mut q = from.to_vec();
    let mut last = None;
    let mut steps = 0;
    for &hold in stages {
        let holds = if hold > 0.0 {
            held.iter().map(|&(column, value)| (column, value, hold)).collect()
        } else {
            Vec::new()
        };
        let mut minimiser = LevenbergMarquardt::new(model, measures, holds, false);
        (0..model.m()).filter(|row| !active(*row)).for_each(|row| minimiser.weights[row] = 0.0);
        let place = minimiser.minimise(minimiser.place(&q, t)?, most);
        steps += place.steps;
        q.clone_from(&place.q);
        last = Some(Iterate { steps, ..place });
    }
    last
}

/// Returns the guess, and from the second start on the guess with random changes that grow.
pub(crate) fn start_from(
    model: &Model<'_>,
    guess: &[f64],
    sizes: &[f64],
    start: usize,
    options: &SearchOptions,
) -> Vec<f64> {
    if start == 0 {
        return guess.to_vec();
    }
    let reach = 3.0 * (start as f64 / options.starts as f64).sqrt();
    let mut random =
        Random::new(options.seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(start as u64));
    let moved = |((q, size), unit): ((&f64, &f64), &Unit)| {
        let share = if *unit == Unit::One { 0.3 } else { 1.0 };
        q + share * reach * size * random.number()
    };
    guess.iter().zip(sizes).zip(&model.layout.units).map(moved).collect()
}
