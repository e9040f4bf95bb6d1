//! Equations that depend on one another.

use serde::{Deserialize, Serialize};

/// The class of a dependency.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Class {
    /// One equation repeats others, at nearby poses too, and all can be satisfied. This is
    /// harmless.
    Redundant,
    /// The equations cannot be satisfied together.
    Contradictory {
        /// The level on which they contradict each other.
        level: Level,
        /// Σ coefficient · equation, which should be zero and is not. It can be zero for some
        /// equations of a constraint with a gap: those across the gap. \[unit of the dependent row;
        /// /s; /s²\]
        residual: f64,
    },
    /// The equations depend on one another at this pose, but not at nearby poses.
    OnlyHere,
}

/// The level of a contradiction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Level {
    /// C(q, t) = 0 has no solution.
    Position,
    /// C_q q̇ = −C_t has no solution.
    Velocity,
    /// C_q q̈ = Q_d has no solution.
    Acceleration,
}

/// One equation of a dependency.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Term {
    /// The constraint.
    pub constraint: String,
    /// The equation, such as `B.x`.
    pub equation: String,
    /// The row of the equation in the system.
    pub row: usize,
    /// The coefficient. \[unit of the dependent row / unit of this row\]
    pub coefficient: f64,
}

/// A minimal set of equations with Σ coefficient · ∂C_i/∂q = 0. Without any one of them the others
/// are independent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Dependency {
    /// The class.
    pub class: Class,
    /// The terms. The first one has the coefficient 1; it is the redundant equation. Norms of Euler
    /// parameters are omitted, because no user wrote them.
    pub terms: Vec<Term>,
}

impl Dependency {
    /// Returns the names of the constraints in the dependency, each once. The first is that of the
    /// redundant equation.
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
