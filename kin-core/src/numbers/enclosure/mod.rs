//! Computes rigorous bounds by intervals that are rounded outwards, and by Taylor series of
//! intervals, for every function of the list.

pub(crate) mod elementary;
mod functions;
pub(crate) mod interval;
pub(crate) mod pieces;
pub(crate) mod series;

pub(crate) use interval::{Interval, ONE};
pub(crate) use pieces::{piecewise, repeated};
pub use series::Series;

#[cfg(test)]
mod tests {
    mod accuracy;
    mod by_name;
    mod edges;
}
