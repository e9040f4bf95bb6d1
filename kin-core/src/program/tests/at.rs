//! The inputs that a program is evaluated with, number by number.

use kin_graph::{Input, LeafUse, Source};

use crate::program::stages::{Program, law_at};

/// Coordinates of which only the torn ones are read, and what `verify` is given.
pub(in crate::program) struct At<'a> {
    pub t: f64,
    pub q: &'a [f64],
    pub given: &'a [f64],
    pub program: &'a Program,
}

impl Source<f64> for At<'_> {
    fn input(&self, input: Input) -> f64 {
        match input {
            Input::State(j, _) if self.program.torn.contains(&j) => self.q[j],
            Input::Column(j) => self.given[j],
            Input::Time => self.t,
            other => unreachable!("{other:?}"),
        }
    }

    fn law(&self, law: usize, x: f64, order: u8) -> f64 {
        law_at(&self.program.laws, law, x, order)
    }

    fn opaque(&self, _: usize, _: usize, _: Vec<f64>) -> f64 {
        unreachable!("foreign values are folded")
    }

    fn leaf(&self, _: LeafUse, _: Vec<f64>) -> f64 {
        unreachable!("formulas have no leaves")
    }
}
