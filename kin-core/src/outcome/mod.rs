//! Describes what comes out of a computation: motions, verdicts of a diagnosis, and errors.
//!
//! The types are data with their texts. The modules above compute them.

pub(crate) mod culprit;
mod dimension_error;
pub mod error;
pub(crate) mod growth;
pub(crate) mod jammed;
pub(crate) mod mismatch;
pub mod motion;
pub(crate) mod named_value;
pub(crate) mod no_derivative;
pub(crate) mod not_unique;
pub(crate) mod similar;
pub mod verdict;
pub(crate) mod words;

pub use dimension_error::DimensionError;
