//! Equations that depend on one another.

use serde::{Deserialize, Serialize};

/// Classes of dependencies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Class {
    /// One equation repeats others, at nearby poses too, and all can be met: harmless.
    Redundant,
    /// The equations cannot be met together.
    Contradictory {
        /// In positions, velocities or accelerations.
        level: Level,
        /// Σ coefficient · equation, which should be zero and cannot be. Of several equations of a
        /// constraint with a gap it can be zero for some: those across the gap.   \[unit of the
        /// dependent row; /s; /s²\]
        residual: f64,
    },
    /// The equations depend on one another at this pose, not at nearby ones.
    OnlyHere,
}

/// Where a contradiction shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Level {
    /// C(q, t) = 0 has no solution there.
    Position,
    /// C_q q̇ = −C_t has none.
    Velocity,
    /// C_q q̈ = Q_d has none.
    Acceleration,
}

/// One equation in a dependency.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Term {
    /// The constraint.
    pub constraint: String,
    /// The equation, such as `B.x`.
    pub equation: String,
    /// Its number in the system.
    pub row: usize,
    /// Its coefficient.   \[unit of the dependent row / unit of this row\]
    pub coefficient: f64,
}

/// Σ coefficient · ∂C_i/∂q = 0 over a minimal set: without any of them the others are independent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Dependency {
    /// Its class.
    pub class: Class,
    /// The terms; the first one, with the coefficient 1, is the equation that is called
    /// superfluous. Those of the norms of Euler parameters, which nobody wrote, are left out.
    pub terms: Vec<Term>,
}

impl Dependency {
    /// Names of the constraints that take part, that of the superfluous equation first, each once.
    pub fn constraints(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for term in &self.terms {
            if !names.contains(&term.constraint.as_str()) {
                names.push(&term.constraint);
            }
        }
        names
    }
}
