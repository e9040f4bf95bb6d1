//! Evaluation over lanes: several systems of one pattern at once, by kernels where constraints have them,
//! else lane by lane.

use super::{Equations, Span, StatePlan};
use crate::model::state::{At, Offsets, Rates, SPATIAL_STATE};
use crate::numbers::lanes::{InLanes, LaneBlock, LaneInstant, Level, Table, Wide};
use crate::system::System;

/// One constraint over lanes.
struct WideBlock {
    /// Where what it knows stands: of parameters, and of the time.
    of_parameters: Span,
    of_time: Span,
    /// Where its arguments, its rows and its values stand.
    arguments: Span,
    rows: Span,
    values: Span,
    /// True if the value is the same in all lanes.
    same: bool,
}

/// Constraints that are evaluated by one call of a kernel, or lane by lane; by what they are asked for.
struct Group<S: Level> {
    table: Option<Table<S>>,
    all: Vec<LaneBlock>,
    /// Constraints whose C, or C_q, depends on the time.
    on_t: Vec<LaneBlock>,
    /// Constraints whose C_t, or Q_d, can be other than zero.
    c_t: Vec<LaneBlock>,
    q_d: Vec<LaneBlock>,
}

/// All constraints of a system over lanes.
pub(crate) struct WideEquations<S: Level> {
    simd: S,
    blocks: Vec<WideBlock>,
    groups: Vec<Group<S>>,
    plan: StatePlan,
    /// True if some C_q depends on the time.
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

/// The arguments of constraints at one instant, over lanes, but for the rates.
pub(crate) struct WideInstant<S: Level> {
    t: f64,
    known: Vec<Wide<S>>,
    states: Vec<Wide<S>>,
}

/// The systems of all lanes, with their constraints as kernels over lanes see them.
pub(crate) struct LaneSystems<'a> {
    pub systems: &'a [System],
    /// For each constraint with kernels, those of all lanes.
    own: Vec<Vec<&'a dyn InLanes>>,
}

impl<'a> LaneSystems<'a> {
    pub(crate) fn new(systems: &'a [System]) -> Self {
        let count = systems.first().map_or(0, |system| system.equations().blocks.len());
        let lanes = |k: usize| {
            systems
                .iter()
                .filter_map(move |system| system.equations().blocks[k].constraint.parts().in_lanes)
                .collect()
        };
        LaneSystems { systems, own: (0..count).map(lanes).collect() }
    }
}

impl<S: Level> WideEquations<S> {
    /// Those of `equations`; `varied` are the constraints that differ from lane to lane.
    pub(crate) fn new(simd: S, equations: &Equations, varied: &[bool]) -> Self {
        let mut all = WideEquations {
            simd,
            blocks: Vec::new(),
            groups: Vec::new(),
            plan: equations.plan.clone(),
            c_q_on_t: equations.blocks.iter().any(|block| block.constraint.facts().dependence.c_q_on_t),
            n_known: 0,
            scratch: Scratch::default(),
        };
        equations.blocks.iter().zip(varied).for_each(|(block, varied)| all.append(block, *varied));
        all
    }

    /// One more constraint.
    fn append(&mut self, block: &super::Block, varied: bool) {
        let (kernels, depends) = (block.constraint.parts().in_lanes, block.constraint.facts().dependence);
        let [parameters, times] = kernels.map_or([0, 0], InLanes::n_known);
        let (first, between) = (self.n_known, self.n_known + parameters);
        self.n_known = between + times;
        let place = LaneBlock {
            number: self.blocks.len() as u32,
            arguments: block.arguments.first,
            known: first as u32,
            rows: block.rows.first,
            values: block.values.first,
        };
        let table = kernels.map(|kernels| S::table(&kernels.kernels()));
        let same = |group: &&mut Group<S>| match (&group.table, &table) {
            (Some(known), Some(table)) => known.is(table),
            (known, table) => known.is_none() && table.is_none(),
        };
        let known = self.groups.iter_mut().find(same);
        let mut new = Group { table, all: Vec::new(), on_t: Vec::new(), c_t: Vec::new(), q_d: Vec::new() };
        let is_new = known.is_none();
        let group = known.unwrap_or(&mut new);
        let lists = [
            (true, &mut group.all),
            (depends.c_on_t || depends.c_q_on_t, &mut group.on_t),
            (depends.c_t, &mut group.c_t),
            (depends.q_d, &mut group.q_d),
        ];
        lists.into_iter().filter(|(asked, _)| *asked).for_each(|(_, list)| list.push(place));
        if is_new {
            self.groups.push(new);
        }
        self.blocks.push(WideBlock {
            of_parameters: Span::new(first..between),
            of_time: Span::new(between..self.n_known),
            arguments: block.arguments,
            rows: block.rows,
            values: block.values,
            same: !varied,
        });
    }

