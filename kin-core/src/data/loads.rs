//! Loads as data: energies, forces along a length or an angle, forces on a body, friction in joints, points
//! with mass.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::format::{ArgumentData, ConstraintData};
use super::law::LawData;
use super::names::plain;
use super::registry::Registry;
use crate::model::constraint::Constraint;
use crate::model::coordinates::Target;
use crate::model::describer::Describer;
use crate::model::error::{Error, Result};
use crate::model::law::Law;
use crate::model::layout::Place;
use crate::model::loads::{Acting, ForceAlong, Friction, Load, OnBody, Shape};
use crate::model::mechanism::Mechanism;

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
        /// The length or angle: a constraint of one row, whose value it is.
        x: ScalarData,
        /// The force: a function of x, its rate and time.
        force: FormulaData,
    },
    /// A force at a point of a body, and a torque on it.
    OnBody {
        /// Name of the body.
        body: String,
        /// The point in the body's frame; z is 0 in a plane.
        #[serde(default)]
        point: [f64; 3],
        /// Components of the force: laws of time. None is no force.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        force: Option<Box<[LawData; 3]>>,
        /// Components of the torque; in a plane the last one counts.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        torque: Option<Box<[LawData; 3]>>,
        /// True if components are in the body's axes.
        #[serde(default)]
        in_body: bool,
    },
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
    #[serde(default)]
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
    pub mass: f64,
}

/// A function of a length or an angle, its rate and time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct FormulaData {
    /// Name of its function.
    pub kind: String,
    /// Its parameters by name.
    #[serde(default)]
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
    pub coefficient: f64,
    /// The rate of the slip at which it sets in: an angle or a length per time.
    pub rate: f64,
    /// The pin or slide that rubs.
    #[serde(flatten)]
    pub shape: FrictionShape,
}

/// A pin or a slide.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum FrictionShape {
    /// A pin.
    Pin {
        /// Its radius.
        radius: f64,
        /// The length of its bearing; 0 where it is short.
        #[serde(default, skip_serializing_if = "is_zero")]
        length: f64,
    },
    /// A slide.
    Slide {
        /// The length of its guide.
        length: f64,
        /// The width of its guide.
        width: f64,
    },
}

fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

/// Equations that the file has to carry as text, by their kinds.
pub(super) type Carried = Vec<(String, String)>;

impl Mechanism {
    /// Loads as data; equations of one's own are added to those that the file carries. Errors: a load that
    /// only the program knows.
    pub(super) fn load_data(&self, carried: &mut Carried) -> Result<Vec<LoadData>> {
        self.loads.loads.iter().map(|(name, load)| self.one_load(name, load, carried)).collect()
    }

    /// Points with mass as data; equations of one's own are added to those that the file carries. Errors: a
    /// point that only the program knows.
    pub(super) fn point_mass_data(&self, carried: &mut Carried) -> Result<Vec<PointMassData>> {
        let data = |(name, point, mass): &(String, Box<dyn Constraint>, f64)| {
            let (data, equation) = self.constraint_data(name, point.as_ref())?;
            carry(&format!("point mass `{name}`"), &data.kind, equation, carried)?;
            Ok(PointMassData { name: name.clone(), point: data.into(), mass: *mass })
        };
        self.loads.points.iter().map(data).collect()
    }

    /// Takes points with mass from data. Errors: those of [`Mechanism::point_mass`].
    pub(super) fn take_point_masses(&mut self, points: &[PointMassData], registry: &Registry) -> Result<()> {
        for PointMassData { name, point, mass } in points {
            plain("point mass", name)?;
            let made = self.plain_scalar(point, registry);
            let place = || format!("point mass `{name}`");
            let point = made.map_err(|reason| Error::Data { place: place(), reason })?;
            self.point_mass(name, point, *mass)?;
        }
        Ok(())
    }

