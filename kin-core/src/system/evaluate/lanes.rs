//! Evaluation over lanes: several systems of one pattern at once, by kernels where constraints have them, else lane by lane.

use super::{Equations, Span};
use crate::lanes::{InLanes, LaneAt, LaneRates, Level, Table, Wide};
use crate::state::{At, Rates};
use crate::system::System;

/// How one constraint is evaluated over lanes.
struct WideBlock<S: Level> {
    /// Its kernels, if it has them.
    table: Option<Table<S>>,
    /// Where what it knows stands: of parameters, of the time, and both together.
    of_parameters: Span,
    of_time: Span,
    known: Span,
    /// Where its arguments' states, its rows, its values and its columns' rates stand.
    states: Span,
    rows: Span,
    values: Span,
    rates: Span,
    /// Whether it is the same in all lanes.
    same: bool,
    /// Whether its C, or C_q, depends on the time.
    on_t: bool,
    /// Whether its C_t, or Q_d, can be other than zero.
    c_t: bool,
    q_d: bool,
}

/// All constraints of a system over lanes.
pub(crate) struct WideEquations<S: Level> {
    simd: S,
    blocks: Vec<WideBlock<S>>,
    /// Whether some C_q depends on the time.
    c_q_on_t: bool,
    n_known: usize,
    scratch: Scratch,
}

/// Room for one constraint in one lane.
#[derive(Default)]
struct Scratch {
    states: Vec<f64>,
    rates: Vec<f64>,
    known: Vec<f64>,
    c: Vec<f64>,
    values: Vec<f64>,
}

/// What constraints read at one instant, over lanes.
pub(crate) struct WideInstant<S: Level> {
    t: f64,
    known: Vec<Wide<S>>,
    states: Vec<Wide<S>>,
    rates: Vec<Wide<S>>,
}

/// The systems of all lanes, with their constraints as kernels over lanes see them.
pub(crate) struct Crew<'a> {
    pub systems: &'a [System],
    /// For each constraint with kernels, those of all lanes.
    own: Vec<Vec<&'a dyn InLanes>>,
}

impl<'a> Crew<'a> {
    pub(crate) fn new(systems: &'a [System]) -> Self {
        let count = systems.first().map_or(0, |system| system.equations().blocks.len());
        let lanes = |k: usize| systems.iter().filter_map(move |system| system.equations().blocks[k].constraint.in_lanes()).collect();
        Crew { systems, own: (0..count).map(lanes).collect() }
    }
}

impl<S: Level> WideEquations<S> {
    /// Those of `equations`; `varied` are the constraints that differ from lane to lane.
    pub(crate) fn new(simd: S, equations: &Equations, varied: &[bool]) -> Self {
        let (mut n_known, mut blocks) = (0, Vec::new());
        let plan = &equations.plan;
        let ends = equations.blocks.iter().skip(1).map(|next| (next.states as usize, next.rates as usize));
        let ends = ends.chain([(plan.len(), plan.n_columns())]);
        for ((block, varied), (states, rates)) in equations.blocks.iter().zip(varied).zip(ends) {
            let kernels = block.constraint.in_lanes();
            let [parameters, times] = kernels.map_or([0, 0], InLanes::n_known);
            let (first, between) = (n_known, n_known + parameters);
            n_known = between + times;
            let depends = block.constraint.depends();
            blocks.push(WideBlock {
                table: kernels.map(|kernels| S::table(&kernels.kernels())),
                of_parameters: Span::new(first..between),
                of_time: Span::new(between..n_known),
                known: Span::new(first..n_known),
                states: Span::new(block.states as usize..states),
                rows: block.rows,
                values: block.values,
                rates: Span::new(block.rates as usize..rates),
                same: !varied,
                on_t: depends.c_on_t || depends.c_q_on_t,
                c_t: depends.c_t,
                q_d: depends.q_d,
            });
        }
        let c_q_on_t = equations.blocks.iter().any(|block| block.constraint.depends().c_q_on_t);
        WideEquations { simd, blocks, c_q_on_t, n_known, scratch: Scratch::default() }
    }

