//! Writes a mechanism as data, and creates a mechanism from data.

use std::path::Path;

use super::dimension::{NumberData, Texts, law_without_expressions};
use super::dynamics::{Carried, carry};
use super::format::{
    ArgumentData, BodyData, ConstraintData, LimitData, MechanismData, PreferredData,
};
use super::law::LawData;
use super::names::plain;
use super::{FORMAT, Registry, read, understood};
use crate::coordinates::layout::{Kind, Place};
use crate::coordinates::units::Units;
use crate::coordinates::{Coordinate, PlanarBody, SpatialBody, Target};
use crate::dimensions::{Bound, Dimension, Holder};
use crate::law::Law;
use crate::model::constraint::Constraint;
use crate::model::describer::Describer;
use crate::model::mechanism::place::{self, between};
use crate::model::mechanism::{ConstraintId, Limit, Mechanism, SpatialPose};
use crate::outcome::error::{Error, Result};

impl Mechanism {
    /// Writes the mechanism as a self-contained JSON file and creates missing folders.
    ///
    /// Any program that reads equations as text can load the file.
    ///
    /// Errors: Kin cannot describe a constraint; the equation of a constraint uses a definition
    /// that the file cannot contain; Kin cannot write the file. The error names the constraint or
    /// the file.
    pub fn write_json(&self, path: impl AsRef<Path>) -> Result<()> {
        self.write_json_for(path, &Registry::new())
    }

    /// Writes the mechanism as a JSON file for programs with this registry.
    ///
    /// The file does not contain the text of the constraints that the registry knows.
    pub fn write_json_for(&self, path: impl AsRef<Path>, registry: &Registry) -> Result<()> {
        let data = self.data()?;
        data.is_readable(registry)?;
        super::write(path.as_ref(), &data)
    }

    /// Returns the mechanism as data for serde.
    ///
    /// Errors: a constraint is hand-written; a parameter of a constraint has a type that serde does
    /// not support. The error names the constraint.
    pub fn data(&self) -> Result<MechanismData> {
        let texts = Texts::of(self)?;
        let bodies = self.body_data(&texts);
        let mut equations = Carried::new();
        let constraints =
            self.constraints.iter().enumerate().map(|(number, (name, constraint))| {
                let (mut data, equation) = self.constraint_data(name, constraint.as_ref())?;
                texts.put(Holder::Constraint(number), constraint.as_ref(), &mut data.parameters);
                carry(&format!("constraint `{name}`"), &data.kind, equation, &mut equations)?;
                Ok(data)
            });
        let constraints = constraints.collect::<Result<_>>()?;
        let end = |x: f64| Some(x).filter(|x| x.is_finite());
        let limit = |Limit { name, ends: [from, to] }: &Limit| LimitData {
            measure: name.clone(),
            from: end(*from),
            to: end(*to),
        };
        let limits = self.limits.iter().map(limit).collect();
        let units = self.layout.words.clone();
        let preferred = self.preferred_data(&texts);
        let (masses, gravity) = self.mass_data(&texts);
        let point_masses = self.point_mass_data(&texts, &mut equations)?;
        let loads = self.load_data(&texts, &mut equations)?;
        Ok(MechanismData {
            format: FORMAT,
            masses,
            point_masses,
            gravity,
            loads,
            frictions: self.friction_data(&texts),
            name: self.name.clone(),
            units,
            dimensions: self.dimension_data()?,
            equations: equations.into_iter().map(|(_, text)| text).collect(),
            bodies,
            constraints,
            limits,
            preferred,
        })
    }

    /// Returns the bodies and scalar coordinates as data.
    fn body_data(&self, texts: &Texts) -> Vec<BodyData> {
        let body = self.layout.items.iter().enumerate().map(|(index, item)| {
            let columns = item.first..item.first + item.kind.coordinates().len();
            let preference = |column: usize| {
                let own = self.preferred.iter().find(|(known, _)| *known == column);
                own.map(|(_, value)| texts.number(Bound::Preferred(column), *value))
            };
            let mut preferred: Vec<Option<NumberData>> = columns.clone().map(preference).collect();
            if preferred.iter().all(Option::is_none) {
                preferred.clear();
            }
            let link = self.layout.links.iter().position(|(known, _)| *known == index);
            let length =
                link.map(|link| texts.number(Bound::Length(link), self.layout.links[link].1));
            let guess =
                columns.map(|column| texts.number(Bound::Guess(column), self.initial[column]));
            BodyData {
                name: item.name.clone(),
                kind: item.kind.into(),
                guess: guess.collect(),
                preferred,
                length,
                between: texts.between(item.first),
                facing: texts.facing(item.first),
            }
        });
        body.collect()
    }

