//! The code of a recorded elimination as lanes replay it: steps of a fixed form, each with its operands beside its opcode.
//!
//! Of the common forms the interpreter has a loop-free copy each; a longer step is cut into several that add up in its own place. A memory of
//! at most 256 numbers is addressed by bytes, which cannot leave it: there no access is checked.

use std::marker::PhantomData;

use pulp::NullaryFnOnce;

use super::program::{Kind, Operands, Program, Step as Recorded};
use crate::lanes::{Level, Wide};

/// Up to this many numbers a memory is addressed by bytes, and must have at least this length.
pub(super) const SMALL: usize = 256;

/// Products, numbers added and numbers subtracted that one step has at most.
const MOST: [usize; 3] = [2, 1, 1];

/// Shapes of each form of step.
const SHAPES: usize = (MOST[0] + 1) * (MOST[1] + 1) * (MOST[2] + 1);

/// What a step does; `start − Σ products + Σ plus − Σ minus` is the sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Form {
    /// Writes the sum.
    Plain,
    /// −start + Σ products instead, and start + Σ products.
    Negated,
    Added,
    /// Writes the sum times the scale: a multiplier.
    Scaled,
    /// Writes one over the sum: a pivot.
    Pivot,
}

/// A step: what it does, and where its number goes, where it starts, its scale and its operands.
#[derive(Clone, Copy, Debug)]
struct Step {
    opcode: u8,
    places: [u32; 9],
}

/// The steps of a program, in order.
#[derive(Clone, Debug, Default)]
pub(super) struct Replay {
    steps: Vec<Step>,
}

/// A memory that is addressed by 32 bits, of which only as many count as it needs.
pub(super) trait Memory<S: Level> {
    fn get(&self, place: u32) -> Wide<S>;
    fn set(&mut self, place: u32, x: Wide<S>);
}

impl<S: Level> Memory<S> for [Wide<S>; SMALL] {
    #[inline(always)]
    fn get(&self, place: u32) -> Wide<S> {
        self[usize::from(place as u8)]
    }

    #[inline(always)]
    fn set(&mut self, place: u32, x: Wide<S>) {
        self[usize::from(place as u8)] = x;
    }
}

impl<S: Level> Memory<S> for [Wide<S>] {
    #[inline(always)]
    fn get(&self, place: u32) -> Wide<S> {
        self[place as usize]
    }

    #[inline(always)]
    fn set(&mut self, place: u32, x: Wide<S>) {
        self[place as usize] = x;
    }
}

impl Replay {
    pub(super) fn new(program: &Program) -> Self {
        let mut replay = Replay::default();
        program.each(|step, operands| replay.push(step, operands));
        replay
    }

    fn push(&mut self, step: &Recorded, Operands { mut products, mut plus, mut minus }: Operands<'_>) {
        let mut start = None;
        loop {
            let (own_products, own_plus, own_minus);
            (own_products, products) = products.split_at(products.len().min(MOST[0]));
            (own_plus, plus) = plus.split_at(plus.len().min(MOST[1]));
            (own_minus, minus) = minus.split_at(minus.len().min(MOST[2]));
            let last = products.is_empty() && plus.is_empty() && minus.is_empty();
            let form = match step.kind {
                Kind::Negated if start.is_none() => Form::Negated,
                Kind::Negated => Form::Added,
                Kind::Scaled if last => Form::Scaled,
                Kind::Pivot if last => Form::Pivot,
                _ => Form::Plain,
            };
            let places = [step.out, start.unwrap_or(step.start), step.scale];
            self.write(form, places, own_products, own_plus, own_minus);
            if last {
                return;
            }
            start = Some(step.out);
        }
    }

    fn write(&mut self, form: Form, [out, start, scale]: [u32; 3], products: &[[u32; 2]], plus: &[u32], minus: &[u32]) {
        let shape = (products.len() * (MOST[1] + 1) + plus.len()) * (MOST[2] + 1) + minus.len();
        let mut places = [0; 9];
        let all = [out, start, scale].into_iter().chain(products.iter().flatten().copied());
        let all = all.chain(plus.iter().copied()).chain(minus.iter().copied());
        places.iter_mut().zip(all).for_each(|(place, own)| *place = own);
        self.steps.push(Step { opcode: (form as usize * SHAPES + shape) as u8, places });
    }

    /// Runs all steps.
    ///
    /// A function of its own: inlined without optimisation, the copies of the interpreter would need more stack than a thread has.
    pub(super) fn run<S: Level, M: Memory<S> + ?Sized>(&self, simd: S, memory: &mut M) {
        simd.vectorize(Run(&self.steps, memory, PhantomData::<S>));
    }
}

/// A replay on its way into the function that has the machine's instructions.
struct Run<'r, S, M: ?Sized>(&'r [Step], &'r mut M, PhantomData<S>);

impl<S: Level, M: Memory<S> + ?Sized> NullaryFnOnce for Run<'_, S, M> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Run(steps, memory, _) = self;
        for step in steps {
            by_opcode(step, memory);
        }
    }
}

macro_rules! copies {
    ($step:expr, $memory:expr; $($opcode:literal)*) => {
        match $step.opcode {
            $($opcode => compute::<S, M, $opcode>(&$step.places, $memory),)*
            _ => {}
        }
    };
}

#[rustfmt::skip]
#[inline(always)]
fn by_opcode<S: Level, M: Memory<S> + ?Sized>(step: &Step, memory: &mut M) {
    copies!(step, memory;
        0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29
        30 31 32 33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59)
}

const fn form(opcode: usize) -> Form {
    match opcode / SHAPES {
        0 => Form::Plain,
        1 => Form::Negated,
        2 => Form::Added,
        3 => Form::Scaled,
        _ => Form::Pivot,
    }
}

/// Products, numbers added and numbers subtracted of an opcode.
const fn shape(opcode: usize) -> [usize; 3] {
    let shape = opcode % SHAPES;
    [shape / (MOST[1] + 1) / (MOST[2] + 1), shape / (MOST[2] + 1) % (MOST[1] + 1), shape % (MOST[2] + 1)]
}

/// A step that is known when the interpreter is compiled.
#[inline(always)]
fn compute<S: Level, M: Memory<S> + ?Sized, const OPCODE: usize>(places: &[u32; 9], memory: &mut M) {
    let (form, [products, plus, minus]) = const { (form(OPCODE), shape(OPCODE)) };
    let start = memory.get(places[1]);
    let mut x = if matches!(form, Form::Negated) { -start } else { start };
    let added = matches!(form, Form::Negated | Form::Added);
    if products > 0 {
        let (a, b) = (memory.get(places[3]), memory.get(places[4]));
        x = if added { a.mul_add(b, x) } else { a.negative_mul_add(b, x) };
    }
    if products > 1 {
        let (a, b) = (memory.get(places[5]), memory.get(places[6]));
        x = if added { a.mul_add(b, x) } else { a.negative_mul_add(b, x) };
    }
    if plus > 0 {
        x = x + memory.get(places[3 + 2 * products]);
    }
    if minus > 0 {
        x = x - memory.get(places[3 + 2 * products + plus]);
    }
    if matches!(form, Form::Scaled) {
        x = x * memory.get(places[2]);
    }
    memory.set(places[0], if matches!(form, Form::Pivot) { x.reciprocal() } else { x });
}