    /// Room for an instant.
    pub(crate) fn instant(&self, equations: &Equations) -> WideInstant<S> {
        let zero = Wide::splat(self.simd, 0.0);
        WideInstant {
            t: f64::NAN,
            known: vec![zero; self.n_known],
            states: equations.plan.wide_states(self.simd),
            rates: vec![zero; equations.plan.n_columns()],
        }
    }

    /// What depends on parameters alone.
    pub(crate) fn set_parameters(&mut self, crew: &Crew<'_>, instant: &mut WideInstant<S>) {
        for (block, own) in self.blocks.iter().zip(&crew.own).filter(|(block, _)| block.table.is_some()) {
            let write = |constraint: &dyn InLanes, known: &mut [f64]| constraint.of_parameters(known);
            fill(&mut instant.known[block.of_parameters.range()], block.same, own, &mut self.scratch.known, write);
        }
    }

    /// What depends on the time too.
    #[inline(always)]
    pub(crate) fn set_time(&mut self, t: f64, crew: &Crew<'_>, instant: &mut WideInstant<S>) {
        instant.t = t;
        for (block, own) in self.blocks.iter().zip(&crew.own).filter(|(block, _)| block.of_time.len > 0) {
            let write = |constraint: &dyn InLanes, known: &mut [f64]| constraint.of_time(t, known);
            fill(&mut instant.known[block.of_time.range()], block.same, own, &mut self.scratch.known, write);
        }
    }

    #[inline(always)]
    pub(crate) fn set_position(&self, crew: &Crew<'_>, q: &[Wide<S>], instant: &mut WideInstant<S>) {
        let Some(system) = crew.systems.first() else { return };
        system.equations().plan.set_wide_states(q, &mut instant.states);
    }

    #[inline(always)]
    pub(crate) fn set_rates(&self, crew: &Crew<'_>, qd: &[Wide<S>], instant: &mut WideInstant<S>) {
        let Some(system) = crew.systems.first() else { return };
        system.equations().plan.set_rates(qd, &mut instant.rates);
    }

    /// C and the values of C_q that are not the same for good.
    #[inline(always)]
    pub(crate) fn linearize(&mut self, crew: &Crew<'_>, instant: &WideInstant<S>, c: &mut [Wide<S>], values: &mut [Wide<S>]) {
        self.linearize_some(false, crew, instant, c, values);
    }

    /// The same where only the time has changed since; false if C_q has not changed with it.
    #[inline(always)]
    pub(crate) fn relinearize(&mut self, crew: &Crew<'_>, instant: &WideInstant<S>, c: &mut [Wide<S>], values: &mut [Wide<S>]) -> bool {
        self.linearize_some(true, crew, instant, c, values);
        self.c_q_on_t
    }

    /// All constraints, or only those that depend on the time.
    #[inline(always)]
    fn linearize_some(&mut self, on_t: bool, crew: &Crew<'_>, instant: &WideInstant<S>, c: &mut [Wide<S>], values: &mut [Wide<S>]) {
        for (k, block) in self.blocks.iter().enumerate().filter(|(_, block)| block.on_t || !on_t) {
            let (c, values) = (&mut c[block.rows.range()], &mut values[block.values.range()]);
            match block.table {
                Some(table) => (table.linearize)(&block.at(self.simd, k, crew, instant), c, values),
                None => linearize_lane_by_lane(&mut self.scratch, k, crew, instant.t, &instant.states[block.states.range()], c, values),
            }
        }
    }

    /// −C_t; rows that are always zero are cleared.
    #[inline(always)]
    pub(crate) fn velocity_rhs(&mut self, crew: &Crew<'_>, instant: &WideInstant<S>, rhs: &mut [Wide<S>]) {
        rhs.fill(Wide::splat(self.simd, 0.0));
        for (k, block) in self.blocks.iter().enumerate().filter(|(_, block)| block.c_t) {
            let rhs = &mut rhs[block.rows.range()];
            match block.table {
                Some(table) => (table.velocity_rhs)(&block.at(self.simd, k, crew, instant), rhs),
                None => right_side_lane_by_lane(&mut self.scratch, (k, block), crew, instant, false, rhs),
            }
        }
    }