    /// Friction in joints as data.
    pub(super) fn friction_data(&self) -> Vec<FrictionData> {
        let data = |(joint, friction): &(String, Friction)| FrictionData {
            joint: joint.clone(),
            coefficient: friction.coefficient,
            rate: friction.rate,
            shape: match friction.shape {
                Shape::Pin { radius, length } => FrictionShape::Pin { radius, length },
                Shape::Slide { length, width } => FrictionShape::Slide { length, width },
            },
        };
        self.loads.frictions.iter().map(data).collect()
    }

    /// Takes friction from data. Errors: those of [`Mechanism::friction`].
    pub(super) fn take_frictions(&mut self, frictions: &[FrictionData]) -> Result<()> {
        for FrictionData { joint, coefficient, rate, shape } in frictions {
            let friction = match *shape {
                FrictionShape::Pin { radius, length } => {
                    Friction::pin(*coefficient, radius, *rate).length(length)
                }
                FrictionShape::Slide { length, width } => {
                    Friction::slide(*coefficient, [length, width], *rate)
                }
            };
            self.friction(joint, friction)?;
        }
        Ok(())
    }

    fn one_load(&self, name: &str, load: &Load, carried: &mut Carried) -> Result<LoadData> {
        let mut all = Vec::new();
        load.parts(&mut |part| all.push(part));
        let parts = all.into_iter().map(|part| self.acting_data(name, part, carried));
        Ok(LoadData { name: name.to_string(), parts: parts.collect::<Result<_>>()? })
    }

    fn acting_data(&self, name: &str, part: &Acting, carried: &mut Carried) -> Result<ActingData> {
        let fail = |reason: &str| Error::Data { place: format!("load `{name}`"), reason: reason.to_string() };
        let mut scalar = |constraint: &dyn Constraint| -> Result<ScalarData> {
            let (data, equation) = self.constraint_data(name, constraint)?;
            carry(&format!("load `{name}`"), &data.kind, equation, carried)?;
            Ok(data.into())
        };
        match part {
            Acting::Potential(energy) => Ok(ActingData::Energy(scalar(energy.as_ref())?)),
            Acting::Along(_, ForceAlong::Closure(_)) => Err(fail(
                "its force is a closure, which no file can carry: write it as a function with `#[force]`",
            )),
            Acting::Along(x, ForceAlong::Written(force)) => {
                let x = scalar(x.as_ref())?;
                let mut describer = Describer::default();
                force.describe(&mut describer);
                if let Some(reason) = &describer.refusal {
                    return Err(fail(reason));
                }
                let kind = force.facts().kind.to_string();
                carry(&format!("load `{name}`"), &kind, describer.equation(), carried)?;
                let force = FormulaData { kind, parameters: describer.parameters };
                Ok(ActingData::Along { x, force })
            }
            Acting::OnBody(on) => self.on_body_data(on).ok_or_else(|| fail("a body of another mechanism")),
            Acting::Sum(_) => Err(fail("a sum in a sum")),
        }
    }

    fn on_body_data(&self, on: &OnBody) -> Option<ActingData> {
        let Some(Place::Own { item, .. }) = self.layout.place(&on.target) else { return None };
        let none = LawData::of(&Law::constant(0.0));
        let laws = |laws: &[Law; 3]| {
            let laws = laws.each_ref().map(LawData::of);
            laws.iter().any(|law| *law != none).then(|| Box::new(laws))
        };
        let body = self.layout.items.get(item)?.name.clone();
        let (force, torque) = (laws(&on.force), laws(&on.torque));
        Some(ActingData::OnBody { body, point: on.point, force, torque, in_body: on.fixed })
    }

    /// Takes loads from data. Errors: those of [`Mechanism::add_load_data`].
    pub(super) fn take_loads(&mut self, loads: &[LoadData], registry: &Registry) -> Result<()> {
        loads.iter().try_for_each(|load| self.add_load_data(load, registry))
    }

