//! Describes the breaks of laws that a run has crossed.

/// An argument at which a derivative of a law jumps.
///
/// At the break the law has the derivatives of its right side. At the end of its range
/// ([`crate::law::LawRange`]) the law has the derivatives of its left side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Break {
    /// The argument at which the law jumps.
    pub x: f64,
    /// The order of the lowest derivative that jumps: 0 is the value, 1 the slope, 2 the second
    /// derivative, 3 the third derivative. A law whose breaks have order 2 is C¹.
    pub order: usize,
}

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
