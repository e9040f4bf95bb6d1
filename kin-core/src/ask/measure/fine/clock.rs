//! Functions of time alone, such as laws of time, between the times of a motion.

use std::sync::Arc;

use kin_graph::Node;

use super::{MOST, SHORTEST, too_many};
use crate::model::formula::time as held;
use crate::numbers::enclosure::{Interval, ONE, Series};
use crate::outcome::error::Result;
use crate::solve::motion::Motion;
use crate::system::System;

/// The permitted error of the quintic of a part, as a share of the function's change in the part;
/// over many steps, of its change in all of them. \[-\]
const MISS: f64 = 1e-6;
const MISS_OF_STRETCH: f64 = 1e-8;

/// Rounding error of a function, relative to its values. \[-\]
const ROUNDING: f64 = 1e-13;

/// Times nearer than this share of a step are on the two sides of a break. \[-\]
const BESIDE: f64 = 1e-9;

/// The number of coefficients of Taylor's formula, and the number below which a bound says too
/// little.
const COEFFICIENTS: usize = 7;
const FEWEST: usize = 4;

/// The number of gaps between samples of a constraint without known bounds.
const GAPS: usize = 16;

/// The functions of time of the system of a motion.
pub(super) struct Clock<'a> {
    system: &'a System,
    motion: &'a Motion,
    sources: Vec<Source>,
    /// For each step, true if quintics through its ends follow all functions of time.
    plain: Vec<bool>,
}

/// A constraint that depends on time, with the nodes of its formula through which time enters;
/// `None` if they are unknown.
struct Source {
    block: usize,
    signals: Option<Arc<[Node]>>,
}

impl<'a> Clock<'a> {
    pub(super) fn new(system: &'a System, motion: &'a Motion) -> Self {
        let equations = system.equations();
        let source = |block: usize| {
            let constraint = equations.blocks[block].constraint.as_ref();
            let rows = constraint.facts().rows.len();
            let signals = constraint.formula(|table, _, _| {
                let formula = table.formula();
                (formula.rows.len() == rows).then(|| held::signals(formula).into())
            });
            Source { block, signals: signals.flatten() }
        };
        let sources = equations.moved_by_time().map(source).collect();
        let steps = motion.len().saturating_sub(1);
        let mut clock = Clock { system, motion, sources, plain: vec![false; steps] };
        clock.mark(0, steps);
        clock
    }

    /// Returns true if quintics through the ends of a step follow all functions of time.
    pub(super) fn is_plain(&self, step: usize) -> bool {
        self.plain.get(step).copied().unwrap_or(true)
    }

    /// Marks the steps that need no further times. Bounds over all steps decide, or else over each
    /// half.
    fn mark(&mut self, from: usize, to: usize) {
        if from >= to {
            return;
        }
        let times = &self.motion.times()[from..=to];
        let longest = times.windows(2).fold(0.0_f64, |m, pair| m.max((pair[1] - pair[0]).abs()));
        let single = to - from == 1;
        if self.follows([times[0], times[to - from]], (longest, single, from)) {
            self.plain[from..to].fill(true);
        } else if !single {
            let middle = from + (to - from) / 2;
            self.mark(from, middle);
            self.mark(middle, to);
        }
    }

    /// Returns the times within a step, in the order of the motion, between which all functions of
    /// time follow quintics. Errors: too many times.
    pub(super) fn cuts(&self, step: usize) -> Result<Vec<f64>> {
        if self.is_plain(step) {
            return Ok(Vec::new());
        }
        let from = self.motion.times()[step];
        let to = self.motion.times()[step + 1];
        let low = from.min(to);
        let high = from.max(to);
        let mut ends = vec![low, high];
        for (t, order) in breaks(self.system, self.motion, step) {
            let beside = (BESIDE * (high - low)).max(8.0 * f64::EPSILON * t.abs());
            // The second derivatives on the two sides differ.
            let sides = if order <= 2 { vec![t - beside, t, t + beside] } else { vec![t] };
            ends.extend(sides.into_iter().filter(|t| low < *t && *t < high));
        }
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let mut cuts = Vec::new();
        for pair in ends.windows(2) {
            self.halve([pair[0], pair[1]], step, SHORTEST * (high - low), &mut cuts)?;
            cuts.push(pair[1]);
        }
        cuts.pop();
        if to < from {
            cuts.reverse();
        }
        Ok(cuts)
    }

    /// Appends the times within a part that its functions of time need.
    fn halve(
        &self,
        [a, b]: [f64; 2],
        step: usize,
        shortest: f64,
        cuts: &mut Vec<f64>,
    ) -> Result<()> {
        if cuts.len() > MOST {
            return Err(too_many(self.motion, self.motion.times()[step]));
        }
        // The ends may be breaks, which belong to the next part.
        let edge = (BESIDE * (b - a)).max(2.0 * f64::EPSILON * a.abs().max(b.abs()));
        let inner = [a + edge, b - edge];
        if b - a <= shortest || inner[0] >= inner[1] || self.follows(inner, (b - a, true, step)) {
            return Ok(());
        }
        let middle = 0.5 * (a + b);
        self.halve([a, middle], step, shortest, cuts)?;
        cuts.push(middle);
        self.halve([middle, b], step, shortest, cuts)
    }

