//! Tests whether both ends of a step show the whole effect of time within the step: a motor may
//! move forward and return within the step.
//!
//! Time enters an equation through signals, functions w(t) that do not depend on q: laws of time,
//! sin ω t, and combinations of them. Over a step h a signal differs from its quadratic polynomial
//! at either end by at most ⅙ h³ max |w‴|, or by ½ h² times the range of w″ if w″ jumps. Kin
//! computes bounds of w‴ and w″ from the formula of the equation and from its laws
//! ([`crate::extend::LawFunction::over`]), for many steps at once. If the signals cannot move the
//! position further than the permitted error of a prediction, the step passes the test.
//!
//! For constraints without known bounds (user-defined laws without bounds, the dual route,
//! hand-written constraints) Kin samples C at constant q, at the eighths of the step.
//!
//! A signal that changes direction within the step leaves the range between its ends. The motion
//! may then pass a change point smoothly in both directions, and neither end of the step shows the
//! change point. So the signal may leave the range between its ends by no more than the permitted
//! error of a prediction.

mod sampled;

use std::collections::HashMap;
use std::sync::Arc;

use kin_graph::Node;

use super::check::{EASY, REACH, SAFE};
use crate::model::formula::Table;
use crate::model::formula::time as held;
use crate::numbers::enclosure::{Interval, ONE, Series};
use crate::system::evaluate::{Equations, Instant};

/// The number of steps for which the effect of a signal on q counts as known, and the number of
/// such checks before bounds that depend on q are computed again.
const KNOWN: u32 = 64;
const LOOKS: u32 = 4;

/// The factor by which q may have become easier to move since the last check, in addition to the
/// change of the smallest pivot. \[-\]
const DRIFT: f64 = 2.0;

/// Beyond this distance the equations are not tested for straightness. \[-\]
const FARTHEST: f64 = 1e3;

/// The number of coefficients of Taylor's formula.
const COEFFICIENTS: usize = 4;

/// Computes how residuals of the equations move the position.
pub(crate) trait Lever {
    /// Returns the instant of the position at the end of the step.
    fn instant(&self) -> &Instant;

    /// Returns max_j |v_j| / s_j of C_q v = b. The right side is zero except for the rows from
    /// `first` on.
    fn moved(&mut self, first: usize, b: &[f64]) -> f64;

    /// Returns max_j |C_q⁻¹ (C_q v)_q v|_j / s_j for the last v, or infinity if it is unknown.
    fn bend(&mut self) -> f64;

    /// Returns max_j |v_j| of the angles in the last v.
    fn turned(&self) -> f64;

    /// Returns true if C_q may be singular within this multiple of the last v.
    fn is_singular_within(&mut self, factor: f64) -> bool;
}

/// One step of time, with the position at its end.
#[derive(Clone, Copy)]
pub(crate) struct Span<'a> {
    pub equations: &'a Equations,
    pub from: f64,
    pub to: f64,
    /// The smaller of the smallest pivots at both ends.
    pub pivot: f64,
}

/// The functions of time of a system.
#[derive(Clone)]
pub(crate) struct Drive {
    sources: Vec<Source>,
    /// True if the ends of any step show everything.
    ends_suffice: bool,
    /// Bounds hold between these times; the next bounds are computed for a stretch of the same
    /// length.
    stretch: [f64; 2],
    longest: f64,
    /// The bound of the displacement of q by signals, as a polynomial in the length of a step, and
    /// the smallest pivot at that time.
    off: Bound,
    pivot: f64,
    /// The number of steps that need no check, and of checks that need no new bounds.
    steps: u32,
    looks: u32,
    /// The number of steps that samples may decide without computing their effect on q.
    samples: u32,
    /// The instant for samples.
    scratch: Option<Instant>,
}

