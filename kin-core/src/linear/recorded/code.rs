//! Implements the code of a program and its interpreter, without search or allocation and with one
//! memory.
//!
//! Steps of one shape follow one another in runs ([`order`](super::order) arranges the steps), and
//! the interpreter has a copy for each common shape. So the interpreter rarely decodes a step. A
//! memory of at most 256 numbers has addresses of one byte, which need no bounds check.

use super::program::{Kind, Operands, Step};

/// The largest memory with addresses of one byte; such a memory must have exactly this length.
pub(crate) const SMALL: usize = 256;

/// The number of short shapes of each kind of step: up to 3 products, 2 added and 2 subtracted
/// numbers, and up to 7 products alone.
const SHAPES: usize = 40;

/// The opcode of steps with more operands.
const LONG: u8 = u8::MAX;

/// Runs of steps with the places of their operands.
#[derive(Clone, Debug)]
pub(crate) enum Code {
    Small(Flat<u8>),
    Large(Flat<u32>),
}

impl Default for Code {
    fn default() -> Self {
        Code::new(0)
    }
}

impl Code {
    /// Creates code for a memory of this many numbers.
    pub(crate) fn new(memory: usize) -> Self {
        if memory <= SMALL { Code::Small(Flat::default()) } else { Code::Large(Flat::default()) }
    }

    /// Appends a step.
    pub(crate) fn push(&mut self, step: &Step, operands: &Operands<'_>) {
        match self {
            Code::Small(flat) => flat.push(step, operands),
            Code::Large(flat) => flat.push(step, operands),
        }
    }

    /// Runs all steps.
    pub(crate) fn run(&self, memory: &mut [f64]) {
        match self {
            Code::Small(flat) => {
                memory.first_chunk_mut().into_iter().for_each(|memory| flat.run(memory))
            }
            Code::Large(flat) => flat.run(memory),
        }
    }
}

/// The type of a place in a memory.
pub(crate) trait PlaceWidth: Copy + Default {
    type Memory: ?Sized;
    fn new(place: u32) -> Self;
    fn get(self, memory: &Self::Memory) -> f64;
    fn set(self, memory: &mut Self::Memory, x: f64);
}

impl PlaceWidth for u8 {
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

impl PlaceWidth for u32 {
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

/// Runs of steps of one shape, and the places of their operands one after the other.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flat<P> {
    runs: Vec<Run>,
    places: Vec<P>,
    /// The shape of the last step.
    last: Option<Shape>,
    long: Vec<Shape>,
}

/// Consecutive steps of one shape: their opcode, and the number of steps after the first one.
#[derive(Clone, Copy, Debug)]
struct Run {
    opcode: u8,
    more: u32,
}

/// The operation of a step, and the numbers of its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Shape {
    pub kind: Kind,
    pub products: usize,
    pub plus: usize,
    pub minus: usize,
}

impl Shape {
    /// Returns the number of places of a step: its output, its start, its operands, its scale.
    const fn length(self) -> usize {
        2 + 2 * self.products + self.plus + self.minus + matches!(self.kind, Kind::Scaled) as usize
    }

    /// Returns the opcode of the shape, if it is short.
    fn opcode(self) -> u8 {
        let Shape { kind, products, plus, minus } = self;
        let shape = match (products, plus, minus) {
            (0..4, 0..3, 0..3) => products + 4 * plus + 12 * minus,
            (4..8, 0, 0) => 32 + products,
            _ => return LONG,
        };
        (kind as usize * SHAPES + shape) as u8
    }

    /// Returns the shape of an opcode.
    const fn of(opcode: u8) -> Self {
        let shape = opcode as usize % SHAPES;
        let kind = match opcode as usize / SHAPES {
            0 => Kind::Plain,
            1 => Kind::Negated,
            2 => Kind::Scaled,
            _ => Kind::Pivot,
        };
        if shape >= 36 {
            return Shape { kind, products: shape - 32, plus: 0, minus: 0 };
        }
        Shape { kind, products: shape % 4, plus: shape / 4 % 3, minus: shape / 12 }
    }
}

/// Runs the copy of the interpreter for an opcode. Common shapes, which make up nearly all
/// programs, are inlined; rare ones are called. With all copies inlined LLVM took a third of the
/// time of this crate for one function.
macro_rules! by_opcode {
    ($run:expr, $shapes:expr, $places:expr, $memory:expr; common $($common:literal)*; rare $($rare:literal)*) => {
        match $run.opcode {
            $($common => short::<P, $common, { Shape::of($common).length() }>($run.more, $places, $memory),)*
            $($rare => rare::<P, $rare, { Shape::of($rare).length() }>($run.more, $places, $memory),)*
            160..=255 => long($shapes.next().map(|shape| (*shape, $run.more + 1)), $places, $memory),
        }
    };
}

