//! The code of a recorded elimination as lanes replay it.
//!
//! Steps are of a fixed form, each with its operands beside its opcode; a longer one is cut into several that
//! add up in its own place. Runs of steps of one form, as in [`code`](super::code), do not pay here: with few
//! products a step they are short. A memory of at most 256 numbers is addressed by bytes, which cannot leave
//! it: there no access is checked.

use std::collections::HashSet;
use std::marker::PhantomData;

use pulp::NullaryFnOnce;

use super::code::Shape;
use super::order::{Ordered, order};
use super::program::{Kind, Operands, Program, Step as Recorded};
use crate::numbers::lanes::{Level, Wide};

/// Up to this many numbers a memory is addressed by bytes, and must have at least this length.
pub(crate) const SMALL: usize = 256;

/// Products, numbers added and numbers subtracted that one step has at most.
const MOST: [usize; 3] = [2, 1, 1];

/// Shapes of each form of step.
const SHAPES: usize = (MOST[0] + 1) * (MOST[1] + 1) * (MOST[2] + 1);

/// Forms of a step; `start − Σ products + Σ plus − Σ minus` is the sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Form {
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

/// The steps of a program, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Replay {
    code: Vec<Coded>,
    /// Places that are zero for good, and must be so before the program is run.
    pub zeros: Vec<u32>,
}

/// A step: its operation, and the places of its output, its start, its operands and its scale.
#[derive(Clone, Copy, Debug)]
struct Coded {
    opcode: u8,
    places: [u32; 9],
}

/// A recorded step with its operands.
struct Step {
    kind: Kind,
    out: u32,
    start: u32,
    scale: u32,
    products: Vec<[u32; 2]>,
    plus: Vec<u32>,
    minus: Vec<u32>,
}

/// A memory that is addressed by 32 bits, of which only as many count as it needs.
pub(crate) trait Memory<S: Level> {
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
    /// The program with its numbers in other places, `moved`. Those of `zeros`, and what comes of them alone,
    /// are zero for good: they are neither looked at nor written. `zero` is the recorded place of a zero.
    pub(crate) fn new(
        program: &Program,
        moved: impl Fn(u32) -> u32,
        zeros: impl IntoIterator<Item = u32>,
        zero: u32,
    ) -> Self {
        let mut steps = Vec::new();
        let mut known = Zeros { places: zeros.into_iter().chain([zero]).collect(), written: HashSet::new() };
        program.each(|step, operands| steps.extend(known.fold(Step::new(step, operands), zero)));
        steps.iter_mut().for_each(|step| step.places_mut().for_each(|place| *place = moved(*place)));
        let ordered: Vec<Ordered> = steps.iter().map(Step::ordered).collect();
        let mut replay =
            Replay { zeros: known.places.into_iter().map(&moved).collect(), ..Replay::default() };
        order(&ordered).into_iter().for_each(|k| replay.push(&steps[k as usize]));
        replay
    }

    fn push(&mut self, step: &Step) {
        let (mut products, mut plus, mut minus) = (&step.products[..], &step.plus[..], &step.minus[..]);
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
            let shape =
                (own_products.len() * (MOST[1] + 1) + own_plus.len()) * (MOST[2] + 1) + own_minus.len();
            let operands = own_products.iter().flatten().chain(own_plus).chain(own_minus).copied();
            let all = [step.out, start.unwrap_or(step.start)].into_iter().chain(operands).chain([step.scale]);
            let mut places = [0; 9];
            places.iter_mut().zip(all).for_each(|(place, own)| *place = own);
            self.code.push(Coded { opcode: (form as usize * SHAPES + shape) as u8, places });
            if last {
                return;
            }
            start = Some(step.out);
        }
    }

    /// Runs all steps.
    ///
    /// A function of its own: inlined without optimisation, the copies of the interpreter would need more
    /// stack than a thread has.
    pub(crate) fn run<S: Level, M: Memory<S> + ?Sized>(&self, simd: S, memory: &mut M) {
        simd.vectorize(Replaying(self, memory, PhantomData::<S>));
    }
}

/// The places of which it is known that they hold zeros, and those that have been written.
struct Zeros {
    places: HashSet<u32>,
    written: HashSet<u32>,
}

