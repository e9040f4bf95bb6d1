//! Samples C of constraints without known bounds, at constant q and at the eighths of a step.

use super::{Bound, COEFFICIENTS, DRIFT, Drive, EASY, Source, Span};
use crate::numbers::enclosure::{Interval, ONE, Series};
use crate::system::evaluate::{Equations, Instant};

/// The number of samples of a step.
const SAMPLES: u32 = 8;

impl Drive {
    /// Returns true if samples may decide steps.
    pub(crate) fn may_sample(&self) -> bool {
        self.samples > 0
    }

    /// Tests like [`Drive::ends_suffice`] if some constraints have no bounds. It samples them at
    /// the q of the end of the step and uses the last known effect on q.
    pub(crate) fn samples_suffice(
        &mut self,
        Span { equations, from, to, pivot }: Span<'_>,
        instant: &Instant,
    ) -> bool {
        self.samples = self.samples.saturating_sub(1);
        let t = Series::variable(Interval::new(from.min(to), from.max(to)), ONE, COEFFICIENTS);
        self.stretch = [from.min(to), from.max(to)];
        for source in self.sources.iter_mut().filter(|source| !source.is_sampled) {
            let Some(known) = source.bounds(equations, t) else { return false };
            let stands = known.iter().all(|bound| *bound == Bound::default());
            let is_weighed = source.apart && known.len() == source.terms.len();
            if !(stands || is_weighed) {
                return false;
            }
            source.terms.iter_mut().zip(known).for_each(|(term, bound)| term.bound = bound);
        }
        self.sample(equations, instant, [from, to]);
        let mut off = Bound::default();
        for term in self.sources.iter().flat_map(|source| &source.terms) {
            // The effect of a row that was constant at the last check is unknown.
            if term.bound != Bound::default() && term.lever.is_nan() {
                return false;
            }
            off.add(term.lever, &term.bound);
        }
        DRIFT * off.at((to - from).abs()) * self.pivot <= EASY * pivot * pivot
    }

    /// Samples the constraints without bounds.
    pub(super) fn sample(&mut self, equations: &Equations, instant: &Instant, ends: [f64; 2]) {
        for source in self.sources.iter_mut().filter(|source| source.is_sampled) {
            let scratch = self.scratch.get_or_insert_with(|| instant.clone());
            scratch.clone_from(instant);
            source.sample(equations, scratch, ends);
        }
    }
}

impl Source {
    /// Computes the distance of its rows from their quadratic polynomials at both ends, at constant
    /// q.
    fn sample(&mut self, equations: &Equations, scratch: &mut Instant, [from, to]: [f64; 2]) {
        let block = &equations.blocks[self.block];
        let ends = [from, to].map(|t| (t, equations.held(block, t, scratch)));
        let mut most = vec![0.0_f64; self.terms.len()];
        let first = &ends[0].1[0];
        let last = &ends[1].1[0];
        for k in 0..=SAMPLES {
            let t = from + (to - from) * f64::from(k) / f64::from(SAMPLES);
            let [c, ..] = equations.held(block, t, scratch);
            for (end, [f, f_t, f_tt]) in &ends {
                let s = t - end;
                for (row, most) in most.iter_mut().enumerate() {
                    let off = (c[row] - f[row] - s * (f_t[row] + 0.5 * s * f_tt[row])).abs();
                    *most = if off.is_nan() { f64::INFINITY } else { most.max(off) };
                }
            }
            for (row, most) in most.iter_mut().enumerate() {
                *most = most
                    .max(c[row] - first[row].max(last[row]))
                    .max(first[row].min(last[row]) - c[row]);
            }
        }
        self.terms
            .iter_mut()
            .zip(most)
            .for_each(|(term, most)| term.bound = Bound([most, 0.0, 0.0, 0.0]));
    }
}
