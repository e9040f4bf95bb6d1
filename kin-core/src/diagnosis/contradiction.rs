//! The pose to look at, and what cannot be met there.

use serde::{Deserialize, Serialize};

use super::examine::Start;
use super::options::DiagnosisOptions;
use super::order;
use crate::assembly::options::Clock;
use crate::assembly::search::{self, Found};
use crate::assembly::squares::Squares;
use crate::error::{Error, Result};
use crate::model::{Measures, Model};

/// A share of the largest residual above this takes part in what cannot be met.   \[-\]
const SHARE: f64 = 0.02;

/// A constraint that cannot be met together with all others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Gap {
    /// The constraint.
    pub constraint: String,
    /// Its equations, as they are counted in the system.
    pub rows: Vec<usize>,
    /// Names of its equations, such as `B.x`.
    pub equations: Vec<String>,
    /// What is missing in each equation where all other constraints are met and this one as nearly as was found.   \[unit of the row\]
    pub residual: Vec<f64>,
    /// For a driver of one coordinate: the coordinate, what is asked of it, and where it stands at the nearest.   \[m or rad\]
    pub asks: Option<Asks>,
    /// Whether its equations depend on the others at nearby poses too: then they contradict one another. If not, something does not reach.
    pub lasting: bool,
    /// From how many starts a pose was looked for.
    pub starts: usize,
}

/// What a driver asks for and does not get.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Asks {
    /// The coordinate.
    pub coordinate: String,
    /// What is asked.   \[m or rad\]
    pub asked: f64,
    /// Where it stands.   \[m or rad\]
    pub stands: f64,
}

impl Gap {
    /// |C| of the constraint: the length of the gap for a joint that holds two points together.   \[unit of the row\]
    pub fn size(&self) -> f64 {
        self.residual.iter().map(|c| c * c).sum::<f64>().sqrt()
    }
}

/// The pose to look at.
pub(super) struct Placed {
    pub q: Vec<f64>,
    pub measures: Measures,
    pub gaps: Vec<Gap>,
}

/// A pose of the mechanism; where there is none, one at which as few constraints as possible are open, and these as little as possible.
pub(super) fn place(model: Model<'_>, start: Start<'_>, t: f64, options: &DiagnosisOptions) -> Result<Placed> {
    let all = |_: usize| true;
    let clock = options.search.clock();
    let found = match start {
        Start::Guess(q) => search::search(model, q, t, &all, &options.search),
        Start::Pose(q) => search::descend(model, q, t, &all, false, options.search.steps),
    };
    let q = match start {
        Start::Guess(q) | Start::Pose(q) => q,
    };
    let Some(found) = found else {
        let bad = model.linearize(q, t).err();
        return Err(bad.map_or_else(|| nowhere(t), |bad| model.not_finite(bad, q, t)));
    };
    if found.met {
        return Ok(Placed { q: found.place.q, measures: found.measures, gaps: Vec::new() });
    }
    Ok(let_go(&Search { model, t, options, clock }, found))
}

fn nowhere(t: f64) -> Error {
    Error::InvalidTimes { reason: format!("nothing is finite at t = {t}") }
}

/// What stays the same while constraints are let go.
struct Search<'a> {
    model: Model<'a>,
    t: f64,
    options: &'a DiagnosisOptions,
    clock: Clock,
}

/// Lets constraints go, one after the other, until the rest can be met; then brings them as near as the rest allows.
fn let_go(search: &Search<'_>, found: Found) -> Placed {
    let (starts, mut found) = (found.starts, found);
    let mut open: Vec<usize> = Vec::new();
    while !found.met && open.len() < search.options.let_go && !search.clock.is_up() {
        let Some((block, next)) = search.most_telling(&found, &open) else { break };
        open.push(block);
        found = next;
    }
    if !found.met {
        // Nothing that may be let go helps enough: what is off at the nearest place found is told all the same.
        let rest: Vec<usize> = culprits(&search.model, &found, &open).take(search.options.let_go.max(1)).collect();
        open.extend(rest);
    }
    let gaps = open.iter().map(|block| gap(&search.model, &found, search.t, *block, starts)).collect();
    Placed { q: found.place.q, measures: found.measures, gaps }
}

impl Search<'_> {
    /// The first constraint without which the others can be met; else the one without which they are nearest to it.
    fn most_telling(&self, found: &Found, open: &[usize]) -> Option<(usize, Found)> {
        /// What must be gone of the sum of squares.   \[-\]
        const HELPS: f64 = 0.1;
        let mut best: Option<(usize, Found)> = None;
        for block in culprits(&self.model, found, open) {
            let Some(next) = self.without(found, open, block) else { continue };
            if next.met && near(&self.model, found, &next, block) {
                return Some((block, next));
            }
            // Of two that are met the first stays: what is left of them is rounding.
            if best.as_ref().is_none_or(|(_, best)| !best.met && (next.met || next.place.merit < best.place.merit)) {
                best = Some((block, next));
            }
        }
        best.filter(|(_, best)| best.place.merit < (1.0 - HELPS) * found.place.merit)
    }

    /// The pose where one more constraint is let go, and as near to being met as the others allow.
    fn without(&self, found: &Found, open: &[usize], block: usize) -> Option<Found> {
        let (model, t, steps) = (self.model, self.t, self.options.search.steps);
        let rows: Vec<usize> = open.iter().chain([&block]).flat_map(|block| model.equations.blocks[*block].rows()).collect();
        let near = nearest(&model, &found.measures, &found.place.q, t, &|_| true, &rows, steps);
        search::descend(model, &near, t, &|row| !rows.contains(&row), false, steps)
    }
}

