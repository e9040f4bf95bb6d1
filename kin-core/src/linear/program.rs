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
        let count = |list: &[u32]| list.len() as u32;
        self.steps.push(Step { kind, out, start, scale, products: products.len() as u32, plus: count(plus), minus: count(minus) });
        self.products.extend_from_slice(products);
        self.terms.extend_from_slice(plus);
        self.terms.extend_from_slice(minus);
    }

    /// Runs all steps.
    pub(super) fn run(&self, memory: &mut [f64]) {
        let (mut products, mut terms) = (&self.products[..], &self.terms[..]);
        for step in &self.steps {
            let x = step.sum(memory, &mut products, &mut terms);
            let scale = if step.kind == Kind::Scaled { memory[step.scale as usize] } else { 1.0 };
            memory[step.out as usize] = if step.kind == Kind::Scaled { x * scale } else { x };
        }
    }

    /// Runs all steps and watches pivots and multipliers.
    pub(super) fn run_watched(&self, memory: &mut [f64], watch: &mut Watch) {
        let (mut products, mut terms) = (&self.products[..], &self.terms[..]);
        let (mut units, mut weights) = (watch.units.iter(), watch.weights.iter());
        let (mut smallest, mut multiplier, mut cell) = (f64::INFINITY, 0.0_f64, 0.0_f64);
        let mut weighted = |x: f64| x.abs() * weights.next().copied().unwrap_or(1.0);
        for step in &self.steps {
            let mut x = step.sum(memory, &mut products, &mut terms);
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

impl Step {
    #[inline(always)]
    fn sum(&self, memory: &[f64], products: &mut &[[u32; 2]], terms: &mut &[u32]) -> f64 {
        let mut sum = 0.0;
        for &[a, b] in take(products, self.products) {
            sum += memory[a as usize] * memory[b as usize];
        }
        let start = memory[self.start as usize];
        let mut x = if self.kind == Kind::Negated { sum - start } else { start - sum };
        for &k in take(terms, self.plus) {
            x += memory[k as usize];
        }
        for &k in take(terms, self.minus) {
            x -= memory[k as usize];
        }
        x
    }
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
