//! Several cases in lock step, one in each lane: the iteration, the stop rule, predictions and judgements of
//! plain steps, asked of numbers over lanes, so that each lane is judged by itself.
//!
//! A lane that has converged is not changed any more while others go on. A lane that does not converge, or
//! meets a pivot that no recording fits, is given up here; its case is run alone from the start by its owner,
//! with all the means of the scalar solver.

mod check;
mod iterate;
mod pending;
mod predictor;

use pulp::NullaryFnOnce;

use super::iterate as newton;
use super::{DOUBTFUL, Follow, Newton, Options, first_position};
use crate::linear::lanes::WideLinear;
use crate::numbers::lanes::{Level, Mask, Wide};
use crate::solve::motion::Motion;
use crate::system::System;
use crate::system::evaluate::lanes::{LaneSystems, WideEquations, WideInstant, put};
use crate::system::scale;
use check::Check;
use iterate::All;
use pending::Pending;
use predictor::Predictor;

/// The points in hand, one a lane, and the space to work in.
pub(crate) struct Lockstep<'o, S: Level> {
    simd: S,
    options: &'o Options,
    equations: WideEquations<S>,
    instant: WideInstant<S>,
    linear: WideLinear<S>,
    predictor: Predictor<S>,
    t: f64,
    q: Vec<Wide<S>>,
    before: Vec<Wide<S>>,
    /// The correction that a lane had in hand when it converged.
    last: Vec<Wide<S>>,
    sizes: Vec<Wide<S>>,
    /// One over each of them.
    per_size: Vec<Wide<S>>,
    /// max |C_i|, and Newton steps, at the last time.
    residual: Wide<S>,
    iterations: Wide<S>,
    /// The judge of each step, if that is asked for.
    check: Option<Check<S>>,
    /// True if a constraint can jump where coordinates move: then the last correction, after which nothing is
    /// looked at, is left out.
    jumps: bool,
    pending: Pending<S>,
    /// The first and the last time.
    ends: [f64; 2],
}

/// Something that all lanes do, on its way into the function that has the machine's instructions.
struct Task<'x, 'o, 'c, S: Level> {
    lanes: &'x mut Lockstep<'o, S>,
    batch: &'x LaneSystems<'c>,
    wanted: Mask<S>,
    t: f64,
    first: bool,
}

impl<S: Level> NullaryFnOnce for Task<'_, '_, '_, S> {
    type Output = Mask<S>;

    #[inline(always)]
    fn call(self) -> Mask<S> {
        let Task { lanes, batch, wanted, t, first } = self;
        lanes.step(batch, wanted, t, first)
    }
}

/// The results of a time, on the same way.
struct Keep<'x, 'o, S: Level>(&'x mut Lockstep<'o, S>);

impl<S: Level> NullaryFnOnce for Keep<'_, '_, S> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let Lockstep { pending, linear, q, residual, iterations, .. } = self.0;
        pending.keep([q, linear.rates(), linear.second_rates(), linear.c()], *residual, *iterations)
    }
}

impl<'o, S: Level> Lockstep<'o, S> {
    /// For systems such as `typical`, which has the numbers of one case; `varied` are the constraints that
    /// differ from case to case. The elimination is recorded at the first position of that case.
    pub(crate) fn new(
        simd: S,
        typical: &System,
        varied: &[bool],
        options: &'o Options,
        ends: [f64; 2],
    ) -> Self {
        let (n, zero) = (typical.n_coordinates(), Wide::splat(simd, 0.0));
        let mut newton = Newton::new(typical, options);
        // Where that fails each group of cases records for itself.
        let _ = first_position::assemble(&mut newton, ends[0]);
        let equations = WideEquations::new(simd, typical.equations(), varied);
        let room = || vec![zero; n];
        Lockstep {
            simd,
            options,
            instant: equations.instant(),
            linear: WideLinear::new(simd, newton.linear, equations.asked()),
            equations,
            predictor: Predictor::new(simd, n),
            t: f64::NAN,
            q: room(),
            before: room(),
            last: room(),
            sizes: room(),
            per_size: room(),
            residual: zero,
            check: (options.follow != Follow::Unchecked).then(|| Check::new(simd, typical)),
            iterations: zero,
            jumps: !typical.equations().jumping().is_empty(),
            pending: Pending::new(simd, n),
            ends,
        }
    }

