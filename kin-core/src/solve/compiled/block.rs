//! Computes the times between two single steps with a program.

use std::ops::Range;
use std::sync::Arc;

use super::curve::{Curves, at};
use super::holds::Sums;
use crate::coordinates::units::Unit;
use crate::numbers::lanes::{Level, whole};
use crate::outcome::error::Result;
use crate::program::times::{Curve, Limits, ORDERS, Times};
use crate::program::{Case, Tape};
use crate::solve::follow::{REACH, misses_too_far};
use crate::solve::motion::Motion;
use crate::solve::newton::Outcome;
use crate::solve::options::Stop;
use crate::solve::run::Run;
use crate::system::evaluate::{Equations, Instant};
use crate::system::stop;

/// The largest number of times of a block.
const MOST: usize = 240;

/// A time is returned to the step-by-step solver if a pivot or determinant falls below this share
/// of its value at the beginning of the block. \[-\]
pub(super) const LEAST: f64 = 0.02;

/// The permitted difference of q from a single step, and those of q̇, q̈ and q⃛ relative to the
/// largest of them. \[-\]
const SAME: [f64; ORDERS + 1] = [1e-9, 1e-7, 1e-6, 1e-5];

/// Times that a program computes between two single steps.
pub(super) struct Block<S: Level> {
    times: Times<S>,
    limits: Limits,
    instant: Instant,
    /// True if laws have breaks, which must be looked for at each time.
    watches: bool,
    /// The predictions of the torn coordinates from earlier times: coefficients of q in powers of
    /// the time since the last one.
    curves: Vec<Curve>,
    /// Two kinds of curves: through the last three times, and through four times that reach back as
    /// far as the lanes lead on. The flag is true if the latter would have been nearer.
    near: Curves,
    far: Curves,
    trusts_far: bool,
    /// The first time to which curves may reach back, and the number of breaks and singular
    /// positions at that time.
    since: usize,
    met: usize,
    /// The first time from which single steps must lead up to a block: if something can jump, the
    /// time after the last objection.
    from: usize,
    /// The position being examined.
    q: Vec<f64>,
    room: Sums,
    pub(super) objections: usize,
}

/// The reason why no more lanes are accepted.
enum End {
    /// All lanes were accepted.
    None,
    /// The ends of a step do not show everything.
    Asked,
    Objection,
}

impl<S: Level> Block<S> {
    pub(super) fn new(simd: S, tape: Arc<Tape>, case: Case, run: &Run<'_>) -> Self {
        let times = Times::new(simd, tape, case);
        let system = run.system();
        let curves = vec![[0.0; 9]; times.torn().len()];
        let spread = (3 * Times::<S>::LANES).div_ceil(8);
        Block {
            times,
            limits: Limits { pivot: LEAST, reach: REACH, ..Limits::default() },
            instant: system.equations().instant(),
            watches: !system.is_smooth(),
            curves,
            near: Curves::through(0..ORDERS),
            far: Curves::through([0, spread, 2 * spread, 3 * spread]),
            trusts_far: true,
            since: 0,
            met: 0,
            from: 0,
            q: Vec::new(),
            room: Sums::default(),
            objections: 0,
        }
    }

    /// Returns the number of times after which a block can begin. Single steps must lead up to it.
    /// If rows determine all coordinates, nothing must be predicted.
    pub(super) fn begins_after(&self) -> usize {
        self.from + if self.curves.is_empty() { 1 } else { ORDERS }
    }

    /// Counts an objection. After a discontinuity, prediction must not use times before it.
    fn object(&mut self, next: usize) {
        self.objections += 1;
        if self.times.jumps() {
            (self.from, self.since) = (next, next);
        }
    }