    /// Adds the load that the data say, made by the registry, on bodies of this mechanism.
    ///
    /// Errors: an unknown kind, a body or parameter that is missing or of another kind, no parts, and those
    /// of [`Mechanism::load`].
    pub fn add_load_data(&mut self, LoadData { name, parts }: &LoadData, registry: &Registry) -> Result<()> {
        plain("load", name)?;
        let parts = parts.iter().map(|part| self.acting(part, registry).map(Load));
        let parts = parts.collect::<std::result::Result<Vec<Load>, String>>();
        let mut parts =
            parts.map_err(|reason| Error::Data { place: format!("load `{name}`"), reason })?.into_iter();
        let first = parts.next().ok_or(Error::EmptyName { what: "load" })?;
        self.load(name, parts.fold(first, Load::and))
    }

    fn acting(&self, data: &ActingData, registry: &Registry) -> std::result::Result<Acting, String> {
        let scalar = |data: &ScalarData| self.plain_scalar(data, registry);
        match data {
            ActingData::Energy(energy) => Ok(Acting::Potential(scalar(energy)?)),
            ActingData::Along { x, force } => {
                // Its x and its rate stand for no coordinate of the mechanism.
                let given = |n: usize| vec![ArgumentData::GroundCoord(0); n];
                let made = |n: usize| self.plain_scalar(&force.of(given(n)), registry);
                let takes = if registry.knows(&force.kind, &given(2)) { 2 } else { 1 };
                Ok(Acting::Along(scalar(x)?, ForceAlong::Written(made(takes)?)))
            }
            ActingData::OnBody { body, point, force, torque, in_body } => {
                let target = self.layout.bodies().into_iter().find(|(known, _)| known == body);
                let (_, target) = target.ok_or_else(|| format!("no body `{body}`"))?;
                if matches!(target, Target::Coord(..)) {
                    return Err(format!("`{body}` is no body: a force along it is `along`"));
                }
                let laws = |laws: &Option<Box<[LawData; 3]>>| match laws.as_deref() {
                    Some([x, y, z]) => Ok([registry.law(x)?, registry.law(y)?, registry.law(z)?]),
                    None => Ok::<_, String>([(); 3].map(|()| Law::constant(0.0))),
                };
                let (force, torque) = (laws(force)?, laws(torque)?);
                Ok(Acting::OnBody(OnBody { target, point: *point, force, torque, fixed: *in_body }))
            }
        }
    }

    /// The constraint that a registry makes of such data, without dimensions.
    pub(super) fn plain_scalar(
        &self,
        ScalarData { kind, arguments, parameters }: &ScalarData,
        registry: &Registry,
    ) -> std::result::Result<Box<dyn Constraint>, String> {
        let (made, hung) = registry.constraint(kind, arguments, parameters, self)?;
        match hung.first() {
            None => Ok(made),
            Some((name, _)) => {
                Err(format!("its `{name}` hangs on a dimension: numbers of loads and masses do not"))
            }
        }
    }
}

/// Notes an equation that the file has to carry. Errors: another one of the same name.
pub(super) fn carry(place: &str, kind: &str, equation: Option<String>, carried: &mut Carried) -> Result<()> {
    let Some(text) = equation else { return Ok(()) };
    match carried.iter().find(|(known, _)| known == kind) {
        Some((_, known)) if *known != text => {
            let reason = format!("there is another equation `{kind}`: give it another name");
            Err(Error::Data { place: place.to_string(), reason })
        }
        Some(_) => Ok(()),
        None => {
            carried.push((kind.to_string(), text));
            Ok(())
        }
    }
}

impl FormulaData {
    /// The function of these coordinates.
    fn of(&self, arguments: Vec<ArgumentData>) -> ScalarData {
        ScalarData { kind: self.kind.clone(), arguments, parameters: self.parameters.clone() }
    }
}

/// A constraint's data are those of a scalar and more.
impl From<ConstraintData> for ScalarData {
    fn from(data: ConstraintData) -> Self {
        ScalarData { kind: data.kind, arguments: data.arguments, parameters: data.parameters }
    }
}
