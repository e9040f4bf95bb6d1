//! Describes equations that depend on one another.

use serde::{Deserialize, Serialize};

/// The class of a dependency.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Class {
    /// One equation repeats others, at nearby poses too, and all equations can be satisfied. A
    /// redundant dependency is harmless.
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
    /// The name of the constraint.
    pub constraint: String,
    /// The name of the equation, such as `B.x`.
    pub equation: String,
    /// The index of the equation among the rows of the system.
    pub row: usize,
    /// The coefficient of the equation in the dependency. \[unit of the dependent row / unit of
    /// this row\]
    pub coefficient: f64,
}

/// A minimal set of dependent equations: Σ coefficient · ∂C_i/∂q = 0.
///
/// If you remove any equation of the set, the other equations are independent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Dependency {
    /// The class of the dependency.
    pub class: Class,
    /// The equations with their coefficients. The first equation has the coefficient 1 and is the
    /// redundant equation. The list omits norms of Euler parameters, because no user wrote these
    /// equations.
    pub terms: Vec<Term>,
}

impl Dependency {
    /// Returns the names of the constraints in the dependency, each once.
    ///
    /// The first name is the constraint of the redundant equation.
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
