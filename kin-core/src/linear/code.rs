//! The code of a program and its interpreter: no search, no allocation, one memory for everything.
//!
//! One opcode a step says what the step does and how many operands it has; the interpreter has a loop-free copy for each of the common
//! ones. A memory of at most 256 numbers is addressed by bytes, which cannot leave it: there no access is checked.

use super::program::{Kind, Operands, Step};

/// Up to this many numbers a memory is addressed by bytes, and must have just this length.
pub(super) const SMALL: usize = 256;

/// Up to 3 products, 2 numbers added and 2 subtracted have opcodes of their own, 36 for each kind of step.
const SHAPES: usize = 36;

/// The opcode of steps with more operands.
const LONG: u8 = u8::MAX;

/// Opcodes with the places they work on.
#[derive(Clone, Debug)]
pub(super) enum Code {
    Small(Flat<u8>),
    Large(Flat<u32>),
}

/// What was seen of the numbers that were computed, each times its weight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// The smallest pivot, the largest multiplier, and the largest other number.
    pub smallest: f64,
    pub multiplier: f64,
    pub cell: f64,
}

impl Default for Seen {
    fn default() -> Self {
        Seen { smallest: f64::INFINITY, multiplier: 0.0, cell: 0.0 }
    }
}

impl Default for Code {
    fn default() -> Self {
        Code::new(0)
    }
}

impl Code {
    /// Code for a memory of that many numbers.
    pub(super) fn new(memory: usize) -> Self {
        if memory <= SMALL { Code::Small(Flat::default()) } else { Code::Large(Flat::default()) }
    }

    /// Appends a step.
    pub(super) fn push(&mut self, step: &Step, operands: Operands<'_>) {
        match self {
            Code::Small(flat) => flat.push(step, operands),
            Code::Large(flat) => flat.push(step, operands),
        }
    }

    /// Runs all steps.
    pub(super) fn run(&self, memory: &mut [f64]) {
        match self {
            Code::Small(flat) => memory.first_chunk_mut().map(|memory| flat.run(memory)),
            Code::Large(flat) => Some(flat.run(memory)),
        };
    }

    /// Runs all steps, watched.
    pub(super) fn run_watched(&self, memory: &mut [f64], weights: &[f64]) -> Seen {
        let seen = match self {
            Code::Small(flat) => memory.first_chunk_mut().map(|memory| flat.run_watched(memory, weights)),
            Code::Large(flat) => Some(flat.run_watched(memory, weights)),
        };
        seen.unwrap_or_default()
    }
}

/// The place of a number in a memory of the right length.
pub(super) trait Place: Copy + Default {
    type Memory: ?Sized;
    fn new(place: u32) -> Self;
    fn get(self, memory: &Self::Memory) -> f64;
    fn set(self, memory: &mut Self::Memory, x: f64);
}

impl Place for u8 {
    type Memory = [f64; SMALL];

    fn new(place: u32) -> Self {
        place as u8
    }

    #[inline(always)]
    fn get(self, memory: &[f64; SMALL]) -> f64 {
        memory[self as usize]
    }

    #[inline(always)]
    fn set(self, memory: &mut [f64; SMALL], x: f64) {
        memory[self as usize] = x;
    }
}

impl Place for u32 {
    type Memory = [f64];

    fn new(place: u32) -> Self {
        place
    }

    #[inline(always)]
    fn get(self, memory: &[f64]) -> f64 {
        memory[self as usize]
    }

    #[inline(always)]
    fn set(self, memory: &mut [f64], x: f64) {
        memory[self as usize] = x;
    }
}

/// Opcodes, the places of their operands one after the other, and the counts of those that are long.
#[derive(Clone, Debug, Default)]
pub(super) struct Flat<P> {
    opcodes: Vec<u8>,
    places: Vec<P>,
    long: Vec<Long>,
}

/// A step with many operands.
#[derive(Clone, Copy, Debug)]
struct Long {
    kind: Kind,
    products: usize,
    plus: usize,
    minus: usize,
}

/// Runs the copy of the interpreter for an opcode.
macro_rules! by_opcode {
    ($opcode:expr, $long:expr, $places:expr, $memory:expr; $($code:literal)*) => {
        match $opcode {
            $($code => short::<P, $code, { length($code) }>($places, $memory),)*
            _ => long($long, $places, $memory),
        }
    };
}

impl<P: Place> Flat<P> {
    fn push(&mut self, step: &Step, Operands { products, plus, minus }: Operands<'_>) {
        let short = products.len() < 4 && plus.len() < 3 && minus.len() < 3;
        let shape = products.len() + 4 * plus.len() + 12 * minus.len();
        self.opcodes.push(if short { (step.kind as usize * SHAPES + shape) as u8 } else { LONG });
        if !short {
            self.long.push(Long { kind: step.kind, products: products.len(), plus: plus.len(), minus: minus.len() });
        }
        let scale = (step.kind == Kind::Scaled).then_some(step.scale);
        let all = [step.out, step.start].into_iter().chain(products.iter().flatten().copied());
        self.places.extend(all.chain(plus.iter().copied()).chain(minus.iter().copied()).chain(scale).map(P::new));
    }

