//! Represents equations as data: a hash-consed scalar graph over one list of functions, with exact
//! simplification, derivatives, and a schedule for code with few operations.
//!
//! The modules, each built on the modules before it: `functions` → `graph` → `differentiate` →
//! `schedule`. The module `text` reads and prints expressions. This crate knows neither the
//! language of an equation nor the solver.
#![forbid(unsafe_code)]

pub mod differentiate;
mod evaluate;
mod formula;
pub mod functions;
pub mod graph;
mod number;
pub mod rules;
pub mod schedule;
#[cfg(test)]
mod testing;
pub mod text;

pub use evaluate::{Results, Source, evaluate, evaluate_all, evaluate_along, evaluate_beyond};
pub use formula::{Expression, Formula};
pub use functions::{Function, Function2};
pub use graph::{
    Column, Comparison, Decimal, Depends, Direction, Graph, Input, Leaf, LeafNumber, LeafUse, Node,
    Op, Part, is_power_of_two,
};
pub use number::{Condition, Number, Possibly};
pub use text::Unreadable;
