//! The language of constraints. `parse` reads the signature of an ordinary Rust function by name;
//! `lower` reads its body by abstract interpretation into the scalar graph of `kin-graph`. Both
//! collect mistakes and report each at the user's token.
#![forbid(unsafe_code)]

pub mod constants;
pub mod error;
pub mod formula;
pub mod limits;
pub mod lower;
pub mod parse;
pub mod vocabulary;
