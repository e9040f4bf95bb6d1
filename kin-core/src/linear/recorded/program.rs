//! Describes the program of a recorded elimination: the operands of each number, and the order of
//! computation.
//!
//! Each step writes one number that is a sum of products of existing numbers. The same program
//! computes the factors, solves with the factors, and, run backwards, solves with the transpose.
//! [`code`](super::code) is the form of the program that Kin replays.

use super::code::{Code, Shape};
use super::order::{Ordered, order};

/// The operations of a step on `start − Σ products + Σ plus − Σ minus`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    /// Writes the sum.
    Plain,
    /// Writes Σ products − start + Σ plus − Σ minus instead.
    Negated,
    /// Writes the sum times `scale`; during factoring the result is a multiplier, which must not
    /// grow.
    Scaled,
    /// Writes one divided by the sum; the sum is a pivot, which must not vanish.
    Pivot,
}

/// One number to be computed; its operands are the next ones in the program's lists.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    pub kind: Kind,
    /// The place of the result.
    pub out: u32,
    /// The place of the number with which the sum begins.
    pub start: u32,
    /// The place of the factor of a [`Kind::Scaled`] step; other kinds do not read it.
    pub scale: u32,
    /// How many products the step takes from the program's list.
    products: u32,
    /// How many added numbers the step takes from the program's list.
    plus: u32,
    /// How many subtracted numbers the step takes from the program's list.
    minus: u32,
}

/// The operands of one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Operands<'a> {
    /// The places of the two factors of each subtracted product.
    pub products: &'a [[u32; 2]],
    /// The places of the added numbers.
    pub plus: &'a [u32],
    /// The places of the subtracted numbers.
    pub minus: &'a [u32],
}

/// The steps in the order in which they were appended.
#[derive(Clone, Debug, Default)]
pub(crate) struct Program {
    steps: Vec<Step>,
    /// The factors of the products of all steps, step by step.
    products: Vec<[u32; 2]>,
    /// The added and then the subtracted numbers of each step, step by step.
    terms: Vec<u32>,
    /// The order of the steps in the code.
    order: Vec<u32>,
    /// The form that is replayed, written by [`Program::finish`].
    code: Code,
}

impl Program {
    /// Appends a step.
    pub(crate) fn push(
        &mut self,
        kind: Kind,
        [out, start, scale]: [u32; 3],
        products: &[[u32; 2]],
        plus: &[u32],
        minus: &[u32],
    ) {
        let [n_products, n_plus, n_minus] =
            [products.len(), plus.len(), minus.len()].map(|n| n as u32);
        self.steps.push(Step {
            kind,
            out,
            start,
            scale,
            products: n_products,
            plus: n_plus,
            minus: n_minus,
        });
        self.products.extend_from_slice(products);
        self.terms.extend_from_slice(plus);
        self.terms.extend_from_slice(minus);
    }

    /// Writes the code for a memory of this many numbers, after the last step.
    pub(crate) fn finish(&mut self, memory: usize) {
        let mut products = &self.products[..];
        let mut terms = &self.terms[..];
        let mut own = |step: &Step| Operands {
            products: take(&mut products, step.products),
            plus: take(&mut terms, step.plus),
            minus: take(&mut terms, step.minus),
        };
        let operands: Vec<Operands<'_>> = self.steps.iter().map(&mut own).collect();
        let ordered: Vec<Ordered> = self
            .steps
            .iter()
            .zip(&operands)
            .map(|(step, operands)| step.ordered(operands))
            .collect();
        let order = order(&ordered);
        let mut code = Code::new(memory);
        order.iter().for_each(|&k| code.push(&self.steps[k as usize], &operands[k as usize]));
        (self.code, self.order) = (code, order);
    }

    /// Returns the operation and the output of each step, in the order in which they were appended.
    pub(crate) fn written(&self) -> impl Iterator<Item = (Kind, u32)> {
        self.steps.iter().map(|step| (step.kind, step.out))
    }

    /// Changes the place of each number.
    pub(crate) fn rename(&mut self, places: &[u32]) {
        let steps = self
            .steps
            .iter_mut()
            .flat_map(|step| [&mut step.out, &mut step.start, &mut step.scale]);
        let operands = self.products.iter_mut().flatten().chain(&mut self.terms);
        steps.chain(operands).for_each(|place| *place = places[*place as usize]);
    }

    /// Returns the number of steps.
    pub(crate) fn len(&self) -> usize {
        self.steps.len()
    }

    /// Runs all steps.
    pub(crate) fn run(&self, memory: &mut [f64]) {
        self.code.run(memory);
    }

    /// Runs the transpose of a program that is linear in its last factors and its starts. In
    /// `adjoint` the outputs come in, and the inputs come out; `memory` contains the other factors.
    pub(crate) fn run_transposed(&self, memory: &[f64], adjoint: &mut [f64]) {
        let mut products = &self.products[..];
        let mut terms = &self.terms[..];
        for step in self.steps.iter().rev() {
            let minus = take_last(&mut terms, step.minus);
            let plus = take_last(&mut terms, step.plus);
            let scale = if step.kind == Kind::Scaled { memory[step.scale as usize] } else { 1.0 };
            let share = std::mem::take(&mut adjoint[step.out as usize]) * scale;
            let sign = if step.kind == Kind::Negated { -1.0 } else { 1.0 };
            adjoint[step.start as usize] += sign * share;
            take_last(&mut products, step.products)
                .iter()
                .for_each(|&[a, b]| adjoint[b as usize] -= sign * share * memory[a as usize]);
            plus.iter().for_each(|&k| adjoint[k as usize] += share);
            minus.iter().for_each(|&k| adjoint[k as usize] -= share);
        }
    }

    /// Returns the number of computed numbers and of their operands.
    #[cfg(test)]
    pub(crate) fn size(&self) -> (usize, usize) {
        (self.steps.len(), 2 * self.products.len() + self.terms.len())
    }
}

impl Step {
    /// Returns the operation of the step, with the number of its operands.
    pub(crate) fn shape(&self) -> Shape {
        let [products, plus, minus] = [self.products, self.plus, self.minus].map(|n| n as usize);
        Shape { kind: self.kind, products, plus, minus }
    }

    /// Returns the place that the step writes and those that it reads.
    fn ordered(&self, operands: &Operands<'_>) -> Ordered {
        let scale = (self.kind == Kind::Scaled).then_some(self.scale);
        let terms = operands.plus.iter().chain(operands.minus).copied();
        let reads = operands
            .products
            .iter()
            .flatten()
            .copied()
            .chain(terms)
            .chain([self.start])
            .chain(scale);
        Ordered { shape: self.shape(), out: self.out, reads: reads.collect() }
    }
}

/// Takes the next `n` elements of the list.
fn take<'a, T>(list: &mut &'a [T], n: u32) -> &'a [T] {
    let (own, rest) = list.split_at(n as usize);
    *list = rest;
    own
}

/// Takes the last `n` elements of the list.
fn take_last<'a, T>(list: &mut &'a [T], n: u32) -> &'a [T] {
    let (rest, own) = list.split_at(list.len() - n as usize);
    *list = rest;
    own
}
