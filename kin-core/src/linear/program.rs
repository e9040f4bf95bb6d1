//! The flat program of a recorded elimination, and its replay: no search, no allocation, one memory for everything.
//!
//! Each step writes one number that is a sum of products of numbers already there. The same interpreter makes the factors and solves with
//! them, and it could do so for several mechanisms at once, if the memory held lanes.

/// What a step does with `start − Σ products + Σ plus − Σ minus`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// Writes it.
    Plain,
    /// Writes Σ products − start + Σ plus − Σ minus instead.
    Negated,
    /// Writes it times `scale`; while factoring it is a multiplier, which must not grow.
    Scaled,
    /// Writes one over it: it is a pivot, which must not vanish.
    Pivot,
}

/// One number to be computed; its operands are the next ones of the program's lists.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub kind: Kind,
    pub out: u32,
    pub start: u32,
    pub scale: u32,
    shape: u32,
    products: u32,
    plus: u32,
    minus: u32,
}

/// Steps in the order in which they run.
#[derive(Clone, Debug, Default)]
pub(super) struct Program {
    pub steps: Vec<Step>,
    products: Vec<[u32; 2]>,
    terms: Vec<u32>,
}

/// What a replay is watched by, and what was seen.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    /// What makes each pivot that is no constant a share of its row and column.
    pub units: Vec<f64>,
    /// What makes each other number that is computed one of order 1.
    pub weights: Vec<f64>,
    /// The smallest share of a pivot.
    pub smallest: f64,
    /// The largest multiplier, and the largest other cell that was computed.
    pub multiplier: f64,
    pub cell: f64,
}

impl Program {
    /// Appends a step.
    pub(super) fn push(&mut self, kind: Kind, [out, start, scale]: [u32; 3], products: &[[u32; 2]], plus: &[u32], minus: &[u32]) {
        let shape = shape(products.len(), plus.len(), minus.len());
        let [n_products, n_plus, n_minus] = [products.len(), plus.len(), minus.len()].map(|n| n as u32);
        self.steps.push(Step { kind, out, start, scale, shape, products: n_products, plus: n_plus, minus: n_minus });
        self.products.extend_from_slice(products);
        self.terms.extend_from_slice(plus);
        self.terms.extend_from_slice(minus);
    }

    fn operands(&self) -> Operands<'_> {
        Operands { products: &self.products, terms: &self.terms }
    }

    /// Runs all steps.
    pub(super) fn run(&self, memory: &mut [f64]) {
        let operands = &mut self.operands();
        for step in &self.steps {
            let x = step.sum(memory, operands);
            memory[step.out as usize] = if step.kind == Kind::Scaled { x * memory[step.scale as usize] } else { x };
        }
    }

    /// Runs all steps and watches pivots and multipliers.
    pub(super) fn run_watched(&self, memory: &mut [f64], watch: &mut Watch) {
        (watch.smallest, watch.multiplier, watch.cell) = (f64::INFINITY, 0.0, 0.0);
        if self.steps.is_empty() {
            return;
        }
        let operands = &mut self.operands();
        let (mut units, mut weights) = (watch.units.iter(), watch.weights.iter());
        let (mut smallest, mut multiplier, mut cell) = (f64::INFINITY, 0.0_f64, 0.0_f64);
        let mut weighted = |x: f64| x.abs() * weights.next().copied().unwrap_or(1.0);
        for step in &self.steps {
            let mut x = step.sum(memory, operands);
            match step.kind {
                Kind::Plain | Kind::Negated => cell = above(cell, weighted(x)),
                Kind::Scaled => {
                    x *= memory[step.scale as usize];
                    multiplier = above(multiplier, weighted(x));
                }
                Kind::Pivot => {
                    smallest = below(smallest, x.abs() * units.next().copied().unwrap_or(1.0));
                    x = x.recip();
                }
            }
            memory[step.out as usize] = x;
        }
        (watch.smallest, watch.multiplier, watch.cell) = (smallest, multiplier, cell);
    }

    /// The transpose of a program that is linear in its last factors and its starts: what was `out` comes in, what was read comes out,
    /// in `adjoint`; `memory` gives the other factors.
    pub(super) fn run_transposed(&self, memory: &[f64], adjoint: &mut [f64]) {
        let (mut products, mut terms) = (&self.products[..], &self.terms[..]);
        for step in self.steps.iter().rev() {
            let minus = take_last(&mut terms, step.minus);
            let plus = take_last(&mut terms, step.plus);
            let scale = if step.kind == Kind::Scaled { memory[step.scale as usize] } else { 1.0 };
            let share = std::mem::take(&mut adjoint[step.out as usize]) * scale;
            let sign = if step.kind == Kind::Negated { -1.0 } else { 1.0 };
            adjoint[step.start as usize] += sign * share;
            take_last(&mut products, step.products).iter().for_each(|&[a, b]| adjoint[b as usize] -= sign * share * memory[a as usize]);
            plus.iter().for_each(|&k| adjoint[k as usize] += share);
            minus.iter().for_each(|&k| adjoint[k as usize] -= share);
        }
    }

    /// How many numbers it computes and how many operands it reads.
    #[cfg(test)]
    pub(super) fn size(&self) -> (usize, usize) {
        (self.steps.len(), 2 * self.products.len() + self.terms.len())
    }
}

