//! Describes changes after which a mechanism can be driven.

use serde::{Deserialize, Serialize};

use super::gap::{Asks, Step};

/// A single change of the mechanism.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Change {
    /// Remove a constraint.
    Remove {
        /// The constraint.
        constraint: String,
        /// Other constraints that the user could remove instead: drivers that contradict this one,
        /// or joints of one row.
        or: Vec<String>,
    },
    /// Change a dimension so that a joint closes.
    Fit {
        /// The joint.
        constraint: String,
        /// The gap of the joint. \[unit of the joint's rows\]
        missing: f64,
        /// The rows that the user could remove instead; all rows if the whole joint could be
        /// removed.
        or_drop: Vec<String>,
        /// The number of rows of the joint.
        of: usize,
    },
    /// Give one dimension of a list another value, so that the mechanism closes and its drivers can
    /// move it.
    Resize {
        /// The possible changes, the most likely first.
        any: Vec<Resize>,
    },
    /// Allow redundant equations to contradict each other by a given share of the mechanism's size
    /// ([`crate::SolverOptions::allowed_misfit`]). Parts with ordinary manufacturing accuracy cause
    /// contradictions of this size.
    Allow {
        /// The misfit to allow.   \[-\]
        misfit: f64,
    },
    /// Exchange two points of a constraint, because each point belongs to the other body.
    Swap {
        /// The constraint.
        constraint: String,
        /// The bodies, in order.
        bodies: [String; 2],
        /// The points that the user gave for them. \[m\]
        points: [Vec<f64>; 2],
    },
    /// Convert points from the global frame to the frames of their bodies.
    Local {
        /// All such points.
        points: Vec<GlobalPoint>,
    },
    /// Move one of two constraints to the other end of a body, because both constraints hold the
    /// same end.
    OtherEnd {
        /// The constraints.
        constraints: [String; 2],
        /// The body.
        body: String,
        /// The end that both hold, in the frame of the body. \[m\]
        point: Vec<f64>,
    },
    /// Reduce the range of a driver, because its value is beyond the reach of the mechanism.
    Limit {
        /// The driver.
        constraint: String,
        /// For a driver of one coordinate: its value, and the nearest value that Kin found. `None`
        /// for other drivers.
        asks: Option<Asks>,
        /// Dimensions that the user could change instead.
        or: Vec<Resize>,
    },
    /// Replace the step of an equation by a smooth function, or keep the coordinate away from the
    /// step.
    Smooth {
        /// The step.
        step: Step,
    },
    /// Remove some rows of a constraint, by using a joint that removes fewer freedoms.
    Drop {
        /// The constraint.
        constraint: String,
        /// The redundant rows.
        rows: Vec<String>,
        /// A joint of the library with exactly the remaining rows, in words.
        instead: Option<String>,
    },
    /// Drive or hold a coordinate.
    Drive {
        /// The coordinate.
        coordinate: String,
        /// For a spatial body the body whose rotation the coordinate means; `None` for other
        /// coordinates.
        turn: Option<String>,
        /// The bodies that move with the coordinate.
        moves: Vec<String>,
    },
    /// Replace one joint of a list by a joint with more freedoms, and add a motor. At present the
    /// joints remove all freedoms, and the mechanism has no driver.
    Loosen {
        /// The joints.
        constraints: Vec<String>,
    },
    /// Connect a body to other bodies, because no constraint holds the body.
    Join {
        /// The body or coordinate.
        body: String,
    },
    /// Connect two planar bodies, each of which has only one joint, or drive both bodies.
    Pin {
        /// The bodies.
        bodies: [String; 2],
        /// The coordinates that the user could drive instead.
        coordinates: [String; 2],
    },
    /// Hold a rotation on which nothing depends ([`crate::Mechanism::hold_idle_turns`]), or replace
    /// the body by a `distance` between its points.
    HoldIdle {
        /// The bodies that rotate together.
        bodies: Vec<String>,
    },
}

/// A new value for a dimension.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Resize {
    /// The dimension.
    pub of: Size,
    /// The present value. \[m, or the unit of the parameter\]
    pub is: Vec<f64>,
    /// A value that closes the mechanism.
    pub fits: Vec<f64>,
    /// True if only the value in `fits` works. False if all values further away from the present
    /// value work too.
    pub exact: bool,
}

/// A dimension of the mechanism.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Size {
    /// The length of a body between two points that constraints hold.
    Length {
        /// The body.
        body: String,
    },
    /// A number of a constraint.
    Number {
        /// The constraint.
        constraint: String,
        /// The parameter.
        parameter: String,
    },
    /// A point of a constraint.
    Point {
        /// The constraint.
        constraint: String,
        /// The parameter.
        parameter: String,
        /// The body that contains the point; `None` for the ground.
        body: Option<String>,
    },
}

/// A point that the user gave in the global frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct GlobalPoint {
    /// The constraint.
    pub constraint: String,
    /// The parameter, such as `u_j`.
    pub point: String,
    /// The body to which the parameter belongs.
    pub body: String,
    /// The point as the user gave it, in the global frame. \[m\]
    pub given: Vec<f64>,
    /// The local position of the point in the body at its drawn pose. \[m\]
    pub local: Vec<f64>,
}
