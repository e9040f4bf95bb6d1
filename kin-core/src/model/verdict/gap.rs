//! Constraints that cannot be met together with all others.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

/// A constraint that cannot be met together with all others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Gap {
    /// The constraint.
    pub constraint: String,
    /// Its equations, as they are counted in the system.
    pub rows: Vec<usize>,
    /// Names of its equations, such as `B.x`.
    pub equations: Vec<String>,
    /// Residual of each equation where all other constraints are met and this one
    /// as nearly as was found.   \[unit of the row\]
    pub residual: Vec<f64>,
    /// For a driver of one coordinate: the coordinate, what is asked of it, and where it stands at
    /// the nearest.   \[m or rad\]
    pub asks: Option<Asks>,
    /// True if its equations depend on the others at nearby poses too: then they contradict one
    /// another. If not, something does not reach.
    pub lasting: bool,
    /// Number of starts from which a pose was looked for.
    pub starts: usize,
    /// The other drivers, and what those of one coordinate ask for.
    #[serde(default)]
    pub against: Vec<Against>,
    /// True if an equation of the mechanism can jump where coordinates move (`floor`, `%`,
    /// `signum`, an `if`), or may do so for all that is known of it: then the residual is the one
    /// that was found, and a smaller one, or none, may be near.
    #[serde(default)]
    pub can_jump: bool,
    /// The jumps that were found beside the pose.
    #[serde(default)]
    pub steps: Vec<Step>,
}

/// A jump of an equation where one coordinate moves and all others stand still.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Step {
    /// The constraint.
    pub constraint: String,
    /// The equation, such as `stair` or `B.x`.
    pub equation: String,
    /// The coordinate that moves.
    pub coordinate: String,
    /// Its value at the jump, nearly.   \[m or rad\]
    pub at: f64,
    /// The value of the equation just below.   \[unit of the row\]
    pub from: f64,
    /// The value just above.   \[unit of the row\]
    pub to: f64,
}

/// Another driver where one cannot be met.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Against {
    /// The driver.
    pub constraint: String,
    /// The value asked for and the one reached, where it is a driver of one coordinate.
    pub asks: Option<Asks>,
}

/// The value that a driver asks for and does not get.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Asks {
    /// The coordinate.
    pub coordinate: String,
    /// The value asked for.   \[m or rad\]
    pub asked: f64,
    /// Where it stands.   \[m or rad\]
    pub stands: f64,
    /// By how much an angle that is asked of a first position lies beyond its guess; `None` of
    /// lengths and of later positions.   \[rad\]
    #[serde(default)]
    pub beyond_guess: Option<f64>,
}

impl Asks {
    pub(crate) fn new(coordinate: String, asked: f64, stands: f64) -> Self {
        Asks { coordinate, asked, stands, beyond_guess: None }
    }

    /// True if an angle is asked for that is more than a turn from its guess, as degrees in the
    /// place of radians are.
    pub(crate) fn is_more_than_a_turn(&self) -> bool {
        self.beyond_guess.is_some_and(|beyond| beyond.abs() > TAU)
    }
}

impl Gap {
    /// |C| of the constraint: the length of the gap for a joint that holds two points
    /// together.   \[unit of the row\]
    pub fn size(&self) -> f64 {
        self.residual.iter().map(|c| c * c).sum::<f64>().sqrt()
    }
}
