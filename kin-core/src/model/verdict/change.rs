//! Changes after which a mechanism can be driven.

use serde::{Deserialize, Serialize};

use super::gap::{Asks, Step};

/// One thing to change in the model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Change {
    /// Leave a constraint out.
    Remove {
        /// The constraint.
        constraint: String,
        /// Constraints of which any could be left out in its place: other drivers that contradict
        /// it, or joints of one row.
        or: Vec<String>,
    },
    /// Change a dimension by which a joint can be met.
    Fit {
        /// The joint.
        constraint: String,
        /// The gap of the joint.   \[unit of the joint's rows\]
        missing: f64,
        /// Names of its rows that could be left out in place of it; all of them if the whole joint
        /// could.
        or_drop: Vec<String>,
        /// How many rows it has.
        of: usize,
    },
    /// Give a dimension another value, any one of these: with it everything closes, and what drives
    /// has something to drive.
    Resize {
        /// The likeliest first.
        any: Vec<Resize>,
    },
    /// Allow redundant equations to contradict one another by this share of the mechanism's size,
    /// [`crate::SolverOptions::allowed_misfit`]: they do so by no more than parts of ordinary
    /// accuracy.
    Allow {
        /// The misfit to allow.   \[-\]
        misfit: f64,
    },
    /// Two points of a constraint are exchanged: each is a point of the other's body.
    Swap {
        /// The constraint.
        constraint: String,
        /// Its bodies in their order.
        bodies: [String; 2],
        /// The points that were given for them.   \[m\]
        points: [Vec<f64>; 2],
    },
    /// Points are given in the global frame where those of a body are wanted.
    Local {
        /// All of them.
        points: Vec<GlobalPoint>,
    },
    /// Two constraints hold the same end of a body, and none its other end.
    OtherEnd {
        /// The constraints.
        constraints: [String; 2],
        /// The body.
        body: String,
        /// The end that both hold, in the body.   \[m\]
        point: Vec<f64>,
    },
    /// Ask less of a driver: what it asks for is beyond what the mechanism can reach.
    Limit {
        /// The driver.
        constraint: String,
        /// For a driver of one coordinate: what it asks for, and the nearest to it that was found.
        asks: Option<Asks>,
        /// Dimensions that could be others instead.
        or: Vec<Resize>,
    },
    /// Replace the step of an equation by a smooth function, or keep the coordinate away from it.
    Smooth {
        /// The step.
        step: Step,
    },
    /// Leave some rows of a constraint out: a joint that holds less.
    Drop {
        /// The constraint.
        constraint: String,
        /// Names of its rows that are superfluous.
        rows: Vec<String>,
        /// A joint of the library that holds just the rest, in words.
        instead: Option<String>,
    },
    /// Drive a coordinate, or hold it.
    Drive {
        /// The coordinate.
        coordinate: String,
        /// The body whose turn is meant by it, where that is no coordinate of its own: of a spatial
        /// one.
        turn: Option<String>,
        /// The bodies that would move with it.
        moves: Vec<String>,
    },
    /// Let one of these joints hold less, and add a motor: together they hold everything, and
    /// nothing drives.
    Loosen {
        /// The joints.
        constraints: Vec<String>,
    },
    /// Join a body to others: no constraint holds it.
    Join {
        /// The body or coordinate.
        body: String,
    },
    /// Join two planar bodies that are held by one joint each, or drive both.
    Pin {
        /// The bodies.
        bodies: [String; 2],
        /// The coordinates that could be driven instead.
        coordinates: [String; 2],
    },
    /// Hold a turn that nothing depends on, [`crate::Mechanism::hold_idle_turns`]; or make the body
    /// a `distance` between its points.
    HoldIdle {
        /// The bodies that turn as one.
        bodies: Vec<String>,
    },
}

/// Another value for a dimension.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Resize {
    /// The owner of the dimension.
    pub of: Size,
    /// Its present value.   \[m, or the unit of the parameter\]
    pub is: Vec<f64>,
    /// A value that fits.
    pub fits: Vec<f64>,
    /// True if only that value fits; false if those beyond it, seen from the present one, do too.
    pub exact: bool,
}

/// The owner of a dimension.
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
        /// Its parameter.
        parameter: String,
    },
    /// A point of a constraint.
    Point {
        /// The constraint.
        constraint: String,
        /// Its parameter.
        parameter: String,
        /// The body in which it is; `None` for the ground.
        body: Option<String>,
    },
}

/// A point that was given in the global frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct GlobalPoint {
    /// The constraint.
    pub constraint: String,
    /// Its parameter, such as `u_j`.
    pub point: String,
    /// The body in which it is taken.
    pub body: String,
    /// The point as it was given.   \[m\]
    pub given: Vec<f64>,
    /// Where that is in the body as it is drawn.   \[m\]
    pub local: Vec<f64>,
}