    /// Returns the preferred measures as data.
    fn preferred_data(&self, texts: &Texts) -> Vec<PreferredData> {
        let data = |(measure, value): &(String, f64)| PreferredData {
            measure: measure.clone(),
            value: texts.number(Bound::PreferredMeasure(measure.clone()), *value),
        };
        self.asked.iter().map(data).collect()
    }

    /// Returns a constraint as data, and its equation if the file must contain it.
    pub(super) fn constraint_data(
        &self,
        name: &str,
        constraint: &dyn Constraint,
    ) -> Result<(ConstraintData, Option<String>)> {
        let fail = |reason: String| Error::Data { place: format!("constraint `{name}`"), reason };
        let mut describer = Describer::default();
        constraint.describe(&mut describer);
        if let Some(reason) = describer.refusal {
            return Err(fail(reason));
        }
        let arguments = constraint
            .arguments()
            .iter()
            .map(|argument| self.argument_data(&argument.target))
            .collect::<Option<_>>();
        let arguments: Vec<ArgumentData> =
            arguments.ok_or_else(|| fail("a body of another mechanism".to_string()))?;
        if describer.is_own() {
            Registry::is_free(constraint.facts().kind, &arguments).map_err(fail)?;
        }
        let equation = describer.equation();
        let lacking = describer.lacking().to_vec();
        let data = ConstraintData {
            name: name.to_string(),
            kind: constraint.facts().kind.to_string(),
            arguments,
            parameters: describer.parameters,
            lacking,
        };
        Ok((data, equation))
    }

    fn argument_data(&self, target: &Target) -> Option<ArgumentData> {
        let name = |item: usize| self.layout.items.get(item).map(|item| item.name.clone());
        Some(match (target, self.layout.place(target)?) {
            (Target::Planar(_), Place::Ground(_)) => ArgumentData::Planar(None),
            (Target::Spatial(_), Place::Ground(_)) => ArgumentData::Spatial(None),
            (Target::Coord(Coordinate::Spatial(_, axis), _), Place::Ground(_)) => {
                ArgumentData::SpatialGroundCoord(*axis)
            }
            (Target::Coord(Coordinate::Planar(_, axis), _), Place::Ground(_)) => {
                ArgumentData::GroundCoord(*axis)
            }
            (Target::Coord(..), Place::Ground(_)) => return None,
            (Target::Planar(_), Place::Own { item, .. }) => ArgumentData::Planar(name(item)),
            (Target::Spatial(_), Place::Own { item, .. }) => ArgumentData::Spatial(name(item)),
            (Target::Coord(..), Place::Own { first, .. }) => {
                ArgumentData::Coord(self.layout.names.get(first)?.clone())
            }
        })
    }

