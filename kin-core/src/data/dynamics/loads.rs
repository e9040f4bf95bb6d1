//! Reads and writes loads as data: energies, forces along a length or an angle, forces on a body,
//! friction in joints, points with mass.

use serde_json::Value;

use super::format::{
    ActingData, AlongData, FormulaData, FrictionData, FrictionShape, LoadData, MeasureData,
    PointMassData, ScalarData,
};
use crate::coordinates::Target;
use crate::coordinates::layout::Place;
use crate::data::dimension::{NumberData, Texts};
use crate::data::format::{ArgumentData, ConstraintData};
use crate::data::law::LawData;
use crate::data::names::plain;
use crate::data::registry::{Made, Registry};
use crate::dimensions::{Beside, Dimension, Holder};
use crate::law::Law;
use crate::model::constraint::Constraint;
use crate::model::describer::Describer;
use crate::model::loads::{
    Acting, Along, ForceAlong, Friction, Holding, HungInLoad, Line, Load, OnBody, Shape,
};
use crate::model::mechanism::Mechanism;
use crate::outcome::error::surface::Surface;
use crate::outcome::error::{Error, Result};
use crate::outcome::similar;

/// The equations that the file must contain as text, by their kinds.
pub(in crate::data) type Carried = Vec<(String, String)>;

impl Mechanism {
    /// Returns the loads as data, and adds user-defined equations to those in the file. Errors: a
    /// load whose formula only the program knows.
    pub(in crate::data) fn load_data(
        &self,
        texts: &Texts,
        carried: &mut Carried,
    ) -> Result<Vec<LoadData>> {
        let loads = self.loads.loads.iter().enumerate();
        loads
            .map(|(number, (name, load))| self.one_load((number, name), load, texts, carried))
            .collect()
    }

    /// Returns the points with mass as data, and adds user-defined equations to those in the file.
    /// Errors: a point whose formula only the program knows.
    pub(in crate::data) fn point_mass_data(
        &self,
        texts: &Texts,
        carried: &mut Carried,
    ) -> Result<Vec<PointMassData>> {
        let data = |(k, (name, point, mass)): (usize, &(String, Box<dyn Constraint>, f64))| {
            let (mut data, equation) = self.constraint_data(name, point.as_ref())?;
            texts.put(Holder::Point(k), point.as_ref(), &mut data.parameters);
            carry(&format!("point mass `{name}`"), &data.kind, equation, carried)?;
            let [mass] = texts.beside(&Beside::PointMass(k), ["mass"], [*mass]);
            Ok(PointMassData { name: name.clone(), point: data.into(), mass })
        };
        self.loads.points.iter().enumerate().map(data).collect()
    }

    /// Adds points with mass from data. Errors: those of [`Mechanism::point_mass`].
    pub(in crate::data) fn take_point_masses(
        &mut self,
        points: &[PointMassData],
        registry: &Registry,
    ) -> Result<()> {
        for PointMassData { name, point, mass } in points {
            plain("point mass", name)?;
            let place = format!("point mass `{name}`");
            let mass = self.number(&place, mass)?;
            let made =
                self.scalar(point, registry).map_err(|reason| Error::Data { place, reason })?;
            self.point_mass_bound(name, made, mass)?;
        }
        Ok(())
    }

    /// Returns the friction in joints as data.
    pub(in crate::data) fn friction_data(&self, texts: &Texts) -> Vec<FrictionData> {
        let data = |(joint, friction): &(String, Friction)| {
            let mut values = [friction.coefficient, friction.rate, 0.0, 0.0];
            (values[2], values[3]) = match friction.shape {
                Shape::Pin { radius, length } => (radius, length),
                Shape::Slide { length, width } => (length, width),
            };
            let of = Beside::Friction(joint.clone());
            let [coefficient, rate, first, second] = texts.beside(&of, friction.names(), values);
            let shape = match friction.shape {
                Shape::Pin { .. } => FrictionShape::Pin { radius: first, length: second },
                Shape::Slide { .. } => FrictionShape::Slide { length: first, width: second },
            };
            FrictionData { joint: joint.clone(), coefficient, rate, shape }
        };
        self.loads.frictions.iter().map(data).collect()
    }

    /// Adds friction from data. Errors: those of [`Mechanism::friction`].
    pub(in crate::data) fn take_frictions(&mut self, frictions: &[FrictionData]) -> Result<()> {
        for FrictionData { joint, coefficient, rate, shape } in frictions {
            let place = format!("friction of `{joint}`");
            let number = |number: &NumberData| self.number(&place, number);
            let coefficient = number(coefficient)?;
            let rate = number(rate)?;
            let friction = match shape {
                FrictionShape::Pin { radius, length } => {
                    Friction::pin(coefficient, number(radius)?, rate).length(number(length)?)
                }
                FrictionShape::Slide { length, width } => {
                    Friction::slide(coefficient, [number(length)?, number(width)?], rate)
                }
            };
            self.friction(joint, friction)?;
        }
        Ok(())
    }

