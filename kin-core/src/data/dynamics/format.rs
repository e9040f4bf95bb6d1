//! The format of loads in mechanism files.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::data::dimensions::NumberData;
use crate::data::format::ArgumentData;
use crate::data::once;

/// A load: what acts together under one name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct LoadData {
    /// Its name.
    pub name: String,
    /// The parts of it.
    pub parts: Vec<ActingData>,
}

/// Something that acts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum ActingData {
    /// An energy, of which the generalised forces are −V_q.
    Energy(ScalarData),
    /// A force along a length or an angle x.
    Along {
        /// The length or angle.
        x: AlongData,
        /// The force: a function of x, its rate and time.
        force: FormulaData,
    },
    /// A force at a point of a body, and a torque on it.
    OnBody {
        /// Name of the body.
        body: String,
        /// The point in the body's frame; z is 0 in a plane.
        #[serde(default = "at_origin")]
        point: [NumberData; 3],
        /// Components of the force: laws of time. None is no force.
        #[serde(
            default,
            skip_serializing_if = "Option::is_none",
            deserialize_with = "once::three"
        )]
        force: Option<Box<[Value; 3]>>,
        /// Components of the torque; in a plane the last one counts.
        #[serde(
            default,
            skip_serializing_if = "Option::is_none",
            deserialize_with = "once::three"
        )]
        torque: Option<Box<[Value; 3]>>,
        /// True if components are in the body's axes.
        #[serde(default)]
        in_body: bool,
    },
}

/// A length or an angle that a force acts along.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
#[non_exhaustive]
pub enum AlongData {
    /// The value of a constraint of one row.
    Scalar(ScalarData),
    /// A measure of a joint or a coordinate.
    Measure(MeasureData),
}

/// A measure of a joint or a coordinate, by its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct MeasureData {
    /// Its name, such as `guide.slide`.
    pub measure: String,
}

/// By the key `measure`, so that a mistake in either form is told as one in it.
impl<'de> Deserialize<'de> for AlongData {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> std::result::Result<Self, D::Error> {
        let all = once::value(from)?;
        let read = match all.get("measure") {
            Some(_) => MeasureData::deserialize(all).map(AlongData::Measure),
            None => ScalarData::deserialize(all).map(AlongData::Scalar),
        };
        read.map_err(serde::de::Error::custom)
    }
}

/// An energy, a length or an angle: like a constraint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ScalarData {
    /// Name of its function.
    pub kind: String,
    /// The bodies and coordinates that it is made of, in the order of its signature.
    pub arguments: Vec<ArgumentData>,
    /// Its parameters by name.
    #[serde(default, deserialize_with = "once::object")]
    pub parameters: Map<String, Value>,
}

/// A mass at a point that moves with coordinates.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct PointMassData {
    /// Its name.
    pub name: String,
    /// The point: a constraint of two or three rows, whose values are its global coordinates.
    pub point: ScalarData,
    /// Its mass.
    pub mass: NumberData,
}

/// A function of a length or an angle, its rate and time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct FormulaData {
    /// Name of its function.
    pub kind: String,
    /// Its parameters by name.
    #[serde(default, deserialize_with = "once::object")]
    pub parameters: Map<String, Value>,
}

/// Dry friction in a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct FrictionData {
    /// Name of the joint.
    pub joint: String,
    /// The coefficient.
    pub coefficient: NumberData,
    /// The rate of the slip at which it sets in: an angle or a length per time.
    pub rate: NumberData,
    /// The pin or slide that rubs.
    #[serde(flatten)]
    pub shape: FrictionShape,
}

/// A pin or a slide.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum FrictionShape {
    /// A pin.
    Pin {
        /// Its radius.
        radius: NumberData,
        /// The length of its bearing; 0 where it is short.
        #[serde(default = "none", skip_serializing_if = "is_zero")]
        length: NumberData,
    },
    /// A slide.
    Slide {
        /// The length of its guide.
        length: NumberData,
        /// The width of its guide.
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
