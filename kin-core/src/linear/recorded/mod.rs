//! Records a sparse elimination once, in a cheap order, and replays it as straight runs of a few
//! operations.

mod active;
mod cells;
mod code;
mod order;
pub(crate) mod orientation;
pub(crate) mod program;
pub(crate) mod record;
mod solving;