    /// The first position of every system, at time t; gives the lanes of `wanted` that have one.
    pub(crate) fn first(&mut self, batch: &LaneSystems<'_>, wanted: Mask<S>, t: f64) -> Mask<S> {
        self.predictor.begin();
        self.pending.begin();
        self.equations.set_parameters(batch, &mut self.instant);
        let mut steps = Wide::splat(self.simd, 0.0);
        let mut started = vec![false; Wide::<S>::LANES];
        for (lane, system) in batch.systems.iter().enumerate().filter(|(lane, _)| wanted.lane(*lane)) {
            // Breaks of laws are looked for time by time, which is not done here.
            started[lane] = system.is_smooth();
            put(system.initial(), lane, &mut self.q);
            if !started[lane] || !(self.options.rescue || self.check.is_some()) {
                continue;
            }
            let mut newton = Newton::new(system, self.options);
            started[lane] = first_position::assemble(&mut newton, t).is_ok();
            if let Some(check) = &mut self.check {
                started[lane] &= started[lane] && check.foresee(lane, &mut newton, self.ends);
            }
            if self.options.rescue {
                steps.as_mut_slice()[lane] = newton.steps as f64;
                put(&newton.q, lane, &mut self.q);
                put(&newton.sizes, lane, &mut self.sizes);
            }
        }
        let wanted =
            wanted & Mask::from_fn(self.simd, |lane| started.get(lane).is_some_and(|started| *started));
        self.fill(wanted);
        if !self.options.rescue {
            self.equations.set_time(t, batch, &mut self.instant);
            self.look(batch);
            self.measure(batch);
        }
        self.linear.begin(&self.sizes);
        let simd = self.simd;
        let mut done = simd.vectorize(Task { lanes: self, batch, wanted, t, first: true });
        if !self.options.rescue {
            let first_steps = self.iterations;
            self.measure(batch);
            self.linear.set_sizes(&self.sizes);
            done = simd.vectorize(Task { lanes: self, batch, wanted: done, t, first: true });
            steps = first_steps;
        }
        self.iterations = steps + self.iterations;
        done
    }

    /// Gives the lanes that are not `alive` the numbers of one that is, so that nothing odd is computed
    /// there.
    pub(crate) fn fill(&mut self, alive: Mask<S>) {
        let Some(model) = (0..Wide::<S>::LANES).find(|lane| alive.lane(*lane)) else { return };
        let [qd, qdd] = self.linear.all_rates();
        for x in [&mut self.q[..], qd, qdd, &mut self.sizes].into_iter().flatten() {
            *x = alive.select(*x, Wide::splat(self.simd, x.as_slice()[model]));
        }
    }

    /// Position, velocity and acceleration at the next time; gives the lanes of `wanted` that have them.
    pub(crate) fn advance(&mut self, batch: &LaneSystems<'_>, wanted: Mask<S>, t: f64) -> Mask<S> {
        self.simd.vectorize(Task { lanes: self, batch, wanted, t, first: false })
    }

    /// Keeps what the lanes have, for [`Lockstep::flush`]; true where it is time for that.
    pub(crate) fn keep(&mut self) -> bool {
        self.simd.vectorize(Keep(self))
    }

    /// Appends what was kept to the motions.
    pub(crate) fn flush(&mut self, motions: &mut [Motion]) {
        self.pending.flush(motions);
    }

    /// Completes the motions, which have come to the end of these times.
    pub(crate) fn complete(&self, times: &[f64], motions: &mut [Motion]) {
        self.pending.complete(times, motions);
    }

    /// C and C_q at the point in hand.
    #[inline(always)]
    fn look(&mut self, batch: &LaneSystems<'_>) {
        self.equations.set_position(&self.q, &mut self.instant);
        let (c, values) = self.linear.written();
        self.equations.linearize(batch, &self.instant, c, values);
    }

    /// Characteristic sizes of every lane at the point in hand.
    fn measure(&mut self, batch: &LaneSystems<'_>) {
        for (lane, system) in batch.systems.iter().enumerate() {
            let of_lane = |all: &[Wide<S>]| all.iter().map(|x| x.as_slice()[lane]).collect::<Vec<f64>>();
            let (values, q) = (of_lane(self.linear.values()), of_lane(&self.q));
            let sizes = scale::sizes(system.layout(), system.equations(), &values, &q, system.links());
            put(&sizes, lane, &mut self.sizes);
        }
    }

