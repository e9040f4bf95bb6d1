//! Finds the pose to examine, and the constraints that cannot be satisfied there.

mod singular;

use super::cure::lengths;
use super::cure::slips::{self, Slip};
use super::cure::trial::Trial;
use super::gap::gap;
use super::nearest::nearest;
use super::order;
use super::search_under_way::Search;
use crate::coordinates::units::Unit;
use crate::linear::LeastSquares;
use crate::numbers::random::Random;
use crate::outcome::error::{Error, Result};
use crate::outcome::verdict::{Change, Gap, Size};
use crate::solve::assembly::SearchOptions;
use crate::solve::assembly::search::{self, Found};
use crate::solve::explain::Start;
use crate::system::scaled::{Measures, Model, Point};

/// A row with a residual above this share of the largest one takes part in a contradiction. \[-\]
const SHARE: f64 = 0.02;

/// The pose to examine.
pub(super) struct Placed {
    pub q: Vec<f64>,
    pub measures: Measures,
    pub gaps: Vec<Gap>,
    /// Tested changes that close the gaps. A designer would make these changes first.
    pub cures: Vec<Change>,
}

/// Returns a pose of the mechanism. If there is none, returns a pose with as few open constraints
/// as possible and the smallest possible residuals.
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
    Error::InvalidTimes { reason: format!("the equations have no finite value at t = {t}") }
}

impl Search<'_> {
    /// Returns the given pose, or a pose nearby from which the sum of squares falls further. If
    /// bodies are in line or drawn on one another, the sum can be stationary without being a
    /// minimum.
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

    /// Refines the pose to the last digit. Where two solutions coincide, C is zero within rounding
    /// at half of its digits, and the next digits decide whether the position is singular.
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

    /// Searches the cause in the order in which a designer would: a mistake in a point, a length
    /// out of scale, a driver, a length, a joint.
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
        // A run that has come this far has suitable lengths; a driver leads it beyond its reach.
        if drivers_alone && drawn.is_none() {
            return placed;
        }
        let mut fits = lengths::that_fit(self, &found, &part, &[], false);
        if drivers_alone {
            // Besides the driver the report names one length: the most likely one.
            fits.retain(|resize| !matches!(resize.of, Size::Point { .. }));
            fits.truncate(1);
        }
        let cures = if fits.is_empty() { Vec::new() } else { vec![Change::Resize { any: fits }] };
        Placed { cures, ..placed }
    }

    /// Returns the closure error that the user would have to allow if redundant equations
    /// contradict each other by no more than parts of ordinary accuracy. It is three times the
    /// error at this pose, because the error is larger at others, rounded up to one digit.
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
            // No constraint that can be released helps enough. The report still names the residuals
            // at the nearest pose.
            let rest: Vec<usize> =
                culprits(&self.model, &found, &open).take(self.options.released.max(1)).collect();
            open.extend(rest);
        }
        let gaps =
            open.iter().map(|block| gap(&self.model, &found, self.t, *block, starts)).collect();
        Placed { q: found.place.q, measures: found.measures, gaps, cures: Vec::new() }
    }

    /// Returns the constraint to release. It is one of the named constraints, or else a driver if
    /// the joints alone can be satisfied, or else the first joint without which the others are
    /// satisfied or nearest to it.
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

    /// Returns the drivers if there are several. A driver that holds a body in line with others
    /// takes no part in the residual along that line, although it prevents the body from moving
    /// aside.
    fn in_line(&self, open: &[usize]) -> Vec<usize> {
        let model = &self.model;
        let block_of = |row: usize| model.equations.block_index(row);
        let rows = order::of_rows(model).into_iter().filter(|row| model.drives(*row));
        let mut all: Vec<usize> =
            rows.filter_map(block_of).filter(|block| !open.contains(block)).collect();
        all.dedup();
        if (2..=TRIED).contains(&all.len()) { all } else { Vec::new() }
    }

    /// Returns the driver whose value is impossible: without it the rest can be satisfied, and it
    /// has something to drive.
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
            // If bodies are in line, nothing determines to which side they move without the driver.
            let next = match next.met {
                true => next,
                false => trial.closed_beside(&next.place.q).unwrap_or(next),
            };
            if !next.met {
                // Of too many drivers one is superfluous: the joints must close without any driver
                // and leave this one something to drive.
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

    /// Returns the first of these constraints without which the others can be satisfied, or else
    /// the one without which they are nearest to it.
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
            // Of two satisfied poses the first one stays, because their residuals are rounding.
            if best.as_ref().is_none_or(|(_, best)| {
                !best.met && (next.met || next.place.merit < best.place.merit)
            }) {
                best = Some((block, next));
            }
        }
        best.filter(|(_, best)| best.place.merit < (1.0 - HELPS) * found.place.merit)
    }

    /// Returns the pose with one more constraint released, as close to satisfying it as the others
    /// allow.
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

/// The largest number of constraints to try.
const TRIED: usize = 24;

/// A released constraint is reported only if it reduces the sum of squares by at least this share.
/// \[-\]
const HELPS: f64 = 0.1;

/// Returns true if the residual of a released constraint is not larger than its share in the
/// unsatisfied residuals suggests. A larger residual belongs to another assembly, which says
/// nothing about this one.
fn near(model: &Model<'_>, found: &Found, next: &Found, block: usize) -> bool {
    /// The largest ratio to the expected residual. \[-\]
    const EXPECTED: f64 = 4.0;
    // Both residuals use the same norms: those around the other pose.
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

/// Returns the constraints that take part in the contradiction, in the order in which the report
/// calls them superfluous.
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
