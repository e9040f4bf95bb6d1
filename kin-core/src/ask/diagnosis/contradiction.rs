//! The pose to look at, and what cannot be met there.

mod singular;

use super::cure::lengths;
use super::cure::slips::{self, Slip};
use super::cure::trial::Trial;
use super::gap::gap;
use super::nearest::nearest;
use super::order;
use super::search_under_way::Search;
use crate::linear::LeastSquares;
use crate::model::error::{Error, Result};
use crate::model::units::Unit;
use crate::model::verdict::{Change, Gap, Size};
use crate::numbers::random::Random;
use crate::solve::assembly::SearchOptions;
use crate::solve::assembly::search::{self, Found};
use crate::solve::explain::Start;
use crate::system::scaled::{Measures, Model, Point};

/// A share of the largest residual above this takes part in what cannot be met.   \[-\]
const SHARE: f64 = 0.02;

/// The pose to look at.
pub(super) struct Placed {
    pub q: Vec<f64>,
    pub measures: Measures,
    pub gaps: Vec<Gap>,
    /// Changes that have been tried and close the gaps; a designer would make them first.
    pub cures: Vec<Change>,
}

/// A pose of the mechanism; where there is none, one at which as few constraints as possible are
/// open, and these as little as possible.
pub(super) fn place(
    model: Model<'_>,
    start: Start<'_>,
    t: f64,
    options: &SearchOptions,
) -> Result<Placed> {
    let all = |_: usize| true;
    let clock = options.clock();
    let found = match start {
        Start::Guess(q) => search::search(model, q, t, &all, options),
        Start::Pose(q) => search::descend(model, q, t, &all, false, options.steps),
    };
    let (q, drawn) = match start {
        Start::Guess(q) => (q, Some(q)),
        Start::Pose(q) => (q, None),
    };
    let Some(found) = found else {
        let bad = model.linearize(q, t).err();
        return Err(bad.map_or_else(|| nowhere(t), |bad| model.not_finite(bad, q, t)));
    };
    let search = Search { model, t, options, clock };
    let found = if found.met { found } else { search.off_saddles(found) };
    if found.met {
        let q = singular::settled(&model, search.polished(&found), t, &found.measures);
        return Ok(Placed { q, measures: found.measures, gaps: Vec::new(), cures: Vec::new() });
    }
    let mut placed = search.suspected(found, drawn);
    if let Some(drawn) = drawn {
        placed.gaps.iter_mut().for_each(|gap| gap.seen_from(model.layout, drawn));
    }
    Ok(placed)
}

fn nowhere(t: f64) -> Error {
    Error::InvalidTimes { reason: format!("nothing is finite at t = {t}") }
}

