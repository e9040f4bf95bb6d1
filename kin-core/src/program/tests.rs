//! The passes against what a system itself evaluates, on the mechanisms of the gallery.

mod at;
pub(crate) mod functions;
pub(crate) mod models;
pub(crate) mod reduced;
mod replay;
mod terms;
mod transposed;