/// Whether a constraint that is let go is off by no more than its share in what could not be met lets one expect: by more it is so in
/// another assembly, which says nothing about this one.
fn near(model: &Model<'_>, found: &Found, next: &Found, block: usize) -> bool {
    /// What is within expectation.   \[-\]
    const EXPECTED: f64 = 4.0;
    // By the same norms: those of the other place are measured around it.
    let size = |at: &Found| {
        let rows = model.equations.blocks[block].rows();
        rows.map(|row| (at.place.point.c[row] / found.measures.norms[row]).powi(2)).sum::<f64>().sqrt()
    };
    let merit = found.place.merit;
    let shares = found.place.point.c.iter().zip(&found.measures.norms).map(|(c, norm)| (c / norm).abs());
    let largest = shares.clone().fold(0.0_f64, f64::max);
    let taking_part = shares.filter(|share| *share > SHARE * largest).count() as f64;
    size(next) * size(found) <= EXPECTED * merit && size(next) <= EXPECTED * (taking_part * merit).sqrt()
}

/// The constraints that take part in what cannot be met, the first that is called superfluous first.
fn culprits(model: &Model<'_>, found: &Found, open: &[usize]) -> impl Iterator<Item = usize> {
    /// So many are tried.
    const TRIED: usize = 24;
    let shares: Vec<f64> = found.place.point.c.iter().zip(&found.measures.norms).map(|(c, norm)| (c / norm).abs()).collect();
    let block_of = |row: usize| model.equations.blocks.partition_point(|block| block.rows().end <= row);
    let closed = |row: usize| !open.contains(&block_of(row));
    let largest = (0..model.m()).filter(|row| closed(*row)).fold(0.0_f64, |m, row| m.max(shares[row]));
    let mut blocks: Vec<usize> = Vec::new();
    for row in order::of_rows(model).into_iter().filter(|row| closed(*row) && shares[*row] > SHARE * largest) {
        if !blocks.contains(&block_of(row)) && blocks.len() < TRIED {
            blocks.push(block_of(row));
        }
    }
    blocks.into_iter()
}

/// The pose at which these rows are as nearly met as the other active ones allow, near the one given: the rows weigh ever less against the
/// others, and then the others are shifted by what they are still off, until they are met (method of multipliers; J. Nocedal, S. J. Wright,
/// Numerical Optimization, section 17.3). So at the smallest gap the equations that hold it open depend on one another to half the digits at least.
pub(super) fn nearest(
    model: &Model<'_>,
    measures: &Measures,
    from: &[f64],
    t: f64,
    active: &dyn Fn(usize) -> bool,
    rows: &[usize],
    steps: usize,
) -> Vec<f64> {
    /// What the rows weigh against the others, stage by stage, and the rounds of shifts after that, each of which is worth some five digits.   \[-\]
    const WEIGHTS: [f64; 3] = [3e-1, 3e-2, 3e-3];
    const ROUNDS: usize = 3;
    let mut q = from.to_vec();
    let mut squares = Squares::new(*model, measures, Vec::new(), false);
    (0..model.m()).filter(|row| !active(*row)).for_each(|row| squares.weights[row] = 0.0);
    for round in 0..WEIGHTS.len() + ROUNDS {
        match WEIGHTS.get(round) {
            Some(weight) => rows.iter().for_each(|row| squares.weights[*row] = *weight),
            None => {
                let Ok(point) = model.linearize(&q, t) else { break };
                let others = (0..model.m()).filter(|row| !rows.contains(row));
                others.for_each(|row| squares.shifts[row] += point.c[row]);
            }
        }
        let Some(place) = squares.place(&q, t) else { break };
        q = squares.minimise(place, steps).q;
    }
    q
}

fn gap(model: &Model<'_>, found: &Found, t: f64, block: usize, starts: usize) -> Gap {
    let block = &model.equations.blocks[block];
    let (rows, point) = (block.rows(), &found.place.point);
    Gap {
        constraint: block.name.clone(),
        equations: rows.clone().map(|row| model.equations.equation(row)).collect(),
        residual: point.c[rows.clone()].to_vec(),
        asks: asks(model, found, t, rows.clone()),
        rows: rows.collect(),
        lasting: false,
        starts,
    }
}

/// For a driver a q_j − f(t) = 0: where the coordinate should be.
fn asks(model: &Model<'_>, found: &Found, t: f64, rows: std::ops::Range<usize>) -> Option<Asks> {
    if rows.len() != 1 || !model.drives(rows.start) {
        return None;
    }
    let mut own = model.entries(&found.place.point.values).filter(|(row, _, value)| *row == rows.start && *value != 0.0);
    let (Some((_, column, value)), None) = (own.next(), own.next()) else { return None };
    let (stands, c) = (found.place.q[column], found.place.point.c[rows.start]);
    let mut q = found.place.q.clone();
    q[column] -= c / value;
    let reached = model.linearize(&q, t).is_ok_and(|point| point.c[rows.start].abs() <= 1e-9 * c.abs());
    reached.then(|| Asks { coordinate: model.layout.names[column].clone(), asked: q[column], stands })
}