impl Search<'_> {
    /// The place found, or one beside it from which the sum of squares falls further: where bodies
    /// are in line, or drawn one on the other, the sum can be level without being least.
    fn off_saddles(&self, found: Found) -> Found {
        const TRIES: u64 = 4;
        const BESIDE: f64 = 0.05;
        const LOWER: f64 = 0.999;
        let mut best = found;
        for seed in 0..TRIES {
            let mut random = Random::new(101 + seed);
            let sizes = &best.measures.sizes;
            let beside: Vec<f64> = best
                .place
                .q
                .iter()
                .zip(sizes)
                .map(|(q, size)| q + BESIDE * size * random.number())
                .collect();
            let Some(next) =
                search::descend(self.model, &beside, self.t, &|_| true, false, self.options.steps)
            else {
                continue;
            };
            if next.met || next.place.merit < LOWER * best.place.merit {
                best = Found { starts: best.starts, ..next };
            }
            if best.met || self.is_up() {
                break;
            }
        }
        best
    }

    /// The pose to the last digit. Where two solutions coincide C is met to rounding at half its
    /// digits already, and the next ones decide whether the position is called singular.
    fn polished(&self, found: &Found) -> Vec<f64> {
        const STEPS: usize = 40;
        let model = &self.model;
        let Measures { sizes, norms, .. } = &found.measures;
        let mut least_squares = LeastSquares::new(model.m(), model.n(), &model.equations.entries);
        let size = |point: &Point| {
            point.c.iter().zip(norms).map(|(c, norm)| (c / norm).powi(2)).sum::<f64>()
        };
        let mut q = found.place.q.clone();
        let mut point = found.place.point.clone();
        for _ in 0..STEPS {
            let scale = |entry: &Option<(usize, usize)>| {
                entry.map_or(0.0, |(row, column)| sizes[column] / norms[row])
            };
            let values: Vec<f64> = model
                .equations
                .entries
                .iter()
                .zip(&point.values)
                .map(|(entry, value)| scale(entry) * value)
                .collect();
            if !least_squares.factor(values.iter().copied(), 1e-20) {
                break;
            }
            let y = least_squares.solve(point.c.iter().zip(norms).map(|(c, norm)| -c / norm));
            let next: Vec<f64> =
                q.iter().zip(y).zip(sizes).map(|((q, y), size)| q + y * size).collect();
            match model.linearize(&next, self.t) {
                Ok(lower) if size(&lower) < 0.9 * size(&point) => (q, point) = (next, lower),
                _ => break,
            }
        }
        q
    }

    /// Finds the culprit, in the order in which a designer asks: a slip of the pen, a length out of
    /// scale, a driver, a length, a joint.
    fn suspected(&self, found: Found, drawn: Option<&[f64]>) -> Placed {
        if let Some(misfit) = self.allowance(&found) {
            return Placed { cures: vec![Change::Allow { misfit }], ..self.release(found, &[]) };
        }
        let part: Vec<usize> = culprits(&self.model, &found, &[]).collect();
        let length = self
            .model
            .layout
            .units
            .iter()
            .position(|unit| *unit == Unit::Metre)
            .map_or(1.0, |k| found.measures.sizes[k]);
        let slip = drawn.and_then(|drawn| slips::find(self, drawn, length));
        if let Some(Slip { change, block }) = slip {
            return Placed { cures: vec![change], ..self.release(found, &[block]) };
        }
        let fits = lengths::that_fit(self, &found, &part, &[], true);
        if !fits.is_empty() {
            let joints: Vec<usize> = part
                .iter()
                .copied()
                .filter(|block| !self.model.equations.blocks[*block].drives)
                .collect();
            return Placed {
                cures: vec![Change::Resize { any: fits }],
                ..self.release(found, &joints)
            };
        }
        let placed = self.release(found.clone(), &[]);
        let drivers_alone =
            placed.gaps.iter().all(|gap| gap.rows.iter().all(|row| self.model.drives(*row)));
        // A run that has come so far has the lengths it needs; a driver leads it to where it cannot
        // go.
        if drivers_alone && drawn.is_none() {
            return placed;
        }
        let mut fits = lengths::that_fit(self, &found, &part, &[], false);
        if drivers_alone {
            // Beside the driver one length is told: the likeliest.
            fits.retain(|resize| !matches!(resize.of, Size::Point { .. }));
            fits.truncate(1);
        }
        let cures = if fits.is_empty() { Vec::new() } else { vec![Change::Resize { any: fits }] };
        Placed { cures, ..placed }
    }

    /// The misfit that would have to be allowed of redundant equations that contradict one
    /// another by no more than parts of ordinary accuracy do: three times their error at this pose,
    /// because it is larger at others, to one digit.
    fn allowance(&self, found: &Found) -> Option<f64> {
        const ORDINARY: f64 = 1e-5;
        let shares =
            found.place.point.c.iter().zip(&found.measures.norms).map(|(c, norm)| (c / norm).abs());
        let off = 3.0 * shares.fold(0.0_f64, f64::max);
        let digit = 10.0_f64.powf(off.log10().floor());
        (self.model.m() > self.model.n() && off < ORDINARY && digit > 0.0)
            .then(|| format!("{:.0e}", (off / digit).ceil() * digit).parse().ok())?
    }

    /// Lets constraints go, one after the other, until the rest can be met; then brings them as
    /// near as the rest allows. Those named go first.
    fn release(&self, found: Found, first: &[usize]) -> Placed {
        let starts = found.starts;
        let mut found = found;
        let mut open: Vec<usize> = Vec::new();
        while !found.met && open.len() < self.options.released && !self.is_up() {
            let Some((block, next)) = self.most_telling(&found, &open, first) else { break };
            open.push(block);
            found = next;
        }
        if !found.met {
            // Nothing that may be let go helps enough: what is off at the nearest place found is
            // told all the same.
            let rest: Vec<usize> =
                culprits(&self.model, &found, &open).take(self.options.released.max(1)).collect();
            open.extend(rest);
        }
        let gaps =
            open.iter().map(|block| gap(&self.model, &found, self.t, *block, starts)).collect();
        Placed { q: found.place.q, measures: found.measures, gaps, cures: Vec::new() }
    }

    /// The constraint to let go: one of those named, else a driver, if the joints can be met
    /// without the drivers; else the first joint without which the others can be met, or are
    /// nearest to it.
    fn most_telling(
        &self,
        found: &Found,
        open: &[usize],
        first: &[usize],
    ) -> Option<(usize, Found)> {
        let part: Vec<usize> = culprits(&self.model, found, open).collect();
        let drives = |block: &usize| self.model.equations.blocks[*block].drives;
        let named: Vec<usize> =
            first.iter().copied().filter(|block| part.contains(block)).collect();
        if !named.is_empty() {
            return self.best_of(found, open, &named);
        }
        let mut drivers: Vec<usize> = part.iter().copied().filter(|block| drives(block)).collect();
        if drivers.is_empty() {
            drivers = self.in_line(open);
        }
        if let Some(driver) = self.driver(found, open, drivers.into_iter()) {
            return Some(driver);
        }
        let joints: Vec<usize> = part.iter().copied().filter(|block| !drives(block)).collect();
        self.best_of(found, open, &joints).or_else(|| self.best_of(found, open, &part))
    }

    /// The drivers where there are several: one that holds a body in line with others takes no part
    /// in what is missing along that line, although it is what keeps the body from giving way.
    fn in_line(&self, open: &[usize]) -> Vec<usize> {
        let model = &self.model;
        let block_of = |row: usize| model.equations.block_index(row);
        let rows = order::of_rows(model).into_iter().filter(|row| model.drives(*row));
        let mut all: Vec<usize> =
            rows.filter_map(block_of).filter(|block| !open.contains(block)).collect();
        all.dedup();
        if (2..=TRIED).contains(&all.len()) { all } else { Vec::new() }
    }

    /// The driver that asks for what cannot be: without it the rest can be met, and it had
    /// something to drive.
    fn driver(
        &self,
        found: &Found,
        open: &[usize],
        drivers: impl Iterator<Item = usize>,
    ) -> Option<(usize, Found)> {
        let equations = self.model.equations;
        let released = |block: usize| {
            open.iter().copied().chain([block]).flat_map(|block| equations.blocks[block].rows())
        };
        let mut best: Option<(usize, Found)> = None;
        for block in drivers {
            if self.is_up() {
                break;
            }
            let without: Vec<usize> = released(block).collect();
            let trial = Trial {
                model: self.model,
                t: self.t,
                without: &without,
                steps: self.options.steps,
            };
            let own: Vec<usize> = equations.blocks[block].rows().collect();
            let Some(next) = self.without(found, open, block) else { continue };
            // Where bodies stand in line, nothing says to which side they are to give way without
            // it.
            let next = match next.met {
                true => next,
                false => trial.closed_beside(&next.place.q).unwrap_or(next),
            };
            if !next.met {
                // One of several drivers too many: the joints must close without any, and leave
                // this one something to drive.
                let none: Vec<usize> = without
                    .iter()
                    .copied()
                    .chain((0..self.model.m()).filter(|row| self.model.drives(*row)))
                    .collect();
                let joints = Trial { without: &none, ..trial };
                let helps = next.place.merit < (1.0 - HELPS) * found.place.merit;
                if helps
                    && joints
                        .closed(&next.place.q)
                        .is_some_and(|closed| joints.moves(&closed, &own))
                {
                    let better = best
                        .as_ref()
                        .is_none_or(|(_, best)| !best.met && next.place.merit < best.place.merit);
                    best = if better { Some((block, next)) } else { best };
                }
                continue;
            }
            if !trial.moves(&next, &own) {
                continue;
            }
            if near(&self.model, found, &next, block) {
                return Some((block, next));
            }
            if best.as_ref().is_none_or(|(_, best)| !best.met) {
                best = Some((block, next));
            }
        }
        best
    }

    /// The first of these without which the others can be met; else the one without which they are
    /// nearest to it.
    fn best_of(&self, found: &Found, open: &[usize], blocks: &[usize]) -> Option<(usize, Found)> {
        let mut best: Option<(usize, Found)> = None;
        for &block in blocks {
            if self.is_up() {
                break;
            }
            let Some(next) = self.without(found, open, block) else { continue };
            if next.met && near(&self.model, found, &next, block) {
                return Some((block, next));
            }
            // Of two that are met the first stays: what is left of them is rounding.
            if best.as_ref().is_none_or(|(_, best)| {
                !best.met && (next.met || next.place.merit < best.place.merit)
            }) {
                best = Some((block, next));
            }
        }
        best.filter(|(_, best)| best.place.merit < (1.0 - HELPS) * found.place.merit)
    }

    /// The pose where one more constraint is let go, and as near to being met as the others allow.
    fn without(&self, found: &Found, open: &[usize], block: usize) -> Option<Found> {
        let model = self.model;
        let t = self.t;
        let steps = self.options.steps;
        let rows: Vec<usize> = open
            .iter()
            .chain([&block])
            .flat_map(|block| model.equations.blocks[*block].rows())
            .collect();
        let near = nearest(&model, &found.measures, &found.place.q, t, &|_| true, &rows, steps);
        search::descend(model, &near, t, &|row| !rows.contains(&row), false, steps)
    }
}