    fn run(&self, memory: &mut P::Memory) {
        let (mut places, mut long) = (&self.places[..], self.long.iter());
        for &opcode in &self.opcodes {
            step(opcode, &mut places, &mut long, memory);
        }
    }

    fn run_watched(&self, memory: &mut P::Memory, weights: &[f64]) -> Seen {
        let (mut places, mut long) = (&self.places[..], self.long.iter());
        let mut seen = Seen::default();
        for (&opcode, weight) in self.opcodes.iter().zip(weights) {
            let (kind, x) = step(opcode, &mut places, &mut long, memory);
            let share = x.abs() * weight;
            match kind {
                Kind::Plain | Kind::Negated => seen.cell = above(seen.cell, share),
                Kind::Scaled => seen.multiplier = above(seen.multiplier, share),
                Kind::Pivot => seen.smallest = below(seen.smallest, share),
            }
        }
        seen
    }
}

/// One step: its kind, and the number that was computed, of a pivot before it is inverted.
#[rustfmt::skip]
#[inline(always)]
fn step<P: Place>(opcode: u8, places: &mut &[P], long_steps: &mut std::slice::Iter<'_, Long>, memory: &mut P::Memory) -> (Kind, f64) {
    by_opcode!(opcode, long_steps, places, memory;
        0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32 33 34 35
        36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60 61 62 63 64 65 66 67 68 69 70 71
        72 73 74 75 76 77 78 79 80 81 82 83 84 85 86 87 88 89 90 91 92 93 94 95 96 97 98 99 100 101 102 103 104 105 106 107
        108 109 110 111 112 113 114 115 116 117 118 119 120 121 122 123 124 125 126 127 128 129 130 131 132 133 134 135 136 137 138
        139 140 141 142 143)
}

/// Products, numbers added and numbers subtracted of an opcode.
const fn shape(opcode: usize) -> [usize; 3] {
    let shape = opcode % SHAPES;
    [shape % 4, shape / 4 % 3, shape / 12]
}

const fn kind(opcode: usize) -> Kind {
    match opcode / SHAPES {
        0 => Kind::Plain,
        1 => Kind::Negated,
        2 => Kind::Scaled,
        _ => Kind::Pivot,
    }
}

/// How many places an opcode has: where it writes, where it starts, its operands, its scale.
const fn length(opcode: usize) -> usize {
    let [products, plus, minus] = shape(opcode);
    2 + 2 * products + plus + minus + matches!(kind(opcode), Kind::Scaled) as usize
}

/// A step that is known when the interpreter is compiled.
#[inline(always)]
fn short<P: Place, const OPCODE: usize, const LENGTH: usize>(places: &mut &[P], memory: &mut P::Memory) -> (Kind, f64) {
    let Some((own, rest)) = places.split_first_chunk::<LENGTH>() else { return (Kind::Plain, f64::NAN) };
    *places = rest;
    let [products, plus, minus] = const { shape(OPCODE) };
    compute(const { kind(OPCODE) }, products, plus, minus, own, memory)
}

#[inline(never)]
fn long<P: Place>(steps: &mut std::slice::Iter<'_, Long>, places: &mut &[P], memory: &mut P::Memory) -> (Kind, f64) {
    let Some(&Long { kind, products, plus, minus }) = steps.next() else { return (Kind::Plain, f64::NAN) };
    let length = 2 + 2 * products + plus + minus + usize::from(kind == Kind::Scaled);
    let (own, rest) = places.split_at(length);
    *places = rest;
    compute(kind, products, plus, minus, own, memory)
}

/// The number of a step, and its kind: `places` are those of this step.
#[inline(always)]
fn compute<P: Place>(kind: Kind, products: usize, plus: usize, minus: usize, places: &[P], memory: &mut P::Memory) -> (Kind, f64) {
    let (factors, terms) = places[2..].split_at(2 * products);
    let start = places[1].get(memory);
    let mut x = if kind == Kind::Negated { -start } else { start };
    for pair in factors.chunks_exact(2) {
        let (a, b) = (pair[0].get(memory), pair[1].get(memory));
        x = if kind == Kind::Negated { sum(x, a, b) } else { sum(x, -a, b) };
    }
    terms[..plus].iter().for_each(|k| x += k.get(memory));
    terms[plus..plus + minus].iter().for_each(|k| x -= k.get(memory));
    if kind == Kind::Scaled {
        x *= terms[plus + minus].get(memory);
    }
    places[0].set(memory, if kind == Kind::Pivot { x.recip() } else { x });
    (kind, x)
}

/// x + a b, rounded once where the target can.
#[inline(always)]
fn sum(x: f64, a: f64, b: f64) -> f64 {
    if cfg!(target_feature = "fma") { a.mul_add(b, x) } else { x + a * b }
}

/// The larger one; NaN is larger than all.
fn above(known: f64, x: f64) -> f64 {
    if x <= known { known } else { x }
}

/// The smaller one; NaN is smaller than all.
fn below(known: f64, x: f64) -> f64 {
    if x >= known { known } else { x }
}