    fn one_load(
        &self,
        (load, name): (usize, &str),
        of: &Load,
        texts: &Texts,
        carried: &mut Carried,
    ) -> Result<LoadData> {
        let mut all = Vec::new();
        of.parts(&mut |part| all.push(part));
        let parts = all.into_iter().enumerate();
        let parts = parts
            .map(|(part, acting)| self.acting_data(name, ((load, part), acting), texts, carried));
        Ok(LoadData { name: name.to_string(), parts: parts.collect::<Result<_>>()? })
    }

    fn acting_data(
        &self,
        name: &str,
        ((load, part), acting): ((usize, usize), &Acting),
        texts: &Texts,
        carried: &mut Carried,
    ) -> Result<ActingData> {
        let fail = |reason: &str| Error::Data {
            place: format!("load `{name}`"),
            reason: reason.to_string(),
        };
        let mut scalar = |constraint: &dyn Constraint| -> Result<ScalarData> {
            let (mut data, equation) = self.constraint_data(name, constraint)?;
            texts.put(Holder::Load { load, part }, constraint, &mut data.parameters);
            carry(&format!("load `{name}`"), &data.kind, equation, carried)?;
            Ok(data.into())
        };
        match acting {
            Acting::Potential(energy) => Ok(ActingData::Energy(scalar(energy.as_ref())?)),
            Acting::Along(_, ForceAlong::Closure(_)) => Err(fail(&format!(
                "its force is a closure, which no file can store. Write it as {}",
                Surface::chosen().readable_force()
            ))),
            Acting::Along(x, ForceAlong::Written(force)) => {
                let x = match &x.0 {
                    Line::Row(x) => AlongData::Scalar(scalar(x.as_ref())?),
                    Line::Named(name) => AlongData::Measure(MeasureData { measure: name.clone() }),
                };
                let mut describer = Describer::default();
                force.describe(&mut describer);
                if let Some(reason) = &describer.refusal {
                    return Err(fail(reason));
                }
                let kind = force.facts().kind.to_string();
                carry(&format!("load `{name}`"), &kind, describer.equation(), carried)?;
                let mut parameters = describer.parameters;
                texts.put(Holder::Force { load, part }, force.as_ref(), &mut parameters);
                Ok(ActingData::Along { x, force: FormulaData { kind, parameters } })
            }
            Acting::OnBody(on) => {
                let of = Beside::OnBody { load, part };
                self.on_body_data(on, &of, texts).ok_or_else(|| fail("a body of another mechanism"))
            }
            Acting::Sum(_) => Err(fail("a sum in a sum")),
        }
    }

    fn on_body_data(&self, on: &OnBody, of: &Beside, texts: &Texts) -> Option<ActingData> {
        let Some(Place::Own { item, .. }) = self.layout.place(&on.target) else { return None };
        let none = LawData::of(&Law::constant(0.0));
        let laws = |name: &str, laws: &[Law; 3]| -> Option<Box<[Value; 3]>> {
            let mut names = ["x", "y", "z"].into_iter();
            let hangs = |law: &Law| {
                let mut hangs = false;
                law.each_hung(&mut |_, _| hangs = true);
                hangs
            };
            if !laws.iter().any(|law| LawData::of(law) != none || hangs(law)) {
                return None;
            }
            Some(Box::new(laws.each_ref().map(|law| {
                let mut data = serde_json::to_value(LawData::of(law)).unwrap_or_default();
                texts.put_law(
                    of,
                    &format!("{name}.{}", names.next().unwrap_or_default()),
                    &mut data,
                );
                data
            })))
        };
        let body = self.layout.items.get(item)?.name.clone();
        let force = laws("force", &on.force);
        let torque = laws("torque", &on.torque);
        let point = texts.beside(of, ["point.x", "point.y", "point.z"], on.point);
        Some(ActingData::OnBody { body, point, force, torque, in_body: on.fixed })
    }

    /// Adds loads from data. Errors: those of [`Mechanism::add_load_data`].
    pub(in crate::data) fn take_loads(
        &mut self,
        loads: &[LoadData],
        registry: &Registry,
    ) -> Result<()> {
        loads.iter().try_for_each(|load| self.add_load_data(load, registry))
    }

