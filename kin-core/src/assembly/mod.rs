//! From a poor guess to a pose: the nearest one, the least gap where there is none.

pub(crate) mod search;
pub(crate) mod squares;
pub(crate) mod turn;