/// How a step's operands are counted: up to 3 products, 2 numbers added and 2 subtracted have a loop-free copy of the interpreter each.
const MANY: u32 = 36;

fn shape(products: usize, plus: usize, minus: usize) -> u32 {
    if products < 4 && plus < 3 && minus < 3 { (products + 4 * plus + 12 * minus) as u32 } else { MANY }
}

/// Runs the copy of the interpreter for a shape.
macro_rules! by_shape {
    ($step:expr, $memory:expr, $operands:expr; $($shape:literal)*) => {
        match $step.shape {
            $($shape => $step.fixed::<{ $shape % 4 }, { $shape / 4 % 3 }, { $shape / 12 }>($memory, $operands),)*
            _ => $step.any($memory, $operands),
        }
    };
}

impl Step {
    #[inline(always)]
    fn sum(&self, memory: &[f64], operands: &mut Operands<'_>) -> f64 {
        by_shape!(self, memory, operands; 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32 33 34 35)
    }

    /// The sum of a step with that many operands.
    #[inline(always)]
    fn fixed<const PRODUCTS: usize, const PLUS: usize, const MINUS: usize>(&self, memory: &[f64], operands: &mut Operands<'_>) -> f64 {
        let products = operands.products.split_first_chunk::<PRODUCTS>();
        let plus = operands.terms.split_first_chunk::<PLUS>();
        let Some(((products, products_left), (plus, terms))) = products.zip(plus) else { return f64::NAN };
        let Some((minus, terms)) = terms.split_first_chunk::<MINUS>() else { return f64::NAN };
        *operands = Operands { products: products_left, terms };
        self.add_up(memory, products, plus, minus)
    }

    #[inline(never)]
    fn any(&self, memory: &[f64], operands: &mut Operands<'_>) -> f64 {
        let products = take(&mut operands.products, self.products);
        let (plus, minus) = (take(&mut operands.terms, self.plus), take(&mut operands.terms, self.minus));
        self.add_up(memory, products, plus, minus)
    }

    #[inline(always)]
    fn add_up(&self, memory: &[f64], products: &[[u32; 2]], plus: &[u32], minus: &[u32]) -> f64 {
        let mut sum = 0.0;
        for (k, &[a, b]) in products.iter().enumerate() {
            let product = memory[a as usize] * memory[b as usize];
            sum = if k == 0 { product } else { sum + product };
        }
        let start = memory[self.start as usize];
        let mut x = if products.is_empty() {
            if self.kind == Kind::Negated { -start } else { start }
        } else if self.kind == Kind::Negated {
            sum - start
        } else {
            start - sum
        };
        plus.iter().for_each(|&k| x += memory[k as usize]);
        minus.iter().for_each(|&k| x -= memory[k as usize]);
        x
    }
}

/// The operands of the steps to come.
struct Operands<'a> {
    products: &'a [[u32; 2]],
    terms: &'a [u32],
}

/// The next `n` of the list.
#[inline(always)]
fn take<'a, T>(list: &mut &'a [T], n: u32) -> &'a [T] {
    let (own, rest) = list.split_at(n as usize);
    *list = rest;
    own
}

/// The last `n` of the list.
fn take_last<'a, T>(list: &mut &'a [T], n: u32) -> &'a [T] {
    let (rest, own) = list.split_at(list.len() - n as usize);
    *list = rest;
    own
}

/// The larger one; NaN is larger than all.
fn above(known: f64, x: f64) -> f64 {
    if x <= known { known } else { x }
}

/// The smaller one; NaN is smaller than all.
fn below(known: f64, x: f64) -> f64 {
    if x >= known { known } else { x }
}
