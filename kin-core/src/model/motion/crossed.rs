//! Describes the breaks of laws that a run has crossed.

use crate::model::law::Break;

/// A break of a law that a run has crossed.
///
/// At the break a derivative of the motion jumps.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CrossedBreak {
    /// The last time before the break, and the first time at or after the break. \[s\]
    pub between: (f64, f64),
    /// The constraint that contains the law.
    pub constraint: String,
    /// The name of the law in the constraint.
    pub law: String,
    /// The argument of the law at the break, and the derivative that jumps.
    pub found: Break,
}
