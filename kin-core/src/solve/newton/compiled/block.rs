//! Times that a program computes between two plain steps.

use std::ops::Range;
use std::sync::Arc;

use super::curve::{Curves, at};
use super::holds::Sums;
use crate::model::error::Result;
use crate::model::units::Unit;
use crate::numbers::lanes::{Level, whole};
use crate::program::times::{Curve, Limits, ORDERS, Times};
use crate::program::{Case, Tape};
use crate::solve::follow::{REACH, misses_too_far};
use crate::solve::motion::Motion;
use crate::solve::newton::run::Run;
use crate::solve::newton::{Outcome, Stop};
use crate::system::evaluate::{Equations, Instant};
use crate::system::stop;

/// Times of a block at most, between plain steps.
const MOST: usize = 240;

/// A pivot or determinant that is less than this share of what it was where the block began is left
/// to plain steps.   \[-\]
pub(super) const LEAST: f64 = 0.02;

/// How far q, and q̇, q̈ and q⃛ by the largest of them, may be from those of a plain step.   \[-\]
const SAME: [f64; ORDERS + 1] = [1e-9, 1e-7, 1e-6, 1e-5];

/// Times that a program computes between two plain steps.
pub(super) struct Block<S: Level> {
    times: Times<S>,
    limits: Limits,
    instant: Instant,
    /// True if laws have breaks that are looked for time by time.
    watches: bool,
    /// Where the torn coordinates are led by earlier times: coefficients of q in powers of time
    /// since the last one.
    curves: Vec<Curve>,
    /// Through the last three times, and through four that reach back as far as lanes lead on; true
    /// where the latter would have been nearer.
    near: Curves,
    far: Curves,
    trusts_far: bool,
    /// The first time that curves may reach back to, and how many breaks and singular positions
    /// there were then.
    since: usize,
    met: usize,
    /// The first time from which plain steps have to lead up to a block: where anything can jump,
    /// the one after the last objection.
    from: usize,
    /// A position that is looked at.
    q: Vec<f64>,
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

    /// The number of times after which a block can begin: plain steps have to lead up to it, and
    /// where rows give all coordinates nothing has to be guessed.
    pub(super) fn begins_after(&self) -> usize {
        self.from + if self.curves.is_empty() { 1 } else { ORDERS }
    }

    /// Counts an objection. Beyond a jump curves lead nowhere that reach back before it.
    fn object(&mut self, next: usize) {
        self.objections += 1;
        if self.times.jumps() {
            (self.from, self.since) = (next, next);
        }
    }

    /// Computes times from the last one of the motion, which is a plain step's, as far as there is
    /// no objection; gives how many.
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
            // The first group begins with the plain step's own time.
            let from = if motion.len() == first { first - 1 } else { motion.len() };
            let to = times.len().min(from + Times::<S>::LANES);
            if from + 1 >= to && from < first || from >= to || motion.len() >= first + MOST {
                break;
            }
            self.guess(motion);
            // Before the first time of all there is none: what leads to it is not judged.
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

    /// Looks for breaks of laws on the way to each time from number `first` on; an error cuts the
    /// motion where single steps end.
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

    /// The limits for the times to come, by the plain step in hand, and its smallest pivot; `None`
    /// where plain steps had better go on.
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

    /// Where earlier times lead the torn coordinates.
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

    /// Where Newton's method took more than one step from number `before` to the last one of the
    /// motion: were the right times asked where they lead?
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

    /// True if the first lane has what the plain step has.
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

    /// Takes lanes in their order into the motion, until there is an objection.
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
        // Where rows give all coordinates there is one position at each time, however far it is
        // from the last one: there is no branch to leave, and nothing to be seen in between, unless
        // something jumps.
        let is_given = solved.torn().is_empty() && !solved.jumps();
        let mut taken = first..first;
        let own =
            times[lanes.clone()].iter().zip(solved.judged.miss.as_slice()[lanes.clone()].iter());
        for ((t, miss), share) in own.zip(&solved.judged.pivot.as_slice()[lanes]) {
            let own = begun * share;
            let least = own.min(*pivot);
            // A miss that is not a number is an objection.
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

/// True if a position is what constraints mean.
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
