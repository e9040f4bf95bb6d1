//! Sparse elimination recorded once, in an order for little work, and replayed as straight runs of
//! a few operations.

mod active;
mod cells;
mod code;
mod order;
pub(crate) mod orientation;
pub(crate) mod program;
pub(crate) mod record;
mod solving;