impl Zeros {
    /// The step without its zeros; none if it would write a zero where one is.
    fn fold(&mut self, mut step: Step, zero: u32) -> Option<Step> {
        let is_zero = |place: &u32| self.places.contains(place);
        step.products.retain(|[a, b]| !is_zero(a) && !is_zero(b));
        step.plus.retain(|place| !is_zero(place));
        step.minus.retain(|place| !is_zero(place));
        if is_zero(&step.start) {
            let others = if step.kind == Kind::Negated { &mut step.minus } else { &mut step.plus };
            step.start = others.pop().unwrap_or(zero);
        }
        let vanishes =
            step.start == zero && step.products.is_empty() && step.plus.is_empty() && step.minus.is_empty();
        if vanishes && step.kind != Kind::Pivot {
            self.places.insert(step.out);
            return self.written.contains(&step.out).then_some(step);
        }
        self.places.remove(&step.out);
        self.written.insert(step.out);
        Some(step)
    }
}

impl Step {
    fn new(
        &Recorded { kind, out, start, scale, .. }: &Recorded,
        Operands { products, plus, minus }: Operands<'_>,
    ) -> Self {
        Step {
            kind,
            out,
            start,
            scale,
            products: products.to_vec(),
            plus: plus.to_vec(),
            minus: minus.to_vec(),
        }
    }

    fn places_mut(&mut self) -> impl Iterator<Item = &mut u32> {
        let own = [&mut self.out, &mut self.start, &mut self.scale].into_iter();
        own.chain(self.products.iter_mut().flatten()).chain(&mut self.plus).chain(&mut self.minus)
    }

    fn ordered(&self) -> Ordered {
        let scale = (self.kind == Kind::Scaled).then_some(self.scale);
        let terms = self.plus.iter().chain(&self.minus).copied();
        Ordered {
            shape: Shape {
                kind: self.kind,
                products: self.products.len(),
                plus: self.plus.len(),
                minus: self.minus.len(),
            },
            out: self.out,
            reads: self
                .products
                .iter()
                .flatten()
                .copied()
                .chain(terms)
                .chain([self.start])
                .chain(scale)
                .collect(),
        }
    }
}

/// A replay on its way into the function that has the machine's instructions.
struct Replaying<'r, S, M: ?Sized>(&'r Replay, &'r mut M, PhantomData<S>);

impl<S: Level, M: Memory<S> + ?Sized> NullaryFnOnce for Replaying<'_, S, M> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Replaying(replay, memory, _) = self;
        for step in &replay.code {
            by_opcode(step, memory);
        }
    }
}

macro_rules! copies {
    ($step:expr, $memory:expr; $($opcode:literal)*) => {
        // Six bits: the table of copies has a place for each number of them, so that none has to be checked.
        match $step.opcode & 63 {
            $($opcode => compute(const { form($opcode) }, const { shape($opcode) }, &$step.places, $memory),)*
            59..=63 => compute(const { form(59) }, const { shape(59) }, &$step.places, $memory),
            _ => {}
        }
    };
}

#[rustfmt::skip]
#[inline(always)]
fn by_opcode<S: Level, M: Memory<S> + ?Sized>(step: &Coded, memory: &mut M) {
    // Without optimisation the copies would need more than half the stack of a thread.
    if cfg!(debug_assertions) {
        return compute(form(step.opcode.into()), shape(step.opcode.into()), &step.places, memory);
    }
    copies!(step, memory;
        0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29
        30 31 32 33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58)
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

/// One step.
#[inline(always)]
fn compute<S: Level, M: Memory<S> + ?Sized>(
    form: Form,
    [products, plus, minus]: [usize; 3],
    places: &[u32; 9],
    memory: &mut M,
) {
    let start = memory.get(places[1]);
    let mut x = if matches!(form, Form::Negated) { -start } else { start };
    let added = matches!(form, Form::Negated | Form::Added);
    if products > 0 {
        let (a, b) = (memory.get(places[2]), memory.get(places[3]));
        x = if added { a.mul_add(b, x) } else { a.negative_mul_add(b, x) };
    }
    if products > 1 {
        let (a, b) = (memory.get(places[4]), memory.get(places[5]));
        x = if added { a.mul_add(b, x) } else { a.negative_mul_add(b, x) };
    }
    if plus > 0 {
        x = x + memory.get(places[2 + 2 * products]);
    }
    if minus > 0 {
        x = x - memory.get(places[2 + 2 * products + plus]);
    }
    if matches!(form, Form::Scaled) {
        x = x * memory.get(places[2 + 2 * products + plus + minus]);
    }
    memory.set(places[0], if matches!(form, Form::Pivot) { x.reciprocal() } else { x });
}
