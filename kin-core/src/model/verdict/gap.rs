//! Constraints that cannot be satisfied together with all others.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

/// A constraint that cannot be satisfied together with all others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Gap {
    /// The constraint.
    pub constraint: String,
    /// The rows of its equations in the system.
    pub rows: Vec<usize>,
    /// The names of its equations, such as `B.x`.
    pub equations: Vec<String>,
    /// The residual of each equation where all other constraints are satisfied and this one is as
    /// close as Kin found. \[unit of the row\]
    pub residual: Vec<f64>,
    /// For a driver of one coordinate: the coordinate, its required value and the nearest value.
    /// `None` for other constraints. \[m or rad\]
    pub asks: Option<Asks>,
    /// True if the equations depend on the others at nearby poses too, so they contradict each
    /// other. False if something does not reach.
    pub lasting: bool,
    /// The number of starts of the search.
    pub starts: usize,
    /// The other drivers. A driver of one coordinate has its required and its nearest value.
    #[serde(default)]
    pub against: Vec<Against>,
    /// True if an equation of the mechanism can jump when coordinates move (`floor`, `%`, `signum`,
    /// an `if`), or if Kin does not know. Then a smaller residual than the given one may exist
    /// nearby.
    #[serde(default)]
    pub can_jump: bool,
    /// The jumps that Kin found near the pose.
    #[serde(default)]
    pub steps: Vec<Step>,
}

/// A jump of an equation along one coordinate, with all others constant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Step {
    /// The constraint.
    pub constraint: String,
    /// The equation, such as `stair` or `B.x`.
    pub equation: String,
    /// The coordinate.
    pub coordinate: String,
    /// The approximate value of the coordinate at the jump. \[m or rad\]
    pub at: f64,
    /// The value of the equation just below the jump. \[unit of the row\]
    pub from: f64,
    /// The value just above the jump. \[unit of the row\]
    pub to: f64,
}

/// Another driver, where one cannot be satisfied.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Against {
    /// The driver.
    pub constraint: String,
    /// The required value and the reached one, for a driver of one coordinate; otherwise `None`.
    pub asks: Option<Asks>,
}

/// The value that a driver requires and does not reach.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Asks {
    /// The coordinate.
    pub coordinate: String,
    /// The required value. \[m or rad\]
    pub asked: f64,
    /// The reached value. \[m or rad\]
    pub stands: f64,
    /// The difference of a required angle from its guess at a first position; `None` for lengths
    /// and for later positions. \[rad\]
    #[serde(default)]
    pub beyond_guess: Option<f64>,
}

impl Asks {
    pub(crate) fn new(coordinate: String, asked: f64, stands: f64) -> Self {
        Asks { coordinate, asked, stands, beyond_guess: None }
    }

    /// Returns true if the required angle is more than a revolution from its guess, as degrees in
    /// place of radians are.
    pub(crate) fn is_more_than_a_turn(&self) -> bool {
        self.beyond_guess.is_some_and(|beyond| beyond.abs() > TAU)
    }
}

impl Gap {
    /// Returns |C| of the constraint. For a joint that holds two points together it is the length
    /// of the gap. \[unit of the row\]
    pub fn size(&self) -> f64 {
        self.residual.iter().map(|c| c * c).sum::<f64>().sqrt()
    }

    /// True if its equations are the components of a distance between two points.
    pub(super) fn is_between_points(&self) -> bool {
        let is_component = |name: &String| matches!(name.rsplit('.').next(), Some("x" | "y" | "z"));
        !self.equations.is_empty() && self.equations.iter().all(is_component)
    }
}
