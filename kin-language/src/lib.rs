//! The language of constraints. `parse` reads the signature of an ordinary Rust function by name;
//! `lower` reads its body by abstract interpretation into the scalar graph of `kin-graph`. Both
//! collect mistakes and report each at the user's token.
//!
//! The folders of `lower` are rooms. A room imports only from rooms above it in this list, and
//! calls only methods that those rooms define:
//!
//! * `scope`: names, the values behind them, the log of their changes, and the frames that code can
//!   leave. A value is any type `V` here.
//! * `opaque`: expressions that only rustc understands, as templates of emitted code, and the
//!   source of each number of an equation.
//! * `values`: the typed values of expressions, and functions of values over the graph: coercion,
//!   operators, the joining of branches.
//! * `methods`: what methods and constructors compute from values.
//! * `walk`: the walk over the body. It alone evaluates expressions and applies functions, and its
//!   files call one another. `walk/table.rs` lists all methods: receivers, names, number of
//!   arguments, rule.
//!
//! `lower/mod.rs` begins the walk and returns its result. `lower/alone.rs` and `lower/rows.rs` use
//! that result. All rooms use the modules beside `lower`. `tests/house` checks the order of the
//! rooms, and how many files lead to one another.
#![forbid(unsafe_code)]

pub mod constants;
pub mod error;
pub mod formula;
pub mod limits;
pub mod lower;
pub mod parse;
pub mod vocabulary;
