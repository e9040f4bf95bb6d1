//! Describes constraints that cannot be satisfied together with all other constraints.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::outcome::words::with_unit;

/// A constraint that cannot be satisfied together with all other constraints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Gap {
    /// The constraint.
    pub constraint: String,
    /// The rows of its equations in the system.
    pub rows: Vec<usize>,
    /// The names of its equations, such as `B.x`.
    pub equations: Vec<String>,
    /// The residual of each equation at the pose that satisfies all other constraints and has the
    /// smallest residual that Kin found. \[unit of the row\]
    pub residual: Vec<f64>,
    /// The unit of each residual, such as `m` (the unit of length), `rad` or `-`; `None` if Kin
    /// does not know the unit.
    #[serde(default)]
    pub row_units: Vec<Option<String>>,
    /// For a driver of one coordinate, the coordinate with its required value and the nearest
    /// possible value; `None` for other constraints. \[m or rad\]
    pub asks: Option<Asks>,
    /// True if the equations also depend on other equations at nearby poses, so the equations
    /// contradict each other. False if the constraint is out of reach.
    pub lasting: bool,
    /// The number of starts of the search.
    pub starts: usize,
    /// The other drivers. For a driver of one coordinate, the list contains its required and its
    /// reached value.
    #[serde(default)]
    pub against: Vec<Against>,
    /// True if an equation of the mechanism can jump when coordinates move (`floor`, `%`, `signum`,
    /// an `if`), or if Kin cannot exclude a jump. If true, a nearby pose may have a smaller
    /// residual.
    #[serde(default)]
    pub can_jump: bool,
    /// The jumps that Kin found near the pose.
    #[serde(default)]
    pub steps: Vec<Step>,
}

/// A jump of an equation along one coordinate, with all other coordinates constant.
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
    /// The value of the equation just above the jump. \[unit of the row\]
    pub to: f64,
}

/// Another driver of the mechanism, in addition to the driver that cannot be satisfied.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Against {
    /// The name of the driver.
    pub constraint: String,
    /// The required value and the reached value, for a driver of one coordinate; otherwise `None`.
    pub asks: Option<Asks>,
}

/// The value that a driver requires, and the value that the coordinate reaches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Asks {
    /// The coordinate.
    pub coordinate: String,
    /// The required value. \[m or rad\]
    pub asked: f64,
    /// The reached value. \[m or rad\]
    pub stands: f64,
    /// The difference of a required angle from its guess, at the first position of a run. `None`
    /// for lengths and for later positions. \[rad\]
    #[serde(default)]
    pub beyond_guess: Option<f64>,
    /// The unit of the three numbers; empty for a number without one.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub unit: String,
}

impl Asks {
    pub(crate) fn new(coordinate: String, unit: String, asked: f64, stands: f64) -> Self {
        Asks { coordinate, asked, stands, beyond_guess: None, unit }
    }

    /// "1.0000 rad", or the number alone if it has no unit.
    pub(super) fn with_unit(&self, number: &str) -> String {
        with_unit(number, &self.unit)
    }

    /// Returns true if the required angle is more than a revolution from its guess, as degrees in
    /// place of radians are.
    pub(crate) fn is_more_than_a_turn(&self) -> bool {
        self.beyond_guess.is_some_and(|beyond| beyond.abs() > TAU)
    }
}

impl Gap {
    /// Returns |C| of the constraint. \[unit of the row\]
    ///
    /// For a joint that holds two points together, |C| is the length of the gap.
    pub fn size(&self) -> f64 {
        self.residual.iter().map(|c| c * c).sum::<f64>().sqrt()
    }

    /// True if its equations are the components of a distance between two points.
    pub(super) fn is_between_points(&self) -> bool {
        let is_component = |name: &String| matches!(name.rsplit('.').next(), Some("x" | "y" | "z"));
        let is_length = |unit: &Option<String>| !matches!(unit.as_deref(), Some("rad" | "-" | "–"));
        !self.equations.is_empty()
            && self.equations.iter().all(is_component)
            && self.row_units.iter().all(is_length)
    }
}