/// A constraint that depends on time.
#[derive(Clone)]
struct Source {
    block: usize,
    /// The nodes of its formula through which time enters; `None` if it is sampled.
    signals: Option<Arc<[Node]>>,
    /// True if C_q does not depend on time: then bounds and slopes are equal for every q.
    apart: bool,
    is_sampled: bool,
    terms: Vec<Term>,
}

/// A signal, or a sampled row, and its effect.
#[derive(Clone)]
struct Term {
    /// The slopes of the rows of the constraint by the signal.
    slopes: Vec<f64>,
    bound: Bound,
    /// max_j |dq_j| / s_j for one unit of the signal; NaN until it is needed.
    lever: f64,
}

/// The bound e_0 + e_1 h + e_2 h² + e_3 h³.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Bound([f64; COEFFICIENTS]);

impl Bound {
    /// Bounds the distance of a function of time from its quadratic polynomials. Returns `None` if
    /// it is unknown.
    fn of(y: &Series) -> Option<Self> {
        let mut bound = Bound::default();
        let last = y.len().min(COEFFICIENTS).checked_sub(1)?;
        let c = y.at(last);
        // Taylor's formula up to the third degree. If an earlier coefficient jumps, its range
        // counts.
        bound.0[last] = if last == 3 { c.mag() } else { 2.0 * c.radius() };
        // If the function may change direction within the step, the distance by which it may leave
        // the range between both ends.
        match last {
            2 | 3 if y.at(1).contains(0.0) => bound.0[2] += 0.25 * y.at(2).mag(),
            1 if y.at(1).contains(0.0) => bound.0[1] += 0.5 * y.at(1).mag(),
            _ => {}
        }
        bound.0.iter().all(|x| x.is_finite()).then_some(bound)
    }

    #[inline]
    fn at(&self, h: f64) -> f64 {
        let [a, b, c, d] = self.0;
        a + h * (b + h * (c + h * d))
    }

    fn add(&mut self, factor: f64, other: &Bound) {
        self.0
            .iter_mut()
            .zip(other.0)
            .filter(|(_, x)| *x > 0.0)
            .for_each(|(sum, x)| *sum += factor * x);
    }
}

impl Drive {
    pub(crate) fn new(equations: &Equations) -> Self {
        // Constraints of one kind share their formula, so time enters them in the same places.
        let mut known: HashMap<*const Table, Arc<[Node]>> = HashMap::new();
        let mut source = |block: usize| {
            let constraint = equations.blocks[block].constraint.as_ref();
            let facts = constraint.facts();
            let signals = constraint.formula(|table, _, _| {
                let of = |formula| {
                    known
                        .entry(std::ptr::from_ref(table))
                        .or_insert_with(|| held::signals(formula).into())
                        .clone()
                };
                Some(table.formula())
                    .filter(|formula| formula.rows.len() == facts.rows.len())
                    .map(of)
            });
            Source {
                block,
                signals: signals.flatten(),
                apart: !facts.dependence.c_q_on_t,
                is_sampled: false,
                terms: Vec::new(),
            }
        };
        let sources: Vec<Source> = equations.moved_by_time().map(&mut source).collect();
        Drive {
            ends_suffice: sources.is_empty(),
            sources,
            stretch: [f64::NAN; 2],
            longest: f64::INFINITY,
            off: Bound::default(),
            pivot: 0.0,
            steps: 0,
            looks: 0,
            samples: 0,
            scratch: None,
        }
    }

    /// Returns true if earlier checks show that the step certainly hides nothing.
    #[inline]
    pub(crate) fn ends_suffice(&mut self, from: f64, to: f64, pivot: f64) -> bool {
        if self.ends_suffice {
            return true;
        }
        let known = self.steps > 0 && self.covers(from, to);
        self.steps = self.steps.saturating_sub(1);
        known && DRIFT * self.off.at((to - from).abs()) * self.pivot <= EASY * pivot * pivot
    }

