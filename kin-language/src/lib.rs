//! The language of constraints: an ordinary Rust function is read by `parse` (its signature, by
//! name) and `lower` (its body, by abstract interpretation) into the scalar graph of `kin-graph`.
//! Mistakes are collected and stand on the user's own tokens.
#![forbid(unsafe_code)]

pub mod constants;
pub mod error;
pub mod formula;
pub mod limits;
pub mod lower;
pub mod parse;
pub mod vocabulary;
