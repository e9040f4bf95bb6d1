//! What to change so that a mechanism can be driven: cures are found, tried, and only then told.

pub(crate) mod change;
pub(crate) mod dimension;
mod fit;
mod freed;
pub(crate) mod lengths;
pub(crate) mod slips;
pub(crate) mod trial;
