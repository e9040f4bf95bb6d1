//! Names the numbers of a tape: each result has one name, although places are reused.

use std::collections::{BTreeMap, BTreeSet};

use crate::law::Law;
use crate::program::tape::{Kind, Stage, Straight, Tape};

/// A number that a step reads or that the tape returns.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Value {
    Number(f64),
    /// The time.
    Time,
    /// A torn coordinate.
    Torn(usize),
    /// A free parameter.
    Parameter(usize),
    /// The value, velocity or acceleration of a driver.
    Driver(usize, u8),
    /// The result of a step.
    Result(Name),
}

/// The name of a result: the stage that computes it, and its number in the order of computation.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct Name {
    pub stage: usize,
    pub number: usize,
}

/// One result. A step that computes a sine and a cosine has two lines, and a law has three.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub name: Name,
    pub kind: Kind,
    /// The number of the result among those of its step: 1 for the cosine of [`Kind::SinCos`].
    pub part: usize,
    pub operands: [Value; 3],
}

/// The lines of a tape, stage by stage.
#[derive(Default)]
pub(super) struct Listing {
    pub stages: Vec<Vec<Line>>,
    /// The number at each place after the last step.
    places: BTreeMap<u32, Value>,
    count: usize,
}

impl Listing {
    /// Names the numbers of all stages of a tape; `drivers` are the laws that are inputs.
    pub(super) fn of(tape: &Tape, drivers: &[Law]) -> Self {
        let mut listing = Listing::default();
        listing.places.insert(tape.t, Value::Time);
        for (k, place) in tape.torn.iter().enumerate() {
            listing.places.insert(*place, Value::Torn(k));
        }
        for (k, place) in tape.parameters.iter().enumerate() {
            listing.places.insert(*place, Value::Parameter(k));
        }
        listing.constants(&tape.constants);
        for stage in [&tape.setup, &tape.time, &tape.correct, &tape.rest] {
            listing.stage(stage, (&tape.laws, drivers));
        }
        listing
    }

    /// Names the numbers of a tape of time without stages.
    pub(super) fn of_time(tape: &Straight) -> Self {
        let mut listing = Listing::default();
        for (_, place) in &tape.inputs {
            listing.places.insert(*place, Value::Time);
        }
        listing.constants(&tape.constants);
        listing.stage(&tape.stage, (&tape.laws, &[]));
        listing
    }

    fn constants(&mut self, constants: &[(u32, f64)]) {
        for (place, x) in constants {
            self.places.insert(*place, Value::Number(*x));
        }
    }

    /// Returns the number at a place after the last step.
    pub(super) fn at(&self, place: u32) -> Value {
        self.places.get(&place).copied().unwrap_or(Value::Number(f64::NAN))
    }

    fn stage(&mut self, stage: &Stage, (laws, drivers): (&[Law], &[Law])) {
        let number = self.stages.len();
        let driver = |law: usize| {
            let own = laws.get(law)?;
            drivers.iter().position(|driver| driver.is(own))
        };
        let mut lines = Vec::new();
        let mut steps = stage.steps.iter();
        for run in &stage.runs {
            for step in steps.by_ref().take(run.steps as usize) {
                let operands = [step.a, step.b, step.c].map(|place| self.at(place));
                if let Kind::Law(law, order) = run.kind
                    && let Some(driver) = driver(law as usize)
                {
                    for (place, order) in [step.out, step.b, step.c].into_iter().zip(order..) {
                        let value = match order {
                            0..=2 => Value::Driver(driver, order),
                            _ => Value::Number(0.0),
                        };
                        self.places.insert(place, value);
                    }
                    continue;
                }
                let results: &[u32] = match run.kind {
                    Kind::Law(..) => &[step.out, step.b, step.c],
                    Kind::SinCos => &[step.out, step.c],
                    _ => &[step.out],
                };
                for (part, place) in results.iter().enumerate() {
                    let name = Name { stage: number, number: self.count };
                    self.count += 1;
                    lines.push(Line { name, kind: run.kind, part, operands });
                    self.places.insert(*place, Value::Result(name));
                }
            }
        }
        self.stages.push(lines);
    }

    /// Removes the lines of which nothing reads the result, directly or by other lines.
    pub(super) fn keep(&mut self, outputs: &[Value]) {
        let mut read: BTreeSet<Name> = outputs.iter().filter_map(Value::name).collect();
        for lines in self.stages.iter_mut().rev() {
            for line in lines.iter().rev() {
                if read.contains(&line.name) {
                    read.extend(line.operands.iter().filter_map(Value::name));
                }
            }
            lines.retain(|line| read.contains(&line.name));
        }
    }

    /// Returns the results that a later stage reads, `outputs` being the outputs of each stage.
    pub(super) fn crossing(&self, outputs: &[Vec<Value>]) -> BTreeMap<Name, usize> {
        let mut crossing = BTreeSet::new();
        for (number, lines) in self.stages.iter().enumerate() {
            let read = lines.iter().flat_map(|line| line.operands);
            let read = read.chain(outputs.get(number).into_iter().flatten().copied());
            crossing
                .extend(read.filter_map(|value| value.name()).filter(|name| name.stage != number));
        }
        crossing.into_iter().zip(0..).collect()
    }
}

impl Value {
    /// Returns the name of a result.
    pub(super) fn name(&self) -> Option<Name> {
        match self {
            Value::Result(name) => Some(*name),
            _ => None,
        }
    }
}