    /// The rows whose right sides −C_t, or Q_d, can be other than zero.
    pub(crate) fn asked(&self) -> [Vec<usize>; 2] {
        let rows = |list: fn(&Group<S>) -> &Vec<LaneBlock>| {
            let asked = self.groups.iter().flat_map(list).map(|place| &self.blocks[place.number as usize]);
            asked.flat_map(|block| block.rows.range()).collect()
        };
        [rows(|group| &group.c_t), rows(|group| &group.q_d)]
    }

    /// Room for an instant.
    pub(crate) fn instant(&self) -> WideInstant<S> {
        WideInstant {
            t: f64::NAN,
            known: vec![Wide::splat(self.simd, 0.0); self.n_known],
            states: self.plan.wide_states(self.simd),
        }
    }

    /// Computes the values that depend on parameters alone.
    pub(crate) fn set_parameters(&mut self, batch: &LaneSystems<'_>, instant: &mut WideInstant<S>) {
        for (block, own) in
            self.blocks.iter().zip(&batch.own).filter(|(block, _)| block.of_parameters.len > 0)
        {
            let write = |constraint: &dyn InLanes, known: &mut [f64]| constraint.of_parameters(known);
            fill(
                &mut instant.known[block.of_parameters.range()],
                block.same,
                own,
                &mut self.scratch.known,
                write,
            );
        }
    }

    /// Computes the values that depend on the time too.
    #[inline(always)]
    pub(crate) fn set_time(&mut self, t: f64, batch: &LaneSystems<'_>, instant: &mut WideInstant<S>) {
        instant.t = t;
        for (block, own) in self.blocks.iter().zip(&batch.own).filter(|(block, _)| block.of_time.len > 0) {
            let write = |constraint: &dyn InLanes, known: &mut [f64]| constraint.of_time(t, known);
            fill(&mut instant.known[block.of_time.range()], block.same, own, &mut self.scratch.known, write);
        }
    }

    #[inline(always)]
    pub(crate) fn set_position(&self, q: &[Wide<S>], instant: &mut WideInstant<S>) {
        self.plan.set_wide_states(q, &mut instant.states);
    }

    /// C and the values of C_q that are not the same for good.
    #[inline(always)]
    pub(crate) fn linearize(
        &mut self,
        batch: &LaneSystems<'_>,
        instant: &WideInstant<S>,
        c: &mut [Wide<S>],
        values: &mut [Wide<S>],
    ) {
        self.linearize_some(|group| &group.all, batch, instant, c, values);
    }

    /// The same where only the time has changed since; false if C_q has not changed with it.
    #[inline(always)]
    pub(crate) fn relinearize(
        &mut self,
        batch: &LaneSystems<'_>,
        instant: &WideInstant<S>,
        c: &mut [Wide<S>],
        values: &mut [Wide<S>],
    ) -> bool {
        self.linearize_some(|group| &group.on_t, batch, instant, c, values);
        self.c_q_on_t
    }

    /// All constraints, or only some of each group.
    #[inline(always)]
    fn linearize_some(
        &mut self,
        some: impl Fn(&Group<S>) -> &Vec<LaneBlock>,
        batch: &LaneSystems<'_>,
        instant: &WideInstant<S>,
        c: &mut [Wide<S>],
        values: &mut [Wide<S>],
    ) {
        let seen = seen(self.simd, self.plan.arguments(), batch, instant, &[]);
        for (group, blocks) in
            self.groups.iter().map(|group| (group, some(group))).filter(|(_, blocks)| !blocks.is_empty())
        {
            match group.table {
                Some(table) => table.linearize(&seen, blocks, c, values),
                None => {
                    let alone = LaneByLane { blocks: &self.blocks, seen: &seen, batch, t: instant.t };
                    blocks.iter().for_each(|place| alone.linearize(&mut self.scratch, place, c, values));
                }
            }
        }
    }

    /// −C_t in the rows where it can be other than zero.
    #[inline(always)]
    pub(crate) fn velocity_rhs(
        &mut self,
        batch: &LaneSystems<'_>,
        instant: &WideInstant<S>,
        rhs: &mut [Wide<S>],
    ) {
        let seen = seen(self.simd, self.plan.arguments(), batch, instant, &[]);
        for group in self.groups.iter().filter(|group| !group.c_t.is_empty()) {
            match group.table {
                Some(table) => table.velocity_rhs(&seen, &group.c_t, rhs),
                None => {
                    let alone = LaneByLane { blocks: &self.blocks, seen: &seen, batch, t: instant.t };
                    group.c_t.iter().for_each(|place| alone.right_side(&mut self.scratch, place, None, rhs));
                }
            }
        }
    }