impl<P: PlaceWidth> Flat<P> {
    fn push(&mut self, step: &Step, Operands { products, plus, minus }: &Operands<'_>) {
        let shape = step.shape();
        match self.runs.last_mut() {
            Some(run) if self.last == Some(shape) => run.more += 1,
            _ => {
                self.runs.push(Run { opcode: shape.opcode(), more: 0 });
                self.long.extend((shape.opcode() == LONG).then_some(shape));
            }
        }
        self.last = Some(shape);
        let scale = (step.kind == Kind::Scaled).then_some(step.scale);
        let all = [step.out, step.start].into_iter().chain(products.iter().flatten().copied());
        self.places.extend(
            all.chain(plus.iter().copied()).chain(minus.iter().copied()).chain(scale).map(P::new),
        );
    }

    #[rustfmt::skip]
    fn run(&self, memory: &mut P::Memory) {
        let mut places = &self.places[..];
        let mut shapes = self.long.iter();
        for run in &self.runs {
            places = by_opcode!(run, shapes, places, memory;
                common 0 1 2 3 36 37 38 39 40 41 44 45 46 80 81 82 83 116 117 118 119 120 121 122 123;
                rare 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32 33 34 35 42 43 47 48 49 50 51 52 53
                54 55 56 57 58 59 60 61 62 63 64 65 66 67 68 69 70 71 72 73 74 75 76 77 78 79 84 85 86 87 88 89 90 91 92 93 94 95 96
                97 98 99 100 101 102 103 104 105 106 107 108 109 110 111 112 113 114 115 124 125 126 127 128 129 130 131 132 133 134
                135 136 137 138 139 140 141 142 143 144 145 146 147 148 149 150 151 152 153 154 155 156 157 158 159);
        }
    }
}

/// Runs steps whose shape is known at compile time, and returns the places of the following steps.
#[inline(always)]
fn short<'a, P: PlaceWidth, const OPCODE: u8, const LENGTH: usize>(
    mut more: u32,
    mut places: &'a [P],
    memory: &mut P::Memory,
) -> &'a [P] {
    // Runs are mostly short. A loop that counts its places first (`chunks_exact`) is unrolled,
    // which costs more than it saves.
    while let Some((own, rest)) = places.split_first_chunk::<LENGTH>() {
        compute(const { Shape::of(OPCODE) }, own, memory);
        places = rest;
        if more == 0 {
            break;
        }
        more -= 1;
    }
    places
}

#[inline(never)]
fn rare<'a, P: PlaceWidth, const OPCODE: u8, const LENGTH: usize>(
    more: u32,
    places: &'a [P],
    memory: &mut P::Memory,
) -> &'a [P] {
    short::<P, OPCODE, LENGTH>(more, places, memory)
}

#[inline(never)]
fn long<'a, P: PlaceWidth>(
    run: Option<(Shape, u32)>,
    places: &'a [P],
    memory: &mut P::Memory,
) -> &'a [P] {
    let Some((shape, steps)) = run else { return places };
    let (own, rest) = places.split_at(shape.length() * steps as usize);
    own.chunks_exact(shape.length()).for_each(|own| compute(shape, own, memory));
    rest
}

/// Runs one step; `places` are its places.
#[inline(always)]
fn compute<P: PlaceWidth>(shape: Shape, places: &[P], memory: &mut P::Memory) {
    let Shape { kind, products, plus, minus } = shape;
    let (factors, terms) = places[2..].split_at(2 * products);
    let start = places[1].get(memory);
    // Two sums in parallel: with a single sum each product would wait for the one before.
    let mut sums = [if kind == Kind::Negated { -start } else { start }, 0.0];
    for (k, pair) in factors.chunks_exact(2).enumerate() {
        let a = pair[0].get(memory);
        let b = pair[1].get(memory);
        let turn = usize::from(products > 2 && k % 2 == 1);
        sums[turn] =
            if kind == Kind::Negated { sum(sums[turn], a, b) } else { sum(sums[turn], -a, b) };
    }
    let mut x = if products > 2 { sums[0] + sums[1] } else { sums[0] };
    terms[..plus].iter().for_each(|k| x += k.get(memory));
    terms[plus..plus + minus].iter().for_each(|k| x -= k.get(memory));
    if kind == Kind::Scaled {
        x *= terms[plus + minus].get(memory);
    }
    places[0].set(memory, if kind == Kind::Pivot { x.recip() } else { x });
}

/// Returns x + a b, rounded once if the target can.
#[inline(always)]
fn sum(x: f64, a: f64, b: f64) -> f64 {
    if cfg!(target_feature = "fma") { a.mul_add(b, x) } else { x + a * b }
}
