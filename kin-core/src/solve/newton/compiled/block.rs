//! Times that a program computes between two plain steps.

use std::ops::Range;

use super::curve::curve;
use super::holds::Sums;
use crate::model::error::Result;
use crate::model::units::Unit;
use crate::numbers::lanes::Level;
use crate::program::Tape;
use crate::program::times::{Curve, Limits, ORDERS, Times};
use crate::solve::follow::{misses_too_far, turns_too_far};
use crate::solve::motion::Motion;
use crate::solve::newton::run::Run;
use crate::solve::newton::{Outcome, Stop};
use crate::system::evaluate::Instant;
use crate::system::stop;

/// Times of a block at most, between plain steps.
const MOST: usize = 240;

/// A pivot or determinant that is less than this share of what it was where the block began is left to plain
/// steps.   \[-\]
const LEAST: f64 = 0.02;

/// How far q, and q̇ and q̈ by the largest of them, may be from those of a plain step.   \[-\]
const SAME: [f64; ORDERS] = [1e-9, 1e-7, 1e-6];

/// Times that a program computes between two plain steps.
pub(super) struct Block<'p, S: Level> {
    times: Times<'p, S>,
    limits: Limits,
    instant: Instant,
    /// True if laws have breaks that are looked for time by time.
    watches: bool,
    /// Where the torn coordinates are led by the last three times: coefficients of q in powers of time since
    /// the last one.
    curves: Vec<Curve>,
    room: Sums,
    pub(super) objections: usize,
}

/// The reason why no more lanes are accepted.
enum End {
    /// All were taken.
    None,
    /// There is more to be asked than the ends of a step tell.
    Asked,
    Objection,
}

impl<'p, S: Level> Block<'p, S> {
    pub(super) fn new(simd: S, tape: &'p Tape, run: &Run<'_>) -> Self {
        let (times, system) = (Times::new(simd, tape), run.system());
        let curves = vec![[0.0; 7]; times.torn().len()];
        Block {
            times,
            limits: Limits::default(),
            instant: system.equations().instant(),
            watches: !system.is_smooth(),
            curves,
            room: Sums::default(),
            objections: 0,
        }
    }

    /// Computes times from the last one of the motion, which is a plain step's, as far as there is no
    /// objection; gives how many.
    pub(super) fn take(&mut self, run: &mut Run<'_>, times: &[f64], motion: &mut Motion) -> Result<usize> {
        let (first, worst) = (motion.len(), motion.worst);
        let Some(mut pivot) = self.limit(run, motion) else { return Ok(0) };
        let begun = pivot;
        loop {
            // The first group begins with the plain step's own time.
            let from = if motion.len() == first { first - 1 } else { motion.len() };
            let to = times.len().min(from + Times::<S>::LANES);
            if from + 1 >= to && from < first || from >= to || motion.len() >= first + MOST {
                break;
            }
            self.guess(motion);
            let before = from - 1;
            self.times.begin([motion.q(before), motion.qd(before), motion.qdd(before)]);
            let guess = (times[motion.len() - 1], &self.curves[..]);
            self.times.solve(times[before], &times[from..to], guess, &self.limits, from < first);
            if from < first && !self.agrees(motion, first - 1) {
                self.objections += 1;
                break;
            }
            let lanes = usize::from(from < first)..to - from;
            let end = self.accept(run, (&times[from..to], lanes, begun), &mut pivot, motion);
            if matches!(end, End::Objection) {
                self.objections += 1;
            }
            if !matches!(end, End::None) {
                break;
            }
        }
        if motion.len() > first && !run.holds(motion, &self.limits.rows, &mut self.room) {
            self.objections += 1;
            motion.cut(first, worst);
            run.go_on(motion, begun);
        }
        if motion.len() > first {
            let looked = self.look(run, motion, first);
            looked.inspect_err(|_| motion.worst = worst)?;
            run.go_on(motion, pivot);
        }
        Ok(motion.len() - first)
    }

    /// Looks for breaks of laws on the way to each time from number `first` on; an error cuts the motion
    /// where single steps end.
    fn look(&mut self, run: &mut Run<'_>, motion: &mut Motion, first: usize) -> Result<()> {
        let equations = run.system().equations();
        for k in (first..motion.len()).filter(|_| self.watches) {
            equations.set_time(motion.times()[k], &mut self.instant);
            equations.set_position(motion.q(k), &mut self.instant);
            run.look(&self.instant, motion).inspect_err(|_| motion.cut(k, motion.worst))?;
        }
        if !self.watches
            && let Some(t) = motion.times().last()
        {
            equations.set_time(*t, &mut self.instant);
            run.look(&self.instant, motion)?;
        }
        Ok(())
    }