    /// Returns true if all functions of time follow quintics over steps of that length between two
    /// times.
    fn follows(&self, ends: [f64; 2], (length, single, step): (f64, bool, usize)) -> bool {
        self.sources.iter().all(|source| match self.over(source, ends) {
            Some(all) => {
                all.iter().all(|y| follows(y, length, if single { MISS } else { MISS_OF_STRETCH }))
            }
            None => single && self.samples_follow(source, ends, step),
        })
    }

    /// Returns bounds of a source between two times, or `None` if too little is known.
    fn over(&self, source: &Source, [a, b]: [f64; 2]) -> Option<Vec<Series>> {
        let signals = source.signals.as_ref()?;
        let t = Series::variable(Interval::new(a.min(b), a.max(b)), ONE, COEFFICIENTS);
        let constraint = &self.system.equations().blocks[source.block].constraint;
        let all = constraint.formula(|table, parameters, outside| {
            held::over_time(table.formula(), signals, t, parameters, outside)
        })?;
        all.iter().all(|y| y.len() >= FEWEST).then_some(all)
    }

    /// Tests by samples of C at constant coordinates whether quintics follow; sixth differences
    /// estimate the sixth derivative.
    fn samples_follow(&self, source: &Source, [a, b]: [f64; 2], step: usize) -> bool {
        let equations = self.system.equations();
        let block = &equations.blocks[source.block];
        let q = self.motion.q(step);
        let mut instant = equations.instant_at(a, q);
        let mut c = vec![0.0; block.rows().len()];
        let mut rows = vec![Vec::with_capacity(GAPS + 1); c.len()];
        for k in 0..=GAPS {
            equations.set_time(a + (b - a) * k as f64 / GAPS as f64, &mut instant);
            block.constraint.residual(&equations.at(block, &instant), &mut c);
            rows.iter_mut().zip(&c).for_each(|(row, c)| row.push(*c));
        }
        rows.iter().all(|row| is_smooth(row))
    }
}

/// The breaks of laws of time within a step of a motion, with the derivative that jumps.
pub(in crate::ask::measure) fn breaks(
    system: &System,
    motion: &Motion,
    step: usize,
) -> Vec<(f64, usize)> {
    let equations = system.equations();
    let from = motion.times()[step];
    let to = motion.times()[step + 1];
    let mut instant = equations.instant_at(from, motion.q(step));
    let mut found = Vec::new();
    for number in equations.moved_by_time() {
        let block = &equations.blocks[number];
        let mut begins = Vec::new();
        equations.set_time(from, &mut instant);
        block.constraint.laws(&equations.at(block, &instant), &mut |_, _, x| begins.push(x));
        equations.set_time(to, &mut instant);
        let mut begins = begins.into_iter();
        block.constraint.laws(&equations.at(block, &instant), &mut |_, law, end| {
            let Some(begin) = begins.next().filter(|begin| *begin != end) else { return };
            let at = |x: f64| from + (x - begin) / (end - begin) * (to - from);
            found.extend(law.breaks(begin, end).iter().map(|b| (at(b.x), b.order)));
        });
    }
    found
}

/// Returns true if a function of time with these bounds follows the quintic of a step of that
/// length.
fn follows(y: &Series, length: f64, miss: f64) -> bool {
    let last = y.len().min(COEFFICIENTS) - 1;
    // Uses Taylor's formula up to the sixth coefficient, or else the change of the last known
    // coefficient.
    let largest =
        if last + 1 == COEFFICIENTS { y.at(last).mag() } else { 2.0 * y.at(last).radius() };
    let off = largest * (0.5 * length).powi(last as i32);
    off <= miss * 2.0 * y.value().radius() || off <= ROUNDING * y.value().mag()
}

/// Returns true if samples at even distances follow a quintic.
fn is_smooth(row: &[f64]) -> bool {
    let (low, high) =
        row.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(*x), h.max(*x)));
    let difference = |stride: usize| {
        let size = |window: &[f64]| {
            let signs = [1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0];
            signs.iter().enumerate().map(|(k, sign)| sign * window[k * stride]).sum::<f64>().abs()
        };
        let half = GAPS as f64 / (2.0 * stride as f64);
        row.windows(6 * stride + 1).map(size).fold(0.0, f64::max) * half.powi(6) / 720.0
    };
    // Both estimates carry the rounding of a value.
    let rounding =
        64.0 * f64::EPSILON * low.abs().max(high.abs()) * (GAPS as f64 / 2.0).powi(6) / 720.0;
    difference(1).max(difference(2)) <= MISS * (high - low) + rounding
}
