//! Describes where a mechanism stores the numbers that depend on dimensions.

/// The place of a number that depends on dimensions.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Bound {
    /// A parameter of a constraint, by its index and its name.
    Parameter { of: Holder, index: usize, name: String },
    /// The guess of a coordinate, by its column.
    Guess(usize),
    /// The length of a link, by its index among the links with a length.
    Length(usize),
    /// A component of the direction that defines an axis. Parts 0 to 2 belong to the first
    /// direction, parts 3 to 5 to the second. Kin computes the axis from all of them together.
    Axis { of: Holder, name: String, part: usize },
    /// A component of the two points between which a spatial body is drawn. Parts 0 to 2 belong to
    /// the first point, parts 3 to 5 to the second. Kin computes the guess of the body, whose
    /// coordinates start at column `first`, from all of them.
    Between { first: usize, part: usize },
    /// A component of the pose of a spatial body that faces a direction. Parts 0 to 2 are the
    /// origin; the parts from 3 on are one or two directions. Kin computes the guess of the body
    /// from all of them.
    Facing { first: usize, part: usize },
    /// The preferred value of a coordinate, which is also its guess.
    Preferred(usize),
    /// The preferred value of a measure or a coordinate, by name.
    PreferredMeasure(String),
    /// A number of a mass or a load, by its name there.
    Beside { of: Beside, name: String },
}

/// A constraint that holds parameters. Masses and loads use constraints too, but these are no
/// equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holder {
    /// The constraint with this index.
    Constraint(usize),
    /// The point of the mass with this index.
    Point(usize),
    /// The energy, the length or the angle of part `part` of a load.
    Load { load: usize, part: usize },
    /// The force along the length or angle of part `part` of a load.
    Force { load: usize, part: usize },
}

/// A mass or a load with numbers that are not parameters of a constraint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Beside {
    /// The mass, centre and inertia of a body, by the index of its item in the layout.
    Solid(usize),
    /// The mass at a point, by its index.
    PointMass(usize),
    /// The acceleration of gravity.
    Gravity,
    /// A force and torque on a body: part `part` of a load.
    OnBody { load: usize, part: usize },
    /// Friction in the joint with this name.
    Friction(String),
}

impl Bound {
    /// Returns true for a number of a mass or a load. Such a number does not change the motion.
    pub(crate) fn is_beside(&self) -> bool {
        match self {
            Bound::Beside { .. } => true,
            Bound::Parameter { of, .. } | Bound::Axis { of, .. } => {
                !matches!(of, Holder::Constraint(_))
            }
            _ => false,
        }
    }

    /// Returns true for the guess of a coordinate, and for a number that determines a guess.
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

    /// Returns true if Kin computes several such numbers together. Then constants are recorded too.
    pub(crate) fn is_of_several(&self) -> bool {
        matches!(self, Bound::Axis { .. } | Bound::Between { .. } | Bound::Facing { .. })
    }

    /// Returns true if both numbers belong to the same axis or to the same pose.
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
