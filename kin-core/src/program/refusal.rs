//! Says why a mechanism has no program.

use std::fmt;

/// An obstacle that keeps Kin from making a program, or from running it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Obstacle {
    /// A constraint has no formula.
    NoFormula,
    /// A formula contains something that Kin cannot rebuild.
    NoEquation,
    /// A function that only rustc can read depends on coordinates.
    ForeignFunction,
    /// A body belongs to another mechanism.
    OtherMechanism,
    /// The mechanism has more equations than coordinates.
    Redundant,
    /// The equations are singular at the guess.
    SingularGuess,
    /// The first position of a motion is singular.
    SingularStart,
    /// Too many coordinates depend on one another.
    Tangled,
    /// Friction depends on the force that causes it.
    Friction,
    /// The force of a load is a closure.
    Closure,
    /// A load acts along a measure of a joint.
    LoadOnMeasure,
    /// The machine has no registers for several times at once.
    NoLanes,
    /// The options disable prediction.
    NoPrediction,
    /// The stop rule is the residual alone.
    ResidualStop,
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Obstacle::NoFormula => {
                "Kin does not know the equation as a formula: Kin differentiates the constraint by dual numbers, or the constraint is hand-written"
            }
            Obstacle::NoEquation => "Kin does not know the equation as a formula",
            Obstacle::ForeignFunction => {
                "a function that only rustc can read depends on coordinates"
            }
            Obstacle::OtherMechanism => "one of the bodies belongs to another mechanism",
            Obstacle::Redundant => "the mechanism has more equations than coordinates",
            Obstacle::SingularGuess => "the equations are singular at the guess",
            Obstacle::SingularStart => "the first position is singular",
            Obstacle::Tangled => "too many coordinates depend on one another",
            Obstacle::Friction => {
                "Kin solves friction and the force that causes the friction together at each time"
            }
            Obstacle::Closure => {
                "the force is a closure, which Kin cannot read. Write the force as a function"
            }
            Obstacle::LoadOnMeasure => {
                "the load acts along a measure of a joint, which Kin evaluates at one time after the other"
            }
            Obstacle::NoLanes => {
                "this machine has no registers (AVX-512, AVX2 with FMA, Neon) for several times at once"
            }
            Obstacle::NoPrediction => "compiled runs always predict the next position",
            Obstacle::ResidualStop => {
                "only the step-by-step solver can stop by the residual alone"
            }
        })
    }
}

/// The reason why there is no program.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Refusal {
    /// The constraint; empty if the mechanism itself is the reason.
    pub constraint: String,
    /// The obstacle.
    pub reason: Obstacle,
}

impl Refusal {
    /// Creates the refusal of the whole mechanism.
    pub(crate) fn whole(reason: Obstacle) -> Self {
        Refusal { constraint: String::new(), reason }
    }

    /// Creates the refusal of one constraint or load.
    pub(crate) fn one(name: &str, reason: Obstacle) -> Self {
        Refusal { constraint: name.to_string(), reason }
    }
}

impl fmt::Display for Refusal {
    /// Writes "`x` cannot be compiled: …".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.constraint.as_str() {
            "" => write!(f, "Kin cannot compile the mechanism: {}", self.reason),
            name => write!(f, "Kin cannot compile `{name}`: {}", self.reason),
        }
    }
}