    /// The limits for the times to come, by the plain step in hand, and its smallest pivot; `None` where
    /// plain steps had better go on.
    fn limit(&mut self, run: &Run<'_>, motion: &Motion) -> Option<f64> {
        let newton = &run.stepper()?.newton;
        let (options, layout) = (newton.options, newton.system.layout());
        let tolerance = match options.stop {
            Stop::Converged { tolerance } => tolerance,
            Stop::ResidualOnly(_) => 1e-13,
        };
        let limits = &mut self.limits;
        limits.sizes.clear();
        limits.sizes.extend(self.times.torn().iter().map(|column| newton.sizes[*column]));
        limits.correction.clear();
        limits.correction.extend(limits.sizes.iter().map(|size| tolerance * size));
        (limits.rounding, limits.steps) =
            (tolerance * stop::rounding(tolerance), options.max_iterations.min(12));
        limits.shares.clear();
        limits.shares.extend(newton.sizes.iter().map(|size| size.recip()));
        limits.turns.clear();
        limits.turns.extend(layout.units.iter().map(|unit| f64::from(u8::from(*unit != Unit::Metre))));
        match options.stop {
            Stop::ResidualOnly(bound) => {
                limits.rows.clear();
                limits.rows.resize(newton.system.n_equations(), bound);
            }
            Stop::Converged { .. } => newton.allow(tolerance, &mut limits.rows),
        }
        (motion.len() >= ORDERS)
            .then(|| newton.linear.smallest_pivot())
            .filter(|pivot| pivot.is_finite() && *pivot > 0.0)
    }

    /// Where the last three times lead the torn coordinates.
    fn guess(&mut self, motion: &Motion) {
        let last = motion.len() - 1;
        let times = [0, 1, 2].map(|k| motion.times()[last - k] - motion.times()[last]);
        for (curve_of, column) in self.curves.iter_mut().zip(self.times.torn()) {
            let rates = [0, 1, 2].map(|k| [motion.qd(last - k)[*column], motion.qdd(last - k)[*column]]);
            *curve_of = curve(motion.q(last)[*column], times, rates);
        }
    }

    /// True if the first lane has what the plain step has.
    fn agrees(&self, motion: &Motion, k: usize) -> bool {
        let plain = [motion.q(k), motion.qd(k), motion.qdd(k)];
        (0..ORDERS).all(|order| {
            let shares = &self.limits.shares;
            let size =
                plain[order].iter().zip(shares).fold(1.0_f64, |m, (x, share)| m.max((x * share).abs()));
            let size = if order == 0 { 1.0 } else { size };
            let near = |(column, x): (usize, &f64)| {
                let own = self.times.of(column, order)[0];
                (own - x).abs() * shares[column] <= SAME[order] * size.max((x * shares[column]).abs())
            };
            plain[order].iter().enumerate().all(near)
        })
    }

    /// Takes lanes in their order into the motion, until there is an objection.
    fn accept(
        &mut self,
        run: &mut Run<'_>,
        (times, lanes, begun): (&[f64], Range<usize>, f64),
        pivot: &mut f64,
        motion: &mut Motion,
    ) -> End {
        let (first, mut before, mut end) = (lanes.start, motion.times()[motion.len() - 1], End::None);
        let mut taken = first..first;
        for lane in lanes {
            let (judged, t) = (&self.times.judged, times[lane]);
            let own = begun * judged.pivot[lane];
            let least = own.min(*pivot);
            let near = !turns_too_far(judged.reach[lane]) && !misses_too_far(judged.miss[lane], least);
            let good = judged.met[lane] && !judged.turned[lane] && judged.pivot[lane] >= LEAST && near;
            if !(good && self.is_meant(run, t, lane)) {
                end = End::Objection;
                break;
            }
            if !run.ends_suffice(before, t, least) {
                end = End::Asked;
                break;
            }
            (*pivot, before) = (own, t);
            taken.end = lane + 1;
        }
        self.keep(times, taken, motion);
        end
    }

    /// Appends lanes to a motion.
    fn keep(&self, times: &[f64], lanes: Range<usize>, motion: &mut Motion) {
        let judged = &self.times.judged;
        for lane in lanes.clone() {
            let outcome =
                Outcome { iterations: judged.steps[lane] as usize, residual: judged.residual[lane] };
            if motion.is_worse(outcome) {
                motion.worst = Some((outcome.residual, self.times.worst(lane)));
            }
            motion.iterations.push(outcome.iterations);
        }
        motion.residuals.extend_from_slice(&judged.residual[lanes.clone()]);
        motion.times.extend_from_slice(&times[lanes.clone()]);
        let orders = [&mut motion.q, &mut motion.qd, &mut motion.qdd];
        orders
            .into_iter()
            .enumerate()
            .for_each(|(order, to)| to.extend_from_slice(self.times.rows(order, lanes.clone())));
    }

    /// True if the position in a lane is what constraints mean.
    fn is_meant(&mut self, run: &Run<'_>, t: f64, lane: usize) -> bool {
        let equations = run.system().equations();
        if equations.branches().is_empty() {
            return true;
        }
        equations.set_time(t, &mut self.instant);
        equations.set_position(self.times.rows(0, lane..lane + 1), &mut self.instant);
        equations.first_wrong(&self.instant).is_none()
    }
}
