//! Breaks of laws that a run has crossed.

use crate::model::law::Break;

/// A break of a law that a run has crossed: there a derivative of the motion jumps.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CrossedBreak {
    /// The last time before it, and the first one after it or at it.   \[s\]
    pub between: (f64, f64),
    /// The constraint that asks the law.
    pub constraint: String,
    /// The law, by its name in the constraint.
    pub law: String,
    /// Where in the law it is, and which derivative jumps.
    pub found: Break,
}
