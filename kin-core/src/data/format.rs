//! The format of mechanism files.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::dimensions::{DimensionData, NumberData};
use super::dynamics::{FrictionData, LoadData, MassData, PointMassData};
use super::{is_first, once};
use crate::model::dual_route::ArgumentKind;
use crate::model::layout::Kind;
use crate::model::units::Units;

/// A mechanism as data: bodies, constraints with their parameters, laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct MechanismData {
    /// Version of this format.
    #[serde(default = "is_first")]
    pub format: u32,
    /// Name of the mechanism.
    pub name: String,
    /// Names of its units.
    #[serde(default, skip_serializing_if = "Units::is_default")]
    pub units: Units,
    /// Equations of constraints of one's own, as text in the language of `#[constraint]`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub equations: Vec<String>,
    /// Named dimensions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub dimensions: Vec<DimensionData>,
    /// Bodies and bare coordinates in their order.
    pub bodies: Vec<BodyData>,
    /// Constraints in their order.
    pub constraints: Vec<ConstraintData>,
    /// Ranges that measures should keep to.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<LimitData>,
    /// Measures by whose values an assembly is preferred.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub preferred: Vec<PreferredData>,
    /// Masses of bodies, by their names.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub masses: Vec<MassData>,
    /// Points with mass in their order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub point_masses: Vec<PointMassData>,
    /// The acceleration of gravity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<[NumberData; 3]>,
    /// Loads in their order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub loads: Vec<LoadData>,
    /// Dry friction in joints, by their names.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frictions: Vec<FrictionData>,
}

/// Forces of a motion: everything that is unique as columns, each with its unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ForcesData {
    /// Version of the format.
    #[serde(default = "is_first")]
    pub format: u32,
    /// Name of the mechanism.
    pub mechanism: String,
    /// Names of the units that those of the columns are made of.
    pub units: Units,
    /// The times.
    pub times: Vec<f64>,
    /// Efforts and powers of drives, components of reactions, energies.
    pub columns: Vec<ColumnData>,
    /// The largest power that the balance leaves over, as a share of the largest power.
    pub left_over: f64,
}

/// A number over time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ColumnData {
    /// Its name, such as `A on crank.F_x`.
    pub name: String,
    /// Its unit, such as N m.
    pub unit: String,
    /// Its value at each time.
    pub values: Vec<f64>,
}

/// The value that a measure of a joint should have in the assembly that is meant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct PreferredData {
    /// The measure, such as `elbow.angle`.
    pub measure: String,
    /// Its value, in its unit.
    pub value: NumberData,
}

/// The range that a measure of a joint or a coordinate should keep to; `None` for no end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct LimitData {
    /// The measure or coordinate, such as `slot.slide`.
    pub measure: String,
    /// Its lower end, in its unit.
    pub from: Option<f64>,
    /// Its upper end.
    pub to: Option<f64>,
}

/// A body or bare coordinate with its guess.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct BodyData {
    /// Its name.
    pub name: String,
    /// Kind of the body.
    pub kind: BodyKind,
    /// Guess of its coordinates.
    pub guess: Vec<NumberData>,
    /// Preferred values of its coordinates, where there are any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub preferred: Vec<Option<NumberData>>,
    /// Length between the pins of a link.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<NumberData>,
    /// The points that a spatial body is drawn between, of which its guess then is worked out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between: Option<[[NumberData; 3]; 2]>,
    /// The place of a spatial body and the components of one or two directions that it faces, of
    /// which its guess then is worked out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub facing: Option<Vec<NumberData>>,
}

/// Kinds of bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum BodyKind {
    /// R_x, R_y, θ
    Planar,
    /// R, e0..e3
    Spatial,
    /// A bare angle.
    Angle,
    /// A bare length.
    Length,
}

/// A constraint by its kind, arguments and parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ConstraintData {
    /// Its name.
    pub name: String,
    /// Name of its function.
    pub kind: String,
    /// The bodies and coordinates that it acts on, in the order of its signature.
    pub arguments: Vec<ArgumentData>,
    /// Its parameters by name.
    #[serde(default, deserialize_with = "once::object")]
    pub parameters: Map<String, Value>,
    /// Names in the text of its equation that the text could not take along: the file does not
    /// stand alone, and is read by the program that has the constraint.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lacking: Vec<String>,
}

/// An argument of a constraint: `None` is the ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum ArgumentData {
    /// A planar body.
    Planar(Option<String>),
    /// A spatial body.
    Spatial(Option<String>),
    /// A coordinate by its name, such as `crank.theta`.
    Coord(String),
    /// A coordinate of the ground as a planar body, by its number.
    GroundCoord(usize),
    /// A coordinate of the ground as a spatial body, by its number.
    SpatialGroundCoord(usize),
}

impl ArgumentData {
    pub(super) fn kind(&self) -> ArgumentKind {
        match self {
            ArgumentData::Planar(_) => ArgumentKind::Planar,
            ArgumentData::Spatial(_) => ArgumentKind::Spatial,
            _ => ArgumentKind::Coord,
        }
    }
}

impl From<Kind> for BodyKind {
    fn from(kind: Kind) -> Self {
        match kind {
            Kind::Planar => BodyKind::Planar,
            Kind::Spatial => BodyKind::Spatial,
            Kind::Angle => BodyKind::Angle,
            Kind::Length => BodyKind::Length,
        }
    }
}

impl From<BodyKind> for Kind {
    fn from(kind: BodyKind) -> Self {
        match kind {
            BodyKind::Planar => Kind::Planar,
            BodyKind::Spatial => Kind::Spatial,
            BodyKind::Angle => Kind::Angle,
            BodyKind::Length => Kind::Length,
        }
    }
}