    /// Q_d; rows that are always zero are cleared.
    #[inline(always)]
    pub(crate) fn acceleration_rhs(&mut self, crew: &Crew<'_>, instant: &WideInstant<S>, q_d: &mut [Wide<S>]) {
        q_d.fill(Wide::splat(self.simd, 0.0));
        for (k, block) in self.blocks.iter().enumerate().filter(|(_, block)| block.q_d) {
            let q_d = &mut q_d[block.rows.range()];
            let rates = LaneRates(&instant.rates[block.rates.range()]);
            match block.table {
                Some(table) => (table.acceleration_rhs)(&block.at(self.simd, k, crew, instant), &rates, q_d),
                None => right_side_lane_by_lane(&mut self.scratch, (k, block), crew, instant, true, q_d),
            }
        }
    }
}

impl<S: Level> WideBlock<S> {
    /// The instant as it sees it, being constraint `k`.
    #[inline(always)]
    fn at<'a>(&self, simd: S, k: usize, crew: &'a Crew<'_>, instant: &'a WideInstant<S>) -> LaneAt<'a, S> {
        LaneAt::new(simd, &instant.states[self.states.range()], &instant.known[self.known.range()], &crew.own[k])
    }
}

#[inline(never)]
fn linearize_lane_by_lane<S: Level>(
    scratch: &mut Scratch,
    k: usize,
    crew: &Crew<'_>,
    t: f64,
    states: &[Wide<S>],
    c: &mut [Wide<S>],
    values: &mut [Wide<S>],
) {
    for (lane, system) in crew.systems.iter().enumerate() {
        let block = &system.equations().blocks[k];
        take(states, lane, &mut scratch.states);
        take(c, lane, &mut scratch.c);
        take(values, lane, &mut scratch.values);
        block.constraint.linearize(&At::new(t, &scratch.states, &block.arguments.first_state), &mut scratch.c, &mut scratch.values);
        put(&scratch.c, lane, c);
        put(&scratch.values, lane, values);
    }
}

/// −C_t, or Q_d if `second`.
#[inline(never)]
fn right_side_lane_by_lane<S: Level>(
    scratch: &mut Scratch,
    (k, own): (usize, &WideBlock<S>),
    crew: &Crew<'_>,
    instant: &WideInstant<S>,
    second: bool,
    rhs: &mut [Wide<S>],
) {
    for (lane, system) in crew.systems.iter().enumerate() {
        let block = &system.equations().blocks[k];
        take(&instant.states[own.states.range()], lane, &mut scratch.states);
        take(&instant.rates[own.rates.range()], lane, &mut scratch.rates);
        take(rhs, lane, &mut scratch.c);
        let at = At::new(instant.t, &scratch.states, &block.arguments.first_state);
        if second {
            let rates = Rates::new(&scratch.rates, &block.arguments.first_column);
            block.constraint.acceleration_rhs(&at, &rates, 1.0, &mut scratch.c);
        } else {
            block.constraint.velocity_rhs(&at, &mut scratch.c);
        }
        put(&scratch.c, lane, rhs);
    }
}

/// Fills numbers with what the constraint of each lane writes, or the first one for all.
fn fill<S: Level>(
    numbers: &mut [Wide<S>],
    same: bool,
    own: &[&dyn InLanes],
    scratch: &mut Vec<f64>,
    write: impl Fn(&dyn InLanes, &mut [f64]),
) {
    scratch.clear();
    scratch.resize(numbers.len(), 0.0);
    for (lane, constraint) in own.iter().enumerate().take(if same { 1 } else { own.len() }) {
        write(*constraint, scratch);
        for (number, x) in numbers.iter_mut().zip(scratch.iter()) {
            if same {
                number.as_mut_slice().fill(*x);
            } else {
                number.as_mut_slice()[lane] = *x;
            }
        }
    }
}

/// The numbers of a lane.
fn take<S: Level>(all: &[Wide<S>], lane: usize, own: &mut Vec<f64>) {
    own.clear();
    own.extend(all.iter().map(|x| x.as_slice()[lane]));
}

fn put<S: Level>(own: &[f64], lane: usize, all: &mut [Wide<S>]) {
    all.iter_mut().zip(own).for_each(|(x, own)| x.as_mut_slice()[lane] = *own);
}
