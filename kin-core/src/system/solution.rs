//! The answer to one position that is asked for.

/// Report of Newton's iteration at one time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// Newton steps taken, those of rescued attempts included.
    pub iterations: usize,
    /// max |C_i| at the solution, in the unit of its row.
    pub residual: f64,
    /// Name of the equation that has it, such as `A.x`; empty for a mechanism without coordinates.
    pub worst: String,
    /// The smallest pivot of C_q, relative to its row: near zero close to a singular position, and
    /// small at some others. By a program it is that of the position where that was compiled, times
    /// the least share that a pivot has of what it was there.   \[-\]
    pub smallest_pivot: f64,
    /// True if the program of [`crate::System::compile`] has found it, false of plain steps.
    pub compiled: bool,
}

/// Position, velocity and acceleration at one time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Solution {
    /// Time t.   \[s\]
    pub t: f64,
    /// q, C(q, t) = 0.   \[m, rad\]
    pub q: Vec<f64>,
    /// q̇, C_q q̇ = −C_t.   \[m/s, rad/s\]
    pub qd: Vec<f64>,
    /// q̈, C_q q̈ = Q_d.   \[m/s², rad/s²\]
    pub qdd: Vec<f64>,
    /// Report of Newton's iteration.
    pub report: Report,
}
