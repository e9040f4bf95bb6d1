//! Describes dry friction in pins and slides: the numbers, and where in a joint friction acts.

use crate::coordinates::Target;
use crate::dimensions::{Dimension, IntoNumber};
use crate::model::constraint::{Attached, Constraint};
use crate::model::describer::Describer;
use crate::numbers::algebra::{Vec3, vec3};
use crate::outcome::error::Error;
use crate::outcome::words::list;

/// Dry friction in a joint: μ times the sum of the contact forces, times tanh(v/v₀) against the
/// slip v.
///
/// If v is much larger than v₀, the formula gives Coulomb friction. At rest the friction is zero.
/// Kin computes the contact forces from the reaction of the joint:
///
/// * In a pin of radius r the torque is μ r F tanh(ω/ω₀), where F is the force across the axis. In
///   space a pin with [`Friction::length`] also carries a bending moment, as a pair of forces at
///   the ends of its bearing.
/// * In a slide with a guide of length L and width b the reaction is the force F across the slide
///   and the moment M about the joint's point. The contact forces act at the ends of the guide, at
///   ± L/2 from the point P_i of body i: N₁,₂ = F/2 ± M/L. The friction μ (|N₁| + |N₂|) tanh(v/v₀)
///   acts along the slide on the loaded side of the guide, at the distance b/2 from its line. In
///   space the torque T about the slide causes contact forces across the width, which add 2 |T|/b.
///
/// Each contact follows Coulomb's law. For example, let a force P push a block along its guide at
/// the distance a from the line of the guide. The contact forces at the ends of the guide are then
/// ± P a/L. The necessary force is P = load/(1 − 2 μ a/L), and the block jams if a ≥ L/(2 μ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// μ, the coefficient of friction.
    pub(crate) coefficient: f64,
    /// ω₀ of a pin or v₀ of a slide.
    pub(crate) rate: f64,
    pub(crate) shape: Shape,
    /// The given numbers, in the order of their names.
    given: [Dimension; 4],
}

/// The geometry of the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape {
    /// A length of 0 means a short bearing, which holds no bending.
    Pin {
        radius: f64,
        length: f64,
    },
    Slide {
        length: f64,
        width: f64,
    },
}

impl Shape {
    /// Returns the names of the numbers of this shape.
    pub(super) fn names(&self) -> [&'static str; 2] {
        match self {
            Shape::Pin { .. } => ["radius", "length"],
            Shape::Slide { .. } => ["length", "width"],
        }
    }

    pub(super) fn numbers_mut(&mut self) -> [&mut f64; 2] {
        match self {
            Shape::Pin { radius, length } => [radius, length],
            Shape::Slide { length, width } => [length, width],
        }
    }
}

impl Friction {
    /// Creates the friction of a pin with the coefficient μ, the radius r and the angular velocity
    /// ω₀. \[-, m, rad/s\]
    ///
    /// At ω₀ the friction has three quarters of its full size. Each argument may be a
    /// [`Dimension`].
    pub fn pin(
        coefficient: impl IntoNumber,
        radius: impl IntoNumber,
        rate: impl IntoNumber,
    ) -> Friction {
        let none = Shape::Pin { radius: 0.0, length: 0.0 };
        let given =
            [coefficient.into_number(), rate.into_number(), radius.into_number(), 0.0.into()];
        Friction::of(none, given)
    }

    fn of(mut shape: Shape, given: [Dimension; 4]) -> Friction {
        let [coefficient, rate, a, b] = given.map(Dimension::value);
        let [first, second] = shape.numbers_mut();
        (*first, *second) = (a, b);
        Friction { coefficient, rate, shape, given }
    }

    /// Returns the given numbers with their names.
    pub(crate) fn given(&self) -> impl Iterator<Item = (&'static str, Dimension)> {
        self.names().into_iter().zip(self.given)
    }

    /// Creates the friction of a slide with the coefficient μ, the length L and the width b of its
    /// guide, and the velocity v₀. \[-, m, m, m/s\]
    ///
    /// At v₀ the friction has three quarters of its full size. The contacts at both ends of the
    /// guide move with body i of the joint. Body i is thus a block in a long guide, or the bush on
    /// a rod.
    pub fn slide(
        coefficient: impl IntoNumber,
        [length, width]: [impl IntoNumber; 2],
        rate: impl IntoNumber,
    ) -> Friction {
        let none = Shape::Slide { length: 0.0, width: 0.0 };
        let [coefficient, rate] = [coefficient.into_number(), rate.into_number()];
        Friction::of(none, [coefficient, rate, length.into_number(), width.into_number()])
    }

    /// Sets the length of the pin's bearing, which carries a bending moment by forces at its two
    /// ends. \[m\]
    ///
    /// In a plane the length has no effect, because a planar pin carries no bending moment.
    #[must_use]
    pub fn length(self, bearing: impl IntoNumber) -> Friction {
        let place = if matches!(self.shape, Shape::Pin { .. }) { 3 } else { 2 };
        let mut given = self.given;
        given[place] = bearing.into_number();
        Friction::of(self.shape, given)
    }

