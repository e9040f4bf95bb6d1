//! The places of numbers that hang on dimensions.

/// The place of a number that hangs on dimensions.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Bound {
    /// A parameter of a constraint, by its number and its name.
    Parameter { of: Holder, index: usize, name: String },
    /// The guess of a coordinate.
    Guess(usize),
    /// The length of a link, by its number among those that have one.
    Length(usize),
    /// A component of the direction that an axis was given by, and after three of those one of the
    /// second direction. The axis is worked out of all of them together.
    Axis { of: Holder, name: String, part: usize },
    /// A component of the first point that a spatial body is drawn between, and after three of
    /// those one of the second. The guess of the body, whose coordinates begin there, is worked out
    /// of all of them.
    Between { first: usize, part: usize },
    /// A component of the origin of a spatial body that is drawn facing a direction, and after
    /// three of those those of one or two directions. Its guess is worked out of all of them.
    Facing { first: usize, part: usize },
    /// The preferred value of a coordinate, which is its guess too.
    Preferred(usize),
    /// The preferred value of a measure or a coordinate, by its name.
    PreferredMeasure(String),
    /// A number of what has mass or acts, by its name there.
    Beside { of: Beside, name: String },
}

/// A constraint of the mechanism, or one that is no equation: what has mass and what acts is told
/// by constraints too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holder {
    /// Constraint of that number.
    Constraint(usize),
    /// The point of a mass, by its number.
    Point(usize),
    /// The energy, the length or the angle of part `part` of a load.
    Load { load: usize, part: usize },
    /// The force along that length or angle.
    Force { load: usize, part: usize },
}

/// Anything that has mass or acts and has numbers that are no parameters of a constraint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Beside {
    /// The mass, centre and inertia of a body, by the number of its item in the layout.
    Solid(usize),
    /// The mass at a point, by its number.
    PointMass(usize),
    /// The acceleration of gravity.
    Gravity,
    /// A force and torque on a body: part `part` of a load.
    OnBody { load: usize, part: usize },
    /// Friction in the joint of that name.
    Friction(String),
}

impl Bound {
    /// True of a number of what has mass or acts, which moves nothing.
    pub(crate) fn is_beside(&self) -> bool {
        match self {
            Bound::Beside { .. } => true,
            Bound::Parameter { of, .. } | Bound::Axis { of, .. } => {
                !matches!(of, Holder::Constraint(_))
            }
            _ => false,
        }
    }

    /// True of the guess of a coordinate, and of what decides it.
    pub(crate) fn is_guess(&self) -> bool {
        matches!(
            self,
            Bound::Guess(_)
                | Bound::Between { .. }
                | Bound::Facing { .. }
                | Bound::Preferred(_)
                | Bound::PreferredMeasure(_)
        )
    }

    /// True if a number is noted with others that it is worked out with, constants among them.
    pub(crate) fn is_of_several(&self) -> bool {
        matches!(self, Bound::Axis { .. } | Bound::Between { .. } | Bound::Facing { .. })
    }

    /// True if both are numbers of one axis, or of one pose.
    pub(super) fn is_with(&self, other: &Bound) -> bool {
        match (self, other) {
            (Bound::Axis { of, name, .. }, Bound::Axis { of: o, name: n, .. }) => {
                (of, name) == (o, n)
            }
            (Bound::Between { first, .. }, Bound::Between { first: other, .. }) => first == other,
            (Bound::Facing { first, .. }, Bound::Facing { first: other, .. }) => first == other,
            _ => false,
        }
    }
}