    /// Creates a mechanism from data.
    ///
    /// The registry creates the constraints and laws of the mechanism.
    ///
    /// Errors: a kind is unknown; a body, parameter or number is missing or superfluous; those of
    /// [`Mechanism::add`].
    pub fn from_data(data: &MechanismData, registry: &Registry) -> Result<Mechanism> {
        let fail = |reason| Error::Data { place: format!("mechanism `{}`", data.name), reason };
        understood(data.format, FORMAT).map_err(fail)?;
        let mut mechanism = Mechanism::new(plain("mechanism", &data.name)?);
        mechanism.layout.words = read_units(&data.units)?;
        mechanism.declared = [!data.units.is_default(); 2];
        mechanism.add_dimensions(&data.dimensions)?;
        for body in &data.bodies {
            mechanism.add_body(body)?;
        }
        let registry = &registry.with_equations(&data.equations).map_err(fail)?;
        for constraint in &data.constraints {
            plain("constraint", &constraint.name)?;
            mechanism.add_data(constraint, registry)?;
        }
        for LimitData { measure, from, to } in &data.limits {
            mechanism.limit(
                measure,
                from.unwrap_or(f64::NEG_INFINITY),
                to.unwrap_or(f64::INFINITY),
            )?;
        }
        for PreferredData { measure, value } in &data.preferred {
            let value = mechanism.number(&format!("preferred `{measure}`"), value)?;
            mechanism.prefer(measure, value);
        }
        mechanism.take_masses(&data.masses, data.gravity.as_ref())?;
        mechanism.take_point_masses(&data.point_masses, registry)?;
        mechanism.take_loads(&data.loads, registry)?;
        mechanism.take_frictions(&data.frictions)?;
        Ok(mechanism)
    }

    /// Adds a constraint from data to bodies of this mechanism.
    ///
    /// The registry creates the constraint.
    ///
    /// Errors: the kind is unknown; a body or parameter is missing or of another kind; those of
    /// [`Mechanism::add`].
    pub fn add_data(&mut self, data: &ConstraintData, registry: &Registry) -> Result<ConstraintId> {
        let ConstraintData { name, kind, arguments, parameters, lacking } = data;
        let made = registry.constraint(kind, arguments, parameters, self);
        let (constraint, bound) = made.map_err(|reason| {
            let reason = if lacking.is_empty() { reason } else { without(&reason, lacking) };
            Error::Data { place: format!("constraint `{name}`"), reason }
        })?;
        self.add_bound(name, constraint, bound)
    }

    /// Creates a law from the data of a file: `{"kind": "ramp", "numbers": {"rate": "2 * w"}}`.
    ///
    /// A number can be an expression of this mechanism's dimensions.
    ///
    /// Errors: the data do not describe a law; the kind is unknown; a number is missing; Kin cannot
    /// read an expression.
    pub fn law(&self, data: &serde_json::Value, registry: &Registry) -> Result<Law> {
        let fail = |reason: String| Error::Data { place: "law".to_string(), reason };
        let (plain, bound) = law_without_expressions(self, data).map_err(fail)?;
        let data: LawData = read::value(&plain).map_err(fail)?;
        Ok(registry.law(&data).map_err(fail)?.hung_on(bound))
    }

    fn add_body(&mut self, body: &BodyData) -> Result<()> {
        let kind = Kind::from(body.kind);
        let place = format!("body `{}`", body.name);
        let count = kind.coordinates().len();
        let fail = |reason: String| Error::Data { place: place.clone(), reason };
        if body.guess.len() != count
            || !(body.preferred.is_empty() || body.preferred.len() == count)
        {
            return Err(fail(format!(
                "it has {count} coordinates; its guess has {}",
                body.guess.len()
            )));
        }
        let number = |number: &NumberData| self.number(&place, number);
        let numbers =
            |all: &[NumberData]| all.iter().map(number).collect::<Result<Vec<Dimension>>>();
        let guess = numbers(&body.guess)?;
        let length = body.length.as_ref().map(number).transpose()?;
        let mut preferred = Vec::new();
        for (axis, value) in body.preferred.iter().enumerate() {
            let Some(value) = value.as_ref().map(number).transpose()? else { continue };
            if !value.value().is_finite() {
                return Err(fail(format!("a preferred value is {}", value.value())));
            }
            preferred.push((axis, value));
        }
        let points =
            body.between.as_ref().map(|points| numbers(points.as_flattened())).transpose()?;
        let facing = body.facing.as_deref().map(numbers).transpose()?;
        let index = self.declare_hung(plain("body", &body.name)?, kind, &guess)?;
        let first = self.layout.items[index].first;
        for (axis, value) in preferred {
            self.prefer_one(first + axis, value)?;
        }
        if let Some(points) = points {
            let told = "`between` is two points in space that a spatial body is drawn between";
            let pose = between(points.iter().map(|x| x.value()));
            self.draw((&body.name, told), (kind, first), pose)?;
            self.hang_pose(&body.name, &points, |part| Bound::Between { first, part })?;
        }
        if let Some(facing) = facing {
            let told =
                "`facing` is where a spatial body is, and one or two directions that it faces";
            if !matches!(facing.len(), 6 | 9) {
                return Err(fail(told.to_string()));
            }
            let pose = place::facing(facing.iter().map(|x| x.value()));
            self.draw((&body.name, told), (kind, first), pose)?;
            self.hang_pose(&body.name, &facing, |part| Bound::Facing { first, part })?;
        }
        length.map_or(Ok(()), |length| self.note_length(&body.name, Some(index), length))
    }