    /// Returns the reason why these numbers are invalid, if there is one.
    fn refusal(&self) -> Option<String> {
        let at_least_zero = |what: &str, x: f64| {
            (!(x.is_finite() && x >= 0.0))
                .then(|| format!("{what} is {x}. Give a value of at least zero"))
        };
        let above_zero = |what: &str, x: f64| {
            (!(x.is_finite() && x > 0.0)).then(|| format!("{what} is {x}. Give a value above zero"))
        };
        let shape = match self.shape {
            Shape::Pin { radius, length } => above_zero("the radius of the pin", radius)
                .or_else(|| at_least_zero("the length of the bearing", length)),
            Shape::Slide { length, width } => above_zero("the length of the guide", length)
                .or_else(|| at_least_zero("the width of the guide", width)),
        };
        let rate = "the velocity at which friction reaches its full size";
        at_least_zero("the coefficient of friction", self.coefficient)
            .or(shape)
            .or_else(|| above_zero(rate, self.rate))
    }

    /// Returns where the friction acts in a joint. Errors: invalid numbers, or a joint that cannot
    /// have this friction; the error names the joint.
    pub(crate) fn seat_in(&self, name: &str, joint: &dyn Constraint) -> crate::Result<Seat> {
        let told = |reason| Error::InvalidParameters {
            constraint: name.to_string(),
            kind: "friction".to_string(),
            reason,
        };
        self.seat(joint).map_err(told)
    }

    fn seat(&self, joint: &dyn Constraint) -> Result<Seat, String> {
        if let Some(reason) = self.refusal() {
            return Err(reason);
        }
        let kind = joint.facts().kind.to_string();
        let (kinds, told) = match self.shape {
            Shape::Pin { .. } => (&["revolute", "cylindrical"][..], "pin"),
            Shape::Slide { .. } => {
                (&["prismatic", "cylindrical", "point_on_line", "pin_in_slot"][..], "slide")
            }
        };
        let whose = if is_of_library(joint) { "" } else { ", which is user-defined" };
        let is_known = whose.is_empty() && kinds.contains(&kind.as_str());
        let seat = is_known.then(|| Seat::of(joint, told == "pin")).flatten();
        let seat = seat.ok_or_else(|| {
            format!(
                "friction of a {told} needs one of the joints {}, but the joint is `{kind}`{whose}",
                list(&kinds.iter().map(ToString::to_string).collect::<Vec<_>>())
            )
        })?;
        match self.shape {
            Shape::Slide { width, .. } if seat.holds_turn && width == 0.0 => {
                let reason = "the guide of a spatial slide holds the torque about the slide by its width. Give a width above zero";
                Err(reason.to_string())
            }
            _ => Ok(seat),
        }
    }
}

/// Returns true for a joint of the library. A user-defined function may have the same name with
/// other parameters.
fn is_of_library(joint: &dyn Constraint) -> bool {
    let mut described = Describer::default();
    joint.describe(&mut described);
    described.refusal.is_none() && described.equation().is_none() && described.lacking().is_empty()
}

/// The place of the friction in a joint of two bodies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Seat {
    /// Bodies i and j.
    pub bodies: [Target; 2],
    /// ū_i of the joint's point.
    pub point: Vec3,
    /// The unit vector of the pin's axis or of the slide, in the axes of body `axis_of`.
    pub axis: Vec3,
    pub axis_of: usize,
    /// True if the joint prevents body i from rotating about the axis.
    pub holds_turn: bool,
}

impl Seat {
    /// Returns the seat of a joint of the library, from its parameters and directions.
    fn of(joint: &dyn Constraint, pin: bool) -> Option<Seat> {
        let arguments = joint.arguments();
        let [i, j] = arguments.as_slice() else { return None };
        let mut numbers: Vec<(String, f64)> = Vec::new();
        joint.parameters(&mut |name, value| numbers.push((name.to_string(), value)));
        let number = |vector: &str, component: &str| {
            let name = format!("{vector}.{component}");
            numbers.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
        };
        let vector = |name: &str| {
            Some(vec3(number(name, "x")?, number(name, "y")?, number(name, "z").unwrap_or(0.0)))
        };
        let point = vector("u_i")?;
        let spatial = matches!(i.target, Target::Spatial(_));
        let kind = joint.facts().kind.to_string();
        let z = vec3(0.0, 0.0, 1.0);
        let (axis, axis_of) = match kind.as_str() {
            _ if spatial => {
                let across = joint.attachments().into_iter().filter_map(|found| match found.what {
                    Attached::Direction(h) if found.argument == 0 => Some(h),
                    _ => None,
                });
                let across: Vec<Vec3> = across.collect();
                (across.first()?.cross(*across.get(1)?), 0)
            }
            _ if pin => (z, 0),
            // `prismatic` gives the direction across the slide. If that direction is y, the slide
            // is along x.
            "prismatic" => (vector("h_i")?.cross(z), 0),
            "point_on_line" => (vector("h_j")?, 1),
            _ => (vector("b_j")? - vector("a_j")?, 1),
        };
        let length = axis.norm();
        let seat = Seat {
            bodies: [i.target, j.target],
            point,
            axis: axis * (1.0 / length),
            axis_of,
            holds_turn: spatial && kind == "prismatic",
        };
        (length > 0.0 && length.is_finite()).then_some(seat)
    }
}