    /// Returns true if no signal bends over all times: a signal that is a straight function of laws
    /// hides nothing, at any velocity. Notes it for all steps.
    #[cold]
    pub(crate) fn ends_always_suffice(&mut self, equations: &Equations, instant: &Instant) -> bool {
        let all = self.bound(equations, instant, [f64::NEG_INFINITY, f64::INFINITY], false);
        let terms = || self.sources.iter().flat_map(|source| &source.terms);
        self.ends_suffice = all
            && self.sources.iter().all(|source| source.signals.is_some() && !source.is_sampled)
            && terms().all(|term| term.bound == Bound::default());
        if !self.ends_suffice {
            self.forget(equations);
        }
        self.ends_suffice
    }

    /// Discards all bounds, because laws have changed.
    pub(crate) fn forget(&mut self, equations: &Equations) {
        self.ends_suffice = equations.moved_by_time().next().is_none();
        (self.stretch, self.longest) = ([f64::NAN; 2], f64::INFINITY);
        (self.steps, self.looks, self.samples) = (0, 0, 0);
    }

    fn covers(&self, from: f64, to: f64) -> bool {
        self.stretch[0] <= from.min(to) && from.max(to) <= self.stretch[1]
    }

    /// Returns true if the position may be led away unseen, too far for certainty. This uses all
    /// methods at their full cost.
    #[cold]
    pub(crate) fn hides(
        &mut self,
        Span { equations, from, to, pivot }: Span<'_>,
        lever: &mut dyn Lever,
    ) -> bool {
        let h = (to - from).abs();
        // The position is the same at every computation.
        self.sources
            .iter_mut()
            .flat_map(|source| &mut source.terms)
            .for_each(|term| term.lever = f64::NAN);
        // First the known bounds, then bounds over a longer stretch, then bounds over the step
        // alone.
        for reach in [None, Some(self.longest.max(h)), Some(h)] {
            let known = match reach {
                None => self.covers(from, to) && self.looks > 0,
                Some(reach) => self.bound(
                    equations,
                    lever.instant(),
                    [from, from + reach.copysign(to - from)],
                    reach == h,
                ),
            };
            if !known {
                continue;
            }
            self.looks = self.looks.saturating_sub(1);
            self.sample(equations, lever.instant(), [from, to]);
            self.weigh(equations, lever);
            // A bound over more than the step is useful if it decides later steps without a check.
            let room = if reach == Some(h) { 1.0 } else { DRIFT };
            if room * self.off.at(h) <= EASY * pivot {
                self.rely(pivot, reach);
                return false;
            }
        }
        (self.longest, self.steps, self.looks, self.samples) = (2.0 * h, 0, 0, 0);
        !self.is_straight(equations, h, lever)
    }

    /// Keeps the present bounds for some steps.
    fn rely(&mut self, pivot: f64, reach: Option<f64>) {
        let sampled = self.sources.iter().any(|source| source.is_sampled);
        (self.pivot, self.steps) = (pivot, if sampled { 0 } else { KNOWN });
        self.samples = if sampled { KNOWN } else { 0 };
        if let Some(reach) = reach {
            self.longest = 2.0 * reach;
            self.looks =
                if self.sources.iter().all(|source| source.apart) { u32::MAX } else { LOOKS };
            self.ends_suffice = !sampled
                && self.looks == u32::MAX
                && reach.is_infinite()
                && self.off == Bound::default();
        }
    }

    /// Computes bounds over a stretch of time. Returns false if some are unknown. Over a single
    /// step it samples constraints without bounds.
    fn bound(
        &mut self,
        equations: &Equations,
        instant: &Instant,
        [from, to]: [f64; 2],
        single: bool,
    ) -> bool {
        let t = Series::variable(Interval::new(from.min(to), from.max(to)), ONE, COEFFICIENTS);
        for source in &mut self.sources {
            let known = source.bounds(equations, t);
            if known.is_none() && source.signals.is_some() && !single {
                return false;
            }
            source.take(equations, instant, known);
        }
        self.stretch = [from.min(to), from.max(to)];
        true
    }