    /// Draws a spatial body at a pose; `first` is its first coordinate. Errors: the data are no
    /// such pose.
    fn draw(
        &mut self,
        (name, told): (&str, &str),
        (kind, first): (Kind, usize),
        pose: SpatialPose,
    ) -> Result<()> {
        let pose = pose.coordinates().map(Dimension::value);
        if kind != Kind::Spatial || pose.iter().any(|x| !x.is_finite()) {
            return Err(Error::Data { place: format!("body `{name}`"), reason: told.to_string() });
        }
        self.initial[first..first + pose.len()].copy_from_slice(&pose);
        Ok(())
    }

    /// Returns the planar body with this name.
    pub fn planar_named(&self, name: &str) -> Option<PlanarBody> {
        self.target_named(name)
            .and_then(|target| if let Target::Planar(body) = target { Some(body) } else { None })
    }

    /// Returns the spatial body with this name.
    pub fn spatial_named(&self, name: &str) -> Option<SpatialBody> {
        self.target_named(name)
            .and_then(|target| if let Target::Spatial(body) = target { Some(body) } else { None })
    }

    fn target_named(&self, name: &str) -> Option<Target> {
        self.layout.bodies().into_iter().find(|(known, _)| *known == name).map(|(_, target)| target)
    }

    /// Returns the coordinate with this name: a scalar coordinate, or a coordinate of a body such
    /// as `crank.theta`.
    pub fn coordinate_named(&self, name: &str) -> Option<Coordinate> {
        let column = self.layout.names.iter().position(|known| known == name)?;
        let item = self.layout.owner(column)?;
        let axis = column - item.first;
        Some(match item.kind {
            Kind::Planar => Coordinate::Planar(self.planar_named(&item.name)?, axis),
            Kind::Spatial => Coordinate::Spatial(self.spatial_named(&item.name)?, axis),
            Kind::Angle | Kind::Length => {
                let index = self.layout.items.iter().position(|known| known.first == item.first)?;
                Coordinate::Own { mechanism: self.layout.mechanism, index }
            }
        })
    }
}

impl MechanismData {
    /// Returns an error for the first constraint with an incomplete equation that the registry does
    /// not know.
    pub(super) fn is_readable(&self, registry: &Registry) -> Result<()> {
        let unread = |constraint: &&ConstraintData| {
            !constraint.lacking.is_empty()
                && !registry.knows(&constraint.kind, &constraint.arguments)
        };
        let Some(ConstraintData { name, kind, lacking, .. }) = self.constraints.iter().find(unread)
        else {
            return Ok(());
        };
        let reason = format!(
            "a file cannot store its equation, which refers to {}. Move that into the equation, or write the file for readers that have `{kind}`, by `write_json_for(path, &Registry::new().with::<{kind}>())`",
            lacking.join(" and of ")
        );
        Err(Error::Data { place: format!("constraint `{name}`"), reason })
    }
}

/// Writes a reason, and why the file has no text of the equation.
fn without(reason: &str, lacking: &[String]) -> String {
    format!(
        "{reason}. The file does not contain its equation, which refers to {}",
        lacking.join(" and of ")
    )
}

/// Returns the units of a file. Errors: an empty name.
pub(super) fn read_units(units: &Units) -> Result<Units> {
    [units.length(), units.time(), units.mass()]
        .into_iter()
        .try_for_each(|word| plain("unit", word).map(|_| ()))?;
    units.missing().map_or(Ok(units.clone()), |what| Err(Error::EmptyName { what }))
}