    /// Position, velocity and acceleration at a time: the first, by Newton's method from the point in hand,
    /// or a later one, from the prediction or the last position.
    #[inline(always)]
    fn step(&mut self, batch: &LaneSystems<'_>, wanted: Mask<S>, t: f64, first: bool) -> Mask<S> {
        let h = t - self.t;
        if first {
            for (per_size, size) in self.per_size.iter_mut().zip(&self.sizes) {
                *per_size = size.reciprocal();
            }
        } else {
            self.predict(h);
        }
        let done = self.solve(batch, wanted, t, first);
        if !first && self.options.predict {
            let (stepped, [qd, qdd]) =
                (self.iterations.is_true(), [self.linear.rates(), self.linear.second_rates()]);
            self.predictor.compare(h, [&self.before, qd, qdd], &self.q, &self.per_size, stepped);
            self.predictor.advance(h, qd, qdd);
        }
        self.t = t;
        let done = self.rates(batch, done);
        match &mut self.check {
            None => done,
            Some(check) if first => {
                check.accept(&self.linear);
                done
            }
            Some(check) => done & check.judge(h, &self.q, &self.per_size, &self.linear),
        }
    }

    /// A step h begins.
    #[inline(always)]
    fn predict(&mut self, h: f64) {
        let [qd, qdd] = [self.linear.rates(), self.linear.second_rates()];
        if let Some(check) = &mut self.check {
            check.begin([&self.q, qd, qdd]);
        }
        if self.options.predict {
            self.before.copy_from_slice(&self.q);
            self.predictor.predict(h, [&self.before, qd, qdd], &mut self.q);
        }
    }

    /// Newton's method in all lanes that are wanted; gives those that converge, their matrices factored.
    #[inline(always)]
    fn solve(&mut self, batch: &LaneSystems<'_>, wanted: Mask<S>, t: f64, first: bool) -> Mask<S> {
        let (options, zero) = (self.options, Wide::splat(self.simd, 0.0));
        self.iterations = zero;
        if options.predict {
            self.last.fill(zero);
        }
        self.equations.set_time(t, batch, &mut self.instant);
        // Near a position that is known corrections must shrink. Without prediction only the time is another
        // one than there.
        let (near, still) = (!first && options.rescue, !first && !options.predict);
        let mut all = All { lanes: self, batch, still, first, measured: false };
        let done = newton::newton(&mut all, options, near, (wanted, zero));
        self.finish(done)
    }

    /// The lanes that have a position which is not singular; the last correction costs nothing any more.
    #[inline(always)]
    fn finish(&mut self, done: Mask<S>) -> Mask<S> {
        if self.options.predict && !self.jumps {
            for (q, last) in self.q.iter_mut().zip(&self.last) {
                *q = *q - *last;
            }
        }
        done & self.linear.regular(DOUBTFUL)
    }

    /// max |C_i|; true in the lanes where C is finite.
    #[inline(always)]
    fn measured(&mut self) -> Mask<S> {
        let (mut largest, mut sum) = (Wide::splat(self.simd, 0.0), Wide::splat(self.simd, 0.0));
        for c in self.linear.c() {
            // A number that is not finite may be lost among the largest, not in a sum.
            (largest, sum) = (c.abs().or_larger(largest), sum + c.abs());
        }
        self.residual = largest;
        sum.le(Wide::splat(self.simd, f64::MAX))
    }

    /// q̇ and q̈ with the matrices at hand; gives the lanes of `done` where both are finite.
    #[inline(always)]
    fn rates(&mut self, batch: &LaneSystems<'_>, done: Mask<S>) -> Mask<S> {
        self.equations.velocity_rhs(batch, &self.instant, self.linear.velocity_rhs());
        self.linear.solve_velocity();
        let (rates, q_d) = self.linear.acceleration_rhs();
        self.equations.acceleration_rhs(batch, &self.instant, rates, q_d);
        self.linear.solve_acceleration();
        let mut sum = Wide::splat(self.simd, 0.0);
        for (qd, qdd) in self.linear.rates().iter().zip(self.linear.second_rates()) {
            sum = sum + (qd.abs() + qdd.abs());
        }
        done & sum.le(Wide::splat(self.simd, f64::MAX))
    }
}
