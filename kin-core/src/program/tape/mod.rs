//! A program as a tape: steps in runs of one kind, on a memory of numbers, so that what is to be
//! done is found out once a run.

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

/// Why no tape can be replayed here.
pub(crate) const NO_LANES: &str =
    "this machine has no registers for several times at once (AVX-512, AVX2 with FMA, Neon)";

use crate::model::law::Law;
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
    /// a b + c
    Fma,
    /// c − a b
    NegatedProduct,
    /// a b − c
    ProductLess,
    /// −a b − c
    NegatedSum,
    /// max(c, |a b|)
    LargerProduct,
    /// Sine into `out`, cosine into `c`.
    SinCos,
    /// The derivative of that order of the law of that number, and the two that follow it, into
    /// `out`, `b` and `c`.
    Law(u32, u8),
    One(Function),
    Two(Function2),
    Power(i32),
    Compare(Comparison),
    Both,
    Either,
    Not,
    /// `a` holds: `b`, else `c`.
    Select,
}

/// Where a step writes, and its operands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::program) struct Step<P = u32> {
    pub out: P,
    pub a: P,
    pub b: P,
    pub c: P,
}

impl Step {
    /// The same with places of one byte, if they are that small.
    fn short(self) -> Option<Step<u8>> {
        let [out, a, b, c] =
            [self.out, self.a, self.b, self.c].map(|place| u8::try_from(place).ok());
        Some(Step { out: out?, a: a?, b: b?, c: c? })
    }
}

/// Steps of one kind, by how many there are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::program) struct Run {
    pub kind: Kind,
    pub steps: u32,
}

/// One stage.
#[derive(Clone, Debug, Default)]
pub(in crate::program) struct Stage {
    pub runs: Vec<Run>,
    pub steps: Vec<Step>,
    /// All steps with places of one byte; none where some place is larger. In a memory of [`SHORT`]
    /// numbers no such place has to be looked at before it is read.
    pub short: Vec<Step<u8>>,
}

/// Numbers of a memory whose places are one byte.
pub(in crate::program) const SHORT: usize = 1 << u8::BITS;

/// A program on a memory of `places` numbers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tape {
    /// The values of parameters alone, once a case; those of time alone; those that lead to the
    /// correction; all others.
    pub(in crate::program) setup: Stage,
    pub(in crate::program) time: Stage,
    pub(in crate::program) correct: Stage,
    pub(in crate::program) rest: Stage,
    pub(in crate::program) places: usize,
    pub(in crate::program) constants: Vec<(u32, f64)>,
    pub(in crate::program) laws: Vec<Law>,
    /// The numbers and laws that differ from case to case, and where the numbers stand.
    pub(in crate::program) free: Free,
    pub(in crate::program) parameters: Vec<u32>,
    /// Where the time stands, and the torn coordinates.
    pub(in crate::program) t: u32,
    pub(in crate::program) torn: Vec<u32>,
    /// Which coordinates are torn.
    pub(in crate::program) columns: Vec<usize>,
    pub(in crate::program) correction: Vec<u32>,
    /// The rows that are left, and where they stand.
    pub(in crate::program) rows: Vec<usize>,
    pub(in crate::program) left: Vec<u32>,
    pub(in crate::program) guards: Vec<Vec<u32>>,
    /// Pivots and determinants where the elimination was chosen.
    pub(in crate::program) chosen: Vec<Vec<f64>>,
    /// How many unknowns are solved together, block by block.
    pub(in crate::program) blocks: Vec<usize>,
    pub(in crate::program) values: Vec<u32>,
    pub(in crate::program) corrections: Vec<u32>,
    pub(in crate::program) rates: Vec<u32>,
    pub(in crate::program) second_rates: Vec<u32>,
    /// q⃛ where it is asked for, else none.
    pub(in crate::program) third_rates: Vec<u32>,
    /// The numbers that choose between sides where coordinates move.
    pub(in crate::program) sides: Vec<u32>,
    pub(in crate::program) verify: Vec<u32>,
}

impl Stage {
    /// Appends a step, in the run before it if that is of its kind.
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

    /// Makes places one byte, if all are that small.
    pub(in crate::program) fn shorten(&mut self) {
        self.short =
            self.steps.iter().map(|step| step.short()).collect::<Option<_>>().unwrap_or_default();
    }
}

impl Tape {
    /// The coordinates that are left to Newton's method.
    pub(crate) fn torn(&self) -> &[usize] {
        &self.columns
    }

    /// The numbers and laws of a case; `None` where something is another that was folded.
    pub(crate) fn case(&self, system: &System) -> Option<Case> {
        self.free.case(system, &self.laws)
    }

    /// True if anything may jump where coordinates move.
    pub(crate) fn jumps(&self) -> bool {
        !self.sides.is_empty()
    }

    /// How many of them are solved together, block by block.
    pub(crate) fn blocks(&self) -> &[usize] {
        &self.blocks
    }

    /// How many steps and runs it has.
    pub(crate) fn size(&self) -> [usize; 2] {
        let stages = [&self.setup, &self.time, &self.correct, &self.rest];
        [
            stages.iter().map(|stage| stage.steps.len()).sum(),
            stages.iter().map(|stage| stage.runs.len()).sum(),
        ]
    }
}