/// Constraints that are tried at most.
const TRIED: usize = 24;

/// A constraint that is let go is reported only if the sum of squares loses at least this
/// share.   \[-\]
const HELPS: f64 = 0.1;

/// True if a constraint that is let go is off by no more than its share in the unmet residuals lets
/// one expect: one that is off by more is so in another assembly, which says nothing about this
/// one.
fn near(model: &Model<'_>, found: &Found, next: &Found, block: usize) -> bool {
    /// The largest ratio to the expected error that still counts as expected.   \[-\]
    const EXPECTED: f64 = 4.0;
    // Both sizes take the same norms: those of the other place are measured around it.
    let size = |at: &Found| {
        let rows = model.equations.blocks[block].rows();
        rows.map(|row| (at.place.point.c[row] / found.measures.norms[row]).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    let merit = found.place.merit;
    let shares =
        found.place.point.c.iter().zip(&found.measures.norms).map(|(c, norm)| (c / norm).abs());
    let largest = shares.clone().fold(0.0_f64, f64::max);
    let taking_part = shares.filter(|share| *share > SHARE * largest).count() as f64;
    size(next) * size(found) <= EXPECTED * merit
        && size(next) <= EXPECTED * (taking_part * merit).sqrt()
}

/// The constraints that take part in what cannot be met, the first that is called superfluous
/// first.
fn culprits(model: &Model<'_>, found: &Found, open: &[usize]) -> impl Iterator<Item = usize> {
    let shares: Vec<f64> = found
        .place
        .point
        .c
        .iter()
        .zip(&found.measures.norms)
        .map(|(c, norm)| (c / norm).abs())
        .collect();
    let block_of =
        |row: usize| model.equations.blocks.partition_point(|block| block.rows().end <= row);
    let closed = |row: usize| !open.contains(&block_of(row));
    let largest =
        (0..model.m()).filter(|row| closed(*row)).fold(0.0_f64, |m, row| m.max(shares[row]));
    let mut blocks: Vec<usize> = Vec::new();
    for row in order::of_rows(model)
        .into_iter()
        .filter(|row| closed(*row) && shares[*row] > SHARE * largest)
    {
        if !blocks.contains(&block_of(row)) && blocks.len() < TRIED {
            blocks.push(block_of(row));
        }
    }
    blocks.into_iter()
}
