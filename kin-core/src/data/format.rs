//! Defines the format of mechanism files.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::dimension::{DimensionData, NumberData};
use super::dynamics::{FrictionData, LoadData, MassData, PointMassData};
use super::{is_first, once};
use crate::coordinates::layout::Kind;
use crate::coordinates::units::Units;
use crate::model::dual_route::ArgumentKind;

/// A mechanism as data: bodies, constraints with their parameters, laws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct MechanismData {
    /// The version of the file format.
    #[serde(default = "is_first")]
    pub format: u32,
    /// The name of the mechanism.
    pub name: String,
    /// The names of the units of the mechanism.
    #[serde(default, skip_serializing_if = "Units::is_default")]
    pub units: Units,
    /// The equations of user-defined constraints, as text in the language of `#[constraint]`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub equations: Vec<String>,
    /// The named dimensions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub dimensions: Vec<DimensionData>,
    /// The bodies and scalar coordinates in order.
    pub bodies: Vec<BodyData>,
    /// The constraints in order.
    pub constraints: Vec<ConstraintData>,
    /// The permitted ranges of measures.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<LimitData>,
    /// The measures whose values select an assembly.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub preferred: Vec<PreferredData>,
    /// The masses of bodies, by the name of the body.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub masses: Vec<MassData>,
    /// The points with mass in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub point_masses: Vec<PointMassData>,
    /// The acceleration of gravity; `None` for zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<[NumberData; 3]>,
    /// The loads in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub loads: Vec<LoadData>,
    /// The dry friction in joints, by the name of the joint.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frictions: Vec<FrictionData>,
}

/// The forces of a motion: every unique quantity as a column with its unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ForcesData {
    /// The version of the format.
    #[serde(default = "is_first")]
    pub format: u32,
    /// The name of the mechanism.
    pub mechanism: String,
    /// The names of the units of length, time and mass, from which Kin derives the units of the
    /// columns.
    pub units: Units,
    /// The times.
    pub times: Vec<f64>,
    /// The columns: efforts and powers of drivers, components of reactions, energies.
    pub columns: Vec<ColumnData>,
    /// The largest error of the balance of powers, as a share of the largest power.
    pub left_over: f64,
}

/// A quantity over time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ColumnData {
    /// The name, such as `A on crank.F_x`.
    pub name: String,
    /// The unit, such as N m.
    pub unit: String,
    /// The value at each time.
    pub values: Vec<f64>,
}

/// The preferred value of a measure of a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct PreferredData {
    /// The measure, such as `elbow.angle`.
    pub measure: String,
    /// The value, in the unit of the measure.
    pub value: NumberData,
}

/// The permitted range of a measure of a joint or of a coordinate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct LimitData {
    /// The measure or coordinate, such as `slot.slide`.
    pub measure: String,
    /// The lower end of the range, in the unit of the measure; `None` for no limit.
    pub from: Option<f64>,
    /// The upper end of the range, in the unit of the measure; `None` for no limit.
    pub to: Option<f64>,
}

/// A body or scalar coordinate with its guess.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct BodyData {
    /// The name.
    pub name: String,
    /// The kind of the body.
    pub kind: BodyKind,
    /// The guess of the coordinates of the body.
    pub guess: Vec<NumberData>,
    /// The preferred values of the coordinates of the body; `None` for a coordinate without
    /// preference.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub preferred: Vec<Option<NumberData>>,
    /// The length between the pins of a link; `None` for a body that is not a link.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<NumberData>,
    /// The points between which a spatial body is drawn. If the points are given, Kin computes the
    /// guess from them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between: Option<[[NumberData; 3]; 2]>,
    /// The position of a spatial body and the components of one or two directions that the body
    /// faces. If the field is given, Kin computes the guess from it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub facing: Option<Vec<NumberData>>,
}

/// The kind of a body or coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum BodyKind {
    /// The coordinates R_x, R_y, θ.
    Planar,
    /// The coordinates R, e0..e3.
    Spatial,
    /// A scalar coordinate that is an angle.
    Angle,
    /// A scalar coordinate that is a length.
    Length,
}

/// A constraint with its kind, arguments and parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ConstraintData {
    /// The name.
    pub name: String,
    /// The name of the function that defines the constraint.
    pub kind: String,
    /// The bodies and coordinates, in the order of the signature.
    pub arguments: Vec<ArgumentData>,
    /// The parameters by name.
    #[serde(default, deserialize_with = "once::object")]
    pub parameters: Map<String, Value>,
    /// Names in the text of the equation whose definitions the file cannot contain. If the list is
    /// not empty, only a program that defines the constraint can read the file.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lacking: Vec<String>,
}

/// An argument of a constraint; `None` means the ground.
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
    /// A coordinate of the ground as a planar body, by its index.
    GroundCoord(usize),
    /// A coordinate of the ground as a spatial body, by its index.
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