    /// Q_d in the rows where it can be other than zero; `rates` are q̇ and, behind it, the ground's.
    #[inline(always)]
    pub(crate) fn acceleration_rhs(
        &mut self,
        batch: &LaneSystems<'_>,
        instant: &WideInstant<S>,
        rates: &[Wide<S>],
        q_d: &mut [Wide<S>],
    ) {
        let seen = seen(self.simd, self.plan.arguments(), batch, instant, rates);
        for group in self.groups.iter().filter(|group| !group.q_d.is_empty()) {
            match group.table {
                Some(table) => table.acceleration_rhs(&seen, &group.q_d, q_d),
                None => {
                    let alone = LaneByLane { blocks: &self.blocks, seen: &seen, batch, t: instant.t };
                    let mut of = |place| alone.right_side(&mut self.scratch, place, Some(rates), q_d);
                    group.q_d.iter().for_each(&mut of);
                }
            }
        }
    }
}

/// The instant as kernels see it.
#[inline(always)]
fn seen<'a, S: Level>(
    simd: S,
    arguments: &'a [Offsets],
    batch: &'a LaneSystems<'_>,
    instant: &'a WideInstant<S>,
    rates: &'a [Wide<S>],
) -> LaneInstant<'a, S> {
    LaneInstant { simd, states: &instant.states, rates, known: &instant.known, arguments, own: &batch.own }
}

/// Constraints without kernels: each lane by itself, by the constraint that is there.
struct LaneByLane<'a, 's, S: Level> {
    blocks: &'a [WideBlock],
    seen: &'a LaneInstant<'s, S>,
    batch: &'a LaneSystems<'a>,
    t: f64,
}

impl<S: Level> LaneByLane<'_, '_, S> {
    #[inline(never)]
    fn linearize(&self, scratch: &mut Scratch, place: &LaneBlock, c: &mut [Wide<S>], values: &mut [Wide<S>]) {
        let own = &self.blocks[place.number as usize];
        let (c, values) = (&mut c[own.rows.range()], &mut values[own.values.range()]);
        for (lane, system) in self.batch.systems.iter().enumerate() {
            let block = &system.equations().blocks[place.number as usize];
            self.gather(|of| of.state, own, self.seen.states, lane, &mut scratch.states);
            take(c, lane, &mut scratch.c);
            take(values, lane, &mut scratch.values);
            let at = At::new(self.t, &scratch.states, self.arguments(own));
            block.constraint.linearize(&at, &mut scratch.c, &mut scratch.values);
            put(&scratch.c, lane, c);
            put(&scratch.values, lane, values);
        }
    }

    /// −C_t, or Q_d where rates q̇ are given.
    #[inline(never)]
    fn right_side(&self, room: &mut Scratch, block: &LaneBlock, qd: Option<&[Wide<S>]>, rhs: &mut [Wide<S>]) {
        let own = &self.blocks[block.number as usize];
        let rhs = &mut rhs[own.rows.range()];
        rhs.fill(Wide::splat(self.seen.simd, 0.0));
        for (lane, system) in self.batch.systems.iter().enumerate() {
            let there = &system.equations().blocks[block.number as usize];
            self.gather(|of| of.state, own, self.seen.states, lane, &mut room.states);
            take(rhs, lane, &mut room.c);
            let at = At::new(self.t, &room.states, self.arguments(own));
            if let Some(qd) = qd {
                self.gather(|of| of.rates, own, qd, lane, &mut room.rates);
                let rates = Rates::new(&room.rates, self.arguments(own));
                there.constraint.acceleration_rhs(&at, &rates, 1.0, &mut room.c);
            } else {
                there.constraint.velocity_rhs(&at, &mut room.c);
            }
            put(&room.c, lane, rhs);
        }
    }

    fn arguments(&self, own: &WideBlock) -> &[Offsets] {
        &self.seen.arguments[own.arguments.range()]
    }

    /// The numbers of a constraint's arguments in one lane, where they begin among those of all, and the
    /// numbers behind them, for an argument has at most seven.
    fn gather(
        &self,
        begin: impl Fn(&Offsets) -> u32,
        own: &WideBlock,
        all: &[Wide<S>],
        lane: usize,
        numbers: &mut Vec<f64>,
    ) {
        numbers.resize(all.len(), 0.0);
        for argument in self.arguments(own) {
            let first = begin(argument) as usize;
            let places = first..all.len().min(first + SPATIAL_STATE);
            numbers[places.clone()]
                .iter_mut()
                .zip(&all[places])
                .for_each(|(number, x)| *number = x.as_slice()[lane]);
        }
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

/// Puts the numbers of one lane among those of the others.
pub(crate) fn put<S: Level>(own: &[f64], lane: usize, all: &mut [Wide<S>]) {
    all.iter_mut().zip(own).for_each(|(x, own)| x.as_mut_slice()[lane] = *own);
}
