//! Defines a tape, the form of a program that Kin runs: steps in runs of one kind, on a memory of
//! numbers.
//!
//! The interpreter decodes each run only once.

pub(crate) mod alone;
mod masks;
mod newton;
mod order;
mod places;
pub(in crate::program) mod replay;
mod rows;
mod schedule;
mod straight;
pub(crate) mod times;

pub(crate) use masks::Masks;
pub(crate) use schedule::{schedule, straight};
pub(crate) use straight::{IntoRows, OverTimes, Rows, Sink, Straight, Summed};

use kin_graph::{Comparison, Function, Function2};

use crate::law::Law;
use crate::program::gather::{Case, Free};
use crate::system::System;

/// The operation of a step.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(in crate::program) enum Kind {
    Add,
    Sub,
    Mul,
    Div,
    Neg,
    /// Writes a b + c.
    Fma,
    /// Writes c − a b.
    NegatedProduct,
    /// Writes a b − c.
    ProductLess,
    /// Writes −a b − c.
    NegatedSum,
    /// Writes max(c, |a b|).
    LargerProduct,
    /// Writes the sine into `out` and the cosine into `c`.
    SinCos,
    /// Writes a derivative of a law (law, order) and the two that follow it into `out`, `b` and
    /// `c`.
    Law(u32, u8),
    One(Function),
    Two(Function2),
    Power(i32),
    Compare(Comparison),
    Both,
    Either,
    Not,
    /// Writes `b` if `a` holds, otherwise `c`.
    Select,
}

/// The place of the result of a step, and the places of its operands `a`, `b` and `c`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::program) struct Step<P = u32> {
    /// The place of the result.
    pub out: P,
    /// The place of the first operand.
    pub a: P,
    /// The place of the second operand.
    pub b: P,
    /// The place of the third operand.
    pub c: P,
}

impl Step {
    /// Returns the step with places of one byte, if they are that small.
    fn short(self) -> Option<Step<u8>> {
        let [out, a, b, c] =
            [self.out, self.a, self.b, self.c].map(|place| u8::try_from(place).ok());
        Some(Step { out: out?, a: a?, b: b?, c: c? })
    }
}

/// Consecutive steps of one kind, with their number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::program) struct Run {
    pub kind: Kind,
    pub steps: u32,
}

/// One stage.
#[derive(Clone, Debug, Default)]
pub(in crate::program) struct Stage {
    /// The runs in order; together they cover `steps`.
    pub runs: Vec<Run>,
    /// The steps in order.
    pub steps: Vec<Step>,
    /// All steps with places of one byte; empty if a place is larger. In a memory of [`SHORT`]
    /// numbers such a place needs no bounds check.
    pub short: Vec<Step<u8>>,
}

/// The number of places that one byte can address.
pub(in crate::program) const SHORT: usize = 1 << u8::BITS;

/// A program on a memory of `places` numbers. Places are indices into this memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tape {
    /// The values that depend on parameters alone; run once for each case.
    pub(in crate::program) setup: Stage,
    /// The values that depend on time alone; run once for each time.
    pub(in crate::program) time: Stage,
    /// The correction of the torn coordinates; run once for each Newton step.
    pub(in crate::program) correct: Stage,
    /// All other values; run once after Newton's method.
    pub(in crate::program) rest: Stage,
    /// The number of places of the memory.
    pub(in crate::program) places: usize,
    /// The constants, as (place, value).
    pub(in crate::program) constants: Vec<(u32, f64)>,
    /// The laws, by their indices in [`Kind::Law`].
    pub(in crate::program) laws: Vec<Law>,
    /// The numbers and laws that differ from case to case.
    pub(in crate::program) free: Free,
    /// For each free parameter its place.
    pub(in crate::program) parameters: Vec<u32>,
    /// The place of the time.
    pub(in crate::program) t: u32,
    /// For each torn coordinate its place.
    pub(in crate::program) torn: Vec<u32>,
    /// For each torn coordinate its index in the system.
    pub(in crate::program) columns: Vec<usize>,
    /// For each torn coordinate the place of its correction.
    pub(in crate::program) correction: Vec<u32>,
    /// The remaining rows, by their indices in the system.
    pub(in crate::program) rows: Vec<usize>,
    /// For each remaining row the place of −C with all explicit coordinates substituted.
    pub(in crate::program) left: Vec<u32>,
    /// For each block of the elimination the places of its pivots and determinants.
    pub(in crate::program) guards: Vec<Vec<u32>>,
    /// The values of the guards at the position at which the elimination was chosen.
    pub(in crate::program) chosen: Vec<Vec<f64>>,
    /// For each block the number of unknowns that are solved together.
    pub(in crate::program) blocks: Vec<usize>,
    /// For each coordinate of the system the place of its value.
    pub(in crate::program) values: Vec<u32>,
    /// For each coordinate the place of its last correction.
    pub(in crate::program) corrections: Vec<u32>,
    /// For each coordinate the place of q̇.
    pub(in crate::program) rates: Vec<u32>,
    /// For each coordinate the place of q̈.
    pub(in crate::program) second_rates: Vec<u32>,
    /// For each coordinate the place of q⃛; empty unless the jerk is computed.
    pub(in crate::program) third_rates: Vec<u32>,
    /// The places of the numbers that select branches depending on coordinates; empty if nothing
    /// can jump.
    pub(in crate::program) sides: Vec<u32>,
    /// For each row of the system the place of C as written, at the coordinates `values`.
    pub(in crate::program) verify: Vec<u32>,
}