    /// Computes times after the last one of the motion, which is from a single step, until there is
    /// an objection. Returns the number of times.
    pub(super) fn take(
        &mut self,
        run: &mut Run<'_>,
        times: &[f64],
        motion: &mut Motion,
    ) -> Result<usize> {
        let first = motion.len();
        let worst = motion.worst;
        let Some(mut pivot) = self.limit(run, motion) else { return Ok(0) };
        let begun = pivot;
        let met = motion.breaks.len() + motion.singular.len();
        if met > self.met {
            (self.met, self.since) = (met, first - 1);
        }
        loop {
            // The first group begins with the time of the single step.
            let from = if motion.len() == first { first - 1 } else { motion.len() };
            let to = times.len().min(from + Times::<S>::LANES);
            if from + 1 >= to && from < first || from >= to || motion.len() >= first + MOST {
                break;
            }
            self.guess(motion);
            // The first of all times has no time before it, so nothing before it is tested.
            let before = from.saturating_sub(1);
            if from < first {
                self.times.begin([motion.q(before), motion.qd(before), motion.qdd(before)]);
            }
            let guessed = motion.len() - 1;
            let guess = (times[guessed], &self.curves[..]);
            self.times.solve(times[before], &times[from..to], guess, &self.limits, from < first);
            if from < first && !self.agrees(motion, first - 1) {
                self.object(motion.len());
                break;
            }
            let lanes = usize::from(from < first)..to - from;
            let end = self.accept(run, (&times[from..to], lanes, begun), &mut pivot, motion);
            if matches!(end, End::Objection) {
                self.object(motion.len());
            }
            if !matches!(end, End::None) {
                break;
            }
            self.compare(motion, guessed);
        }
        if motion.len() > first && !run.holds(motion, &self.limits.rows, &mut self.room) {
            self.object(first);
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

    /// Looks for breaks of laws on the way to each time from index `first` on. An error cuts the
    /// motion where single steps would end.
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

    /// Sets the limits of the next times from the present single step, and returns its smallest
    /// pivot. Returns `None` if single steps should continue.
    fn limit(&mut self, run: &Run<'_>, motion: &Motion) -> Option<f64> {
        let newton = &run.stepper()?.newton;
        let options = newton.options;
        let layout = newton.system.layout();
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
        limits
            .turns
            .extend(layout.units.iter().map(|unit| f64::from(u8::from(*unit != Unit::Metre))));
        match options.stop {
            Stop::ResidualOnly(bound) => {
                limits.rows.clear();
                limits.rows.resize(newton.system.n_equations(), bound);
            }
            Stop::Converged { .. } => newton.allow(tolerance, &mut limits.rows),
        }
        (motion.len() >= self.begins_after())
            .then(|| newton.linear.smallest_pivot())
            .filter(|pivot| pivot.is_finite() && *pivot > 0.0)
    }

    /// Predicts the torn coordinates from earlier times.
    fn guess(&mut self, motion: &Motion) {
        if self.curves.is_empty() {
            return;
        }
        let last = motion.len() - 1;
        let reaches = last >= self.since + self.far.reach_back();
        let lead = if self.trusts_far && reaches { &mut self.far } else { &mut self.near };
        lead.lead(motion, last);
        let of = |column: &usize| lead.of(motion, last, *column);
        self.curves
            .iter_mut()
            .zip(self.times.torn())
            .for_each(|(curve, column)| *curve = of(column));
    }

    /// If Newton's method took more than one step from time `before` to the last time of the
    /// motion, compares both kinds of curves.
    fn compare(&mut self, motion: &Motion, before: usize) {
        let last = motion.len() - 1;
        if before < self.since + self.far.reach_back()
            || self.times.steps().iter().all(|steps| *steps < 2.0)
        {
            return;
        }
        let s = motion.times()[last] - motion.times()[before];
        let mut off = [0.0_f64; 2];
        for (off, curves) in off.iter_mut().zip([&mut self.near, &mut self.far]) {
            curves.lead(motion, before);
            for (column, size) in self.times.torn().iter().zip(&self.limits.sizes) {
                let miss = at(&curves.of(motion, before, *column), s) - motion.q(last)[*column];
                *off = off.max(miss.abs() / size);
            }
        }
        self.trusts_far = off[1] <= off[0];
    }

    /// Returns true if the first lane has the result of the single step.
    fn agrees(&self, motion: &Motion, k: usize) -> bool {
        let plain = [motion.q(k), motion.qd(k), motion.qdd(k), motion.qddd(k)];
        (0..=ORDERS).all(|order| {
            let shares = &self.limits.shares;
            let size = plain[order]
                .iter()
                .zip(shares)
                .fold(1.0_f64, |m, (x, share)| m.max((x * share).abs()));
            let size = if order == 0 { 1.0 } else { size };
            let near = |(column, x): (usize, &f64)| {
                let own = self.times.of(column, order)[0];
                (own - x).abs() * shares[column]
                    <= SAME[order] * size.max((x * shares[column]).abs())
            };
            plain[order].iter().enumerate().all(near)
        })
    }

    /// Accepts lanes in order into the motion, until there is an objection.
    fn accept(
        &mut self,
        run: &mut Run<'_>,
        (times, lanes, begun): (&[f64], Range<usize>, f64),
        pivot: &mut f64,
        motion: &mut Motion,
    ) -> End {
        let first = lanes.start;
        let mut before = motion.times()[motion.len() - 1];
        let mut end = End::None;
        let Block { times: solved, instant, q, .. } = self;
        let branches = !run.system().equations().branches().is_empty();
        // If rows determine all coordinates, there is one position at each time, however far it is
        // from the last one. Then there is no branch to leave, and nothing hidden in between,
        // unless something jumps.
        let is_given = solved.torn().is_empty() && !solved.jumps();
        let mut taken = first..first;
        let own =
            times[lanes.clone()].iter().zip(solved.judged.miss.as_slice()[lanes.clone()].iter());
        for ((t, miss), share) in own.zip(&solved.judged.pivot.as_slice()[lanes]) {
            let own = begun * share;
            let least = own.min(*pivot);
            // An error that is NaN is an objection.
            let mut good = if is_given { !miss.is_nan() } else { !misses_too_far(*miss, least) };
            if branches && good {
                solved.position(taken.end, q);
                good = is_meant(run.system().equations(), (*t, q), instant);
            }
            if !good {
                end = End::Objection;
                break;
            }
            if !is_given && !run.ends_suffice(before, *t, least) {
                solved.position(taken.end, q);
                if !run.samples_suffice((before, *t, q), least, instant) {
                    end = End::Asked;
                    break;
                }
            }
            (*pivot, before) = (own, *t);
            taken.end += 1;
        }
        self.keep(times, taken, motion);
        end
    }

    /// Appends lanes to a motion.
    fn keep(&self, times: &[f64], lanes: Range<usize>, motion: &mut Motion) {
        let judged = &self.times.judged;
        let first = lanes.start;
        let residuals = &judged.residual.as_slice()[lanes.clone()];
        let most = residuals.iter().copied().fold(0.0, f64::max);
        if let Some(lane) = residuals.iter().position(|own| *own == most)
            && motion.is_worse(Outcome { iterations: 0, residual: most })
        {
            motion.worst = Some((most, self.times.worst(first + lane)));
        }
        for steps in &self.times.steps()[lanes.clone()] {
            motion.iterations.push(whole(*steps));
        }
        motion.residuals.extend_from_slice(residuals);
        motion.times.extend_from_slice(&times[lanes.clone()]);
        self.times
            .append(lanes, [&mut motion.q, &mut motion.qd, &mut motion.qdd, &mut motion.qddd]);
    }
}

/// Returns true if a position is on the right branch of all constraints.
#[cold]
pub(super) fn is_meant(
    equations: &Equations,
    (t, q): (f64, &[f64]),
    instant: &mut Instant,
) -> bool {
    equations.set_time(t, instant);
    equations.set_position(q, instant);
    equations.first_wrong(instant).is_none()
}
