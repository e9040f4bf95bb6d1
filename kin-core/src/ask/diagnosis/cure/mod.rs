//! Finds and tests changes after which a mechanism can be driven. The report contains only tested
//! changes.

pub(crate) mod change;
pub(crate) mod dimension;
mod fit;
mod freed;
pub(crate) mod lengths;
pub(crate) mod slips;
pub(crate) mod trial;