    /// Adds a load from data to bodies of this mechanism.
    ///
    /// The registry creates the parts of the load.
    ///
    /// Errors: the kind is unknown; a body or parameter is missing or of another kind; the load has
    /// no parts; those of [`Mechanism::load`].
    pub fn add_load_data(
        &mut self,
        LoadData { name, parts }: &LoadData,
        registry: &Registry,
    ) -> Result<()> {
        plain("load", name)?;
        let (mut made, mut bound): (Vec<Load>, Vec<HungInLoad>) = Default::default();
        for (part, data) in parts.iter().enumerate() {
            let mut note = |holding: Holding, own: Vec<(String, Dimension)>| {
                bound.extend(own.into_iter().map(|(name, number)| (part, holding, name, number)));
            };
            let acting = self.acting(data, registry, &mut note);
            let fail = |reason| Error::Data { place: format!("load `{name}`"), reason };
            made.push(Load(acting.map_err(fail)?));
        }
        let mut made = made.into_iter();
        let first = made.next().ok_or(Error::EmptyName { what: "load" })?;
        let mut load = made.fold(first, Load::and);
        bound.extend(load.take_bindings());
        self.load_bound(name, load, bound)
    }

    fn acting(
        &self,
        data: &ActingData,
        registry: &Registry,
        note: &mut dyn FnMut(Holding, Vec<(String, Dimension)>),
    ) -> std::result::Result<Acting, String> {
        match data {
            ActingData::Energy(energy) => {
                let (energy, bound) = self.scalar(energy, registry)?;
                note(Holding::Scalar, bound);
                Ok(Acting::Potential(energy))
            }
            ActingData::Along { x, force } => {
                // x and its derivative are no coordinates of the mechanism.
                let given = |n: usize| vec![ArgumentData::GroundCoord(0); n];
                let takes = if registry.knows(&force.kind, &given(2)) { 2 } else { 1 };
                let x = Along(match x {
                    AlongData::Scalar(x) => {
                        let (x, bound) = self.scalar(x, registry)?;
                        note(Holding::Scalar, bound);
                        Line::Row(x)
                    }
                    AlongData::Measure(MeasureData { measure }) => Line::Named(measure.clone()),
                });
                let (force, bound) = self.scalar(&force.of(given(takes)), registry)?;
                note(Holding::Force, bound);
                Ok(Acting::Along(x, ForceAlong::Written(force)))
            }
            ActingData::OnBody { body, point, force, torque, in_body } => {
                let target = self.layout.bodies().into_iter().find(|(known, _)| known == body);
                let (_, target) = target.ok_or_else(|| {
                    let bodies = self.layout.bodies().into_iter();
                    let bodies = bodies.filter(|(_, of)| !matches!(of, Target::Coord(..)));
                    let known: Vec<String> = bodies.map(|(known, _)| known.to_string()).collect();
                    format!("no body `{body}`{}", similar::cure(body, &known))
                })?;
                if matches!(target, Target::Coord(..)) {
                    return Err(format!("`{body}` is no body: a force along it is `along`"));
                }
                let mut on = OnBody::on(target, *in_body);
                for (name, laws, to) in
                    [("force", force, &mut on.force), ("torque", torque, &mut on.torque)]
                {
                    for (law, to) in laws.iter().flat_map(|laws| laws.iter()).zip(to) {
                        *to = self
                            .law(law, registry)
                            .map_err(|error| format!("its {name}: {error}"))?;
                    }
                }
                let number = |number: &NumberData| match number {
                    NumberData::Number(x) => Ok((*x).into()),
                    NumberData::Expression(text) => self.read_expression(text),
                };
                let [x, y, z] = point;
                on.at([number(x)?, number(y)?, number(z)?]);
                Ok(Acting::OnBody(Box::new(on)))
            }
        }
    }

    /// Returns the constraint that a registry creates from the data, with its parameters that
    /// depend on dimensions.
    fn scalar(
        &self,
        ScalarData { kind, arguments, parameters }: &ScalarData,
        registry: &Registry,
    ) -> std::result::Result<Made, String> {
        registry.constraint(kind, arguments, parameters, self)
    }
}

/// Records an equation that the file must contain. Errors: another equation has the same name.
pub(in crate::data) fn carry(
    place: &str,
    kind: &str,
    equation: Option<String>,
    carried: &mut Carried,
) -> Result<()> {
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
    /// Returns the function with these arguments.
    fn of(&self, arguments: Vec<ArgumentData>) -> ScalarData {
        ScalarData { kind: self.kind.clone(), arguments, parameters: self.parameters.clone() }
    }
}

/// The data of a constraint contain those of a scalar.
impl From<ConstraintData> for ScalarData {
    fn from(data: ConstraintData) -> Self {
        ScalarData { kind: data.kind, arguments: data.arguments, parameters: data.parameters }
    }
}