    /// Computes how far all signals may move q.
    fn weigh(&mut self, equations: &Equations, lever: &mut dyn Lever) {
        self.off = Bound::default();
        for source in &mut self.sources {
            let first = equations.blocks[source.block].rows().start;
            for term in source.terms.iter_mut().filter(|term| term.bound != Bound::default()) {
                if term.lever.is_nan() {
                    term.lever = lever.moved(first, &term.slopes);
                }
                self.off.add(term.lever, &term.bound);
            }
        }
    }

    /// Returns true if the equations are nearly straight along each of the signals, over its
    /// possible range. Then the position of the signal does not matter.
    fn is_straight(&self, equations: &Equations, h: f64, lever: &mut dyn Lever) -> bool {
        let all = self
            .sources
            .iter()
            .flat_map(|source| source.terms.iter().map(move |term| (source.block, term)));
        let moving: Vec<(usize, &Term)> =
            all.filter(|(_, term)| term.bound != Bound::default()).collect();
        let count = moving.len() as f64;
        moving.into_iter().all(|(block, term)| {
            lever.moved(equations.blocks[block].rows().start, &term.slopes);
            let off = (count * term.bound.at(h)).min(FARTHEST / term.lever);
            let bend = if off * lever.turned() <= REACH { lever.bend() } else { f64::INFINITY };
            off * bend <= SAFE * term.lever && !lever.is_singular_within(off)
        })
    }
}

impl Source {
    /// Returns bounds of its signals over a stretch of time, if all are known.
    fn bounds(&self, equations: &Equations, t: Series) -> Option<Vec<Bound>> {
        let signals = self.signals.as_ref()?;
        let bounds =
            equations.blocks[self.block].constraint.formula(|table, parameters, outside| {
                let found = held::over_time(table.formula(), signals, t, parameters, outside);
                found.iter().map(Bound::of).collect::<Option<Vec<Bound>>>()
            });
        bounds.flatten()
    }

    /// Stores bounds of its signals; without bounds its rows are sampled.
    fn take(&mut self, equations: &Equations, instant: &Instant, bounds: Option<Vec<Bound>>) {
        let still = bounds
            .as_ref()
            .is_some_and(|bounds| bounds.iter().all(|bound| *bound == Bound::default()));
        let known = !self.is_sampled
            && self.apart
            && bounds.as_ref().is_some_and(|bounds| bounds.len() == self.terms.len());
        if still {
            self.terms.clear();
            self.is_sampled = false;
        } else if !known {
            let slopes = bounds.as_ref().and_then(|_| self.slopes(equations, instant));
            self.is_sampled = slopes.is_none();
            let rows = equations.blocks[self.block].rows().len();
            let unit = |row: usize| (0..rows).map(|k| f64::from(u8::from(k == row))).collect();
            let slopes = slopes.unwrap_or_else(|| (0..rows).map(unit).collect());
            self.terms = slopes
                .into_iter()
                .map(|slopes| Term { slopes, bound: Bound::default(), lever: f64::NAN })
                .collect();
        }
        self.terms
            .iter_mut()
            .zip(bounds.into_iter().flatten())
            .for_each(|(term, bound)| term.bound = bound);
    }

    /// Returns the slopes of its rows by each of its signals, if they are known.
    fn slopes(&self, equations: &Equations, instant: &Instant) -> Option<Vec<Vec<f64>>> {
        let block = &equations.blocks[self.block];
        let signals = self.signals.as_deref()?;
        let columns = equations.columns_of(block, instant);
        let slopes = block.constraint.formula(|table, parameters, outside| {
            held::slopes(table.formula(), signals, (&columns, instant.t()), parameters, outside)
        });
        let slopes = slopes.unwrap_or_default();
        slopes.iter().flatten().all(|slope| slope.is_finite()).then_some(slopes)
    }
}

#[cfg(test)]
mod tests;
