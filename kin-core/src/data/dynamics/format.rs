//! Defines the format of loads in mechanism files.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::data::dimension::NumberData;
use crate::data::format::ArgumentData;
use crate::data::once;

/// A load: one or more parts that act together under one name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct LoadData {
    /// The name.
    pub name: String,
    /// The parts.
    pub parts: Vec<ActingData>,
}

/// A part of a load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum ActingData {
    /// An energy with the generalised forces −V_q.
    Energy(ScalarData),
    /// A force along a length or an angle x.
    Along {
        /// The length or angle.
        x: AlongData,
        /// The force: a function of x, its derivative and time.
        force: FormulaData,
    },
    /// A force at a point of a body, and a torque on it.
    OnBody {
        /// The name of the body.
        body: String,
        /// The point in the frame of the body; z is 0 in a plane.
        #[serde(default = "at_origin")]
        point: [NumberData; 3],
        /// The components of the force, as laws of time; absent if the load has no force.
        #[serde(
            default,
            skip_serializing_if = "Option::is_none",
            deserialize_with = "once::three"
        )]
        force: Option<Box<[Value; 3]>>,
        /// The components of the torque, as laws of time; a planar body uses only the last
        /// component.
        #[serde(
            default,
            skip_serializing_if = "Option::is_none",
            deserialize_with = "once::three"
        )]
        torque: Option<Box<[Value; 3]>>,
        /// True if the components are in the axes of the body.
        #[serde(default)]
        in_body: bool,
    },
}

/// A length or an angle along which a force acts.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
#[non_exhaustive]
pub enum AlongData {
    /// The value of a constraint of one row.
    Scalar(ScalarData),
    /// A measure of a joint, or a coordinate.
    Measure(MeasureData),
}

/// A measure of a joint or a coordinate, by its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct MeasureData {
    /// The name, such as `guide.slide`.
    pub measure: String,
}

/// The key `measure` selects the form, so that a mistake is reported for that form.
impl<'de> Deserialize<'de> for AlongData {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> std::result::Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Any {
            measure: Option<String>,
            kind: Option<String>,
            arguments: Option<Vec<ArgumentData>>,
            #[serde(default, deserialize_with = "once::some_object")]
            parameters: Option<Map<String, Value>>,
        }
        let missing = <D::Error as serde::de::Error>::missing_field;
        let excess = |key: &str| {
            <D::Error as serde::de::Error>::custom(format!(
                "with `measure` there is no key `{key}`. Remove one of the two"
            ))
        };
        match Any::deserialize(from)? {
            Any { measure: Some(_), kind: Some(_), .. } => Err(excess("kind")),
            Any { measure: Some(_), arguments: Some(_), .. } => Err(excess("arguments")),
            Any { measure: Some(_), parameters: Some(_), .. } => Err(excess("parameters")),
            Any { measure: Some(measure), .. } => Ok(AlongData::Measure(MeasureData { measure })),
            Any { kind, arguments, parameters, .. } => Ok(AlongData::Scalar(ScalarData {
                kind: kind.ok_or_else(|| missing("kind"))?,
                arguments: arguments.ok_or_else(|| missing("arguments"))?,
                parameters: parameters.unwrap_or_default(),
            })),
        }
    }
}

/// An energy, a length or an angle, in the form of a constraint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ScalarData {
    /// The name of the function.
    pub kind: String,
    /// The bodies and coordinates, in the order of the signature.
    pub arguments: Vec<ArgumentData>,
    /// The parameters by name.
    #[serde(default, deserialize_with = "once::object")]
    pub parameters: Map<String, Value>,
}

/// A mass at a point that depends on coordinates.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct PointMassData {
    /// The name.
    pub name: String,
    /// The point: a constraint of two or three rows, whose values are its global coordinates.
    pub point: ScalarData,
    /// The mass.
    pub mass: NumberData,
}

/// A function of a length or an angle, its derivative and time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct FormulaData {
    /// The name of the function.
    pub kind: String,
    /// The parameters by name.
    #[serde(default, deserialize_with = "once::object")]
    pub parameters: Map<String, Value>,
}

/// Dry friction in a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct FrictionData {
    /// The name of the joint.
    pub joint: String,
    /// The coefficient of friction.
    pub coefficient: NumberData,
    /// The slip velocity v₀ or ω₀, at which the friction has three quarters of its full size.
    pub rate: NumberData,
    /// The geometry: a pin or a slide.
    #[serde(flatten)]
    pub shape: FrictionShape,
}

/// The geometry of a pin or a slide.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum FrictionShape {
    /// A pin.
    Pin {
        /// The radius.
        radius: NumberData,
        /// The length of the bearing; 0 for a short one.
        #[serde(default = "none", skip_serializing_if = "is_zero")]
        length: NumberData,
    },
    /// A slide.
    Slide {
        /// The length of the guide.
        length: NumberData,
        /// The width of the guide.
        width: NumberData,
    },
}

fn is_zero(x: &NumberData) -> bool {
    *x == NumberData::Number(0.0)
}

fn none() -> NumberData {
    NumberData::Number(0.0)
}

fn at_origin() -> [NumberData; 3] {
    [none(), none(), none()]
}
