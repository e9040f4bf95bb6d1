//! Where a derivative of a law jumps.

/// Where a derivative of a law jumps. At the break itself the law has the derivatives of its right side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Break {
    /// The argument at which the law jumps.
    pub x: f64,
    /// The lowest derivative that jumps: 0 the value itself, 1 the slope, 2 the second, 3 the third. A law
    /// with breaks of order 2 is C¹.
    pub order: usize,
}
