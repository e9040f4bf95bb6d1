//! Stores the result of a single position.

/// The report of Newton's iteration at one time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The number of Newton steps, including those of rescued attempts.
    pub iterations: usize,
    /// The largest residual max |C_i| at the solution, in the unit of its row.
    pub residual: f64,
    /// The name of the equation with the largest residual, such as `A.x`; empty for a mechanism
    /// without coordinates.
    pub worst: String,
    /// The smallest pivot of C_q, relative to its row. \[-\] The pivot is close to zero near a
    /// singular position, and can be small at other positions too.
    ///
    /// For the compiled program the value is the smallest pivot at the position of compilation,
    /// times the smallest ratio of a pivot to its value at the position of compilation.
    pub smallest_pivot: f64,
    /// True if the program of [`crate::System::compile`] found the position, false if the
    /// step-by-step solver did.
    pub compiled: bool,
}

/// The position, velocity and acceleration at one time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Solution {
    /// The time t. \[s\]
    pub t: f64,
    /// The position q, with C(q, t) = 0. \[m, rad\]
    pub q: Vec<f64>,
    /// The velocity q̇, with C_q q̇ = −C_t. \[m/s, rad/s\]
    pub qd: Vec<f64>,
    /// The acceleration q̈, with C_q q̈ = Q_d. \[m/s², rad/s²\]
    pub qdd: Vec<f64>,
    /// The report of Newton's iteration.
    pub report: Report,
}
