//! The last room: the walk over the body, expression by expression. Each of its files leads to all
//! others, because an expression may contain any other one. Nothing else may join this ring.

mod apply;
mod call;
mod control;
mod expression;
mod method;
mod operator;
mod pattern;
mod place;
mod rules;
mod statement;
mod table;
mod typed;

use std::ops::{Deref, DerefMut};

use super::values::Values;
use kin_graph::Graph;

/// The most nodes of a graph. With more, rustc needs seconds and a deep stack for the straight-line
/// code.
const MOST_NODES: usize = 4_000;
/// The greatest depth of calls among the functions of the body.
const MOST_CALLS: usize = 48;
/// The most expressions that the interpreter reads, counting each turn of a loop.
const MOST_EXPRESSIONS: usize = 1_000_000;
/// The most parts of an expression that only rustc understands.
const MOST_PARTS: usize = 250;

/// The interpreter: the values, and the position of the walk.
#[derive(Default)]
pub struct Reader {
    pub values: Values,
    /// Items of the body that emitted code repeats.
    pub repeated_items: Vec<syn::Item>,
    /// The declared type of the function's value.
    pub output: Option<syn::Type>,
    /// The number of the scope of the function's block.
    pub body_depth: usize,
    /// The present depth of calls among the functions of the body.
    calls: usize,
    expressions_read: usize,
}

impl Reader {
    pub fn new(graph: Graph) -> Self {
        Reader { values: Values::new(graph), ..Reader::default() }
    }
}

/// The walk calls all methods of its values. Values call no method of the walk.
impl Deref for Reader {
    type Target = Values;

    fn deref(&self) -> &Values {
        &self.values
    }
}

impl DerefMut for Reader {
    fn deref_mut(&mut self) -> &mut Values {
        &mut self.values
    }
}

impl AsMut<Values> for Reader {
    fn as_mut(&mut self) -> &mut Values {
        &mut self.values
    }
}
