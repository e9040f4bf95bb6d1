//! Changes after which a mechanism can be driven: they are found, tried, and only then told.

pub(crate) mod change;
pub(crate) mod dimension;
mod fit;
mod freed;
pub(crate) mod lengths;
pub(crate) mod slips;
pub(crate) mod trial;