impl Stage {
    /// Appends a step, to the last run if that has the same kind.
    pub(in crate::program) fn push(&mut self, kind: Kind, step: Step) {
        self.steps.push(step);
        match self.runs.last_mut() {
            Some(run) if run.kind == kind => run.steps += 1,
            _ => self.runs.push(Run { kind, steps: 1 }),
        }
    }

    /// Appends the steps of another stage.
    pub(in crate::program) fn append(&mut self, other: Stage) {
        let mut steps = other.steps.into_iter();
        for Run { kind, steps: count } in other.runs {
            steps.by_ref().take(count as usize).for_each(|step| self.push(kind, step));
        }
    }

    /// Converts the places to one byte, if all are that small.
    pub(in crate::program) fn shorten(&mut self) {
        self.short =
            self.steps.iter().map(|step| step.short()).collect::<Option<_>>().unwrap_or_default();
    }
}

impl Tape {
    /// Returns the coordinates that Newton's method computes.
    pub(crate) fn torn(&self) -> &[usize] {
        &self.columns
    }

    /// Returns the numbers and laws of a case, or `None` if a folded value differs.
    pub(crate) fn case(&self, system: &System) -> Option<Case> {
        self.free.case(system, &self.laws)
    }

    /// Returns the constraint of each free parameter, and the index of the parameter there.
    pub(crate) fn slots(&self) -> &[(usize, usize)] {
        self.free.slots()
    }

    /// Returns a law that no text can contain: it is not among the drivers, and is neither a
    /// formula nor a table, or differs from case to case.
    pub(crate) fn law_without_text(&self, drivers: &[Law]) -> Option<&Law> {
        let stages = [&self.setup, &self.time, &self.correct, &self.rest];
        let of_run = |run: &Run| match run.kind {
            Kind::Law(law, _) => Some(law as usize),
            _ => None,
        };
        let mut read = stages.into_iter().flat_map(|stage| &stage.runs).filter_map(of_run);
        let has_none = |law: usize| {
            let own = self.laws.get(law)?;
            let is_driver = drivers.iter().any(|driver| driver.is(own));
            let is_table = own.pieces().is_some() && !self.free.has_law(law);
            (!is_driver && !is_table).then_some(own)
        };
        read.find_map(has_none)
    }

    /// Returns true if anything may jump depending on coordinates.
    pub(crate) fn jumps(&self) -> bool {
        !self.sides.is_empty()
    }

    /// Returns the number of unknowns of each block that is solved together.
    pub(crate) fn blocks(&self) -> &[usize] {
        &self.blocks
    }

    /// Returns the number of steps and of runs.
    pub(crate) fn size(&self) -> [usize; 2] {
        let stages = [&self.setup, &self.time, &self.correct, &self.rest];
        [
            stages.iter().map(|stage| stage.steps.len()).sum(),
            stages.iter().map(|stage| stage.runs.len()).sum(),
        ]
    }
}
