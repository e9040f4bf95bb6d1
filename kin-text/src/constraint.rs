//! Creates a constraint from text on the bodies of a mechanism.

use std::sync::Arc;

use kin::data::{Datum, Describer};
use kin::emitted::graph::{Dual3_64, Given, Table, give_law};
use kin::emitted::{Bindings, Numbers, Refuses, refusal};
use kin::extend::coordinates::{Argument, Coordinate, Target, Trig};
use kin::extend::state::{At, Rates};
use kin::extend::{Attached, Attachment, Facts, Parameters, Parts, RouteReason, Written};
use kin::{Axis, Constraint, Law, PlanarBody, SpatialBody, Vec3};
use kin_graph::Node;
use kin_language::parse::Shape;
use serde_json::Value;

use crate::equation::numbers_of;
use crate::read::{Asked, Condition, Read};
use crate::signature::ParameterKind;
use crate::stage::{Seen, Stage};

/// A constraint whose equation was read from text. [`crate::Equation::on`] creates such a
/// constraint.
#[derive(Clone)]
pub struct ReadConstraint {
    pub(crate) read: Arc<Read>,
    pub(crate) targets: Vec<Body>,
    pub(crate) numbers: Vec<f64>,
    pub(crate) laws: Vec<Law>,
    /// Parameters that hang on dimensions.
    pub(crate) bindings: Bindings,
}

/// The body or coordinate of an argument.
#[derive(Clone, Copy, Debug)]
pub enum Body {
    Planar(PlanarBody),
    Spatial(SpatialBody),
    Coord(Coordinate),
}

impl ReadConstraint {
    fn seen<'a>(&'a self, at: &'a At<'a>, rates: Option<&'a Rates<'a>>, t_dot: f64) -> Seen<'a> {
        let kinds = &self.read.signature.slots;
        Seen { at, rates, t_dot, kinds, parameters: &self.numbers, laws: &self.laws }
    }

    fn compute(&self, stage: &Stage, at: &At<'_>, to: &mut [f64]) {
        stage.compute(&self.seen(at, None, 1.0), to);
    }

    /// The value of something asked at an instant, with its derivatives along the rates.
    fn asked(&self, asked: &Asked, at: &At<'_>, rates: Option<&[Rates<'_>; 3]>) -> [f64; 4] {
        let outside =
            |number: usize, x: &[Dual3_64], to: &mut Given| self.give(asked, number, x, to);
        asked.table.measured(&self.arguments(), at, rates, &self.of(asked), &outside)
    }

    /// The parameters of something asked.
    fn of(&self, asked: &Asked) -> Vec<f64> {
        asked.numbers.iter().map(|&k| self.numbers[k]).collect()
    }

    fn give(&self, asked: &Asked, number: usize, x: &[Dual3_64], to: &mut Given) {
        if let Some(law) = asked.laws.get(number).and_then(|&k| self.laws.get(k)) {
            give_law(law, x, to);
        }
    }

    /// The first demand that does not hold.
    fn broken<'a>(
        &self,
        demands: &'a [(Condition, String)],
        at: &At<'_>,
    ) -> Option<&'a (Condition, String)> {
        demands.iter().find(|(condition, _)| !self.holds(condition, at))
    }

    fn holds(&self, condition: &Condition, at: &At<'_>) -> bool {
        match condition {
            Condition::NotZero(asked) => self.asked(asked, at, None)[0] != 0.0,
            Condition::Periodic(law, period) => {
                self.laws[*law].is_periodic(self.asked(period, at, None)[0])
            }
            Condition::Smooth(law) => self.laws[*law].is_smooth(),
        }
    }

    /// The text of a requirement that does not hold, and the numbers that it speaks of.
    fn refused(&self, (condition, text): &(Condition, String)) -> String {
        let Condition::NotZero(asked) = condition else { return text.clone() };
        let numbers = &self.read.signature.numbers;
        let shown = asked.numbers.iter().map(|&k| format!("{} = {}", numbers[k], self.numbers[k]));
        let shown: Vec<String> = shown.collect();
        if shown.is_empty() { text.clone() } else { format!("{text} ({})", shown.join(", ")) }
    }

    /// Returns the largest intermediate value of C, C_q, C_t and Q_d at an instant.
    ///
    /// The rounding errors of these terms are proportional to this value.
    pub fn largest(&self, at: &At<'_>, qd: &Rates<'_>, t_dot: f64) -> f64 {
        let read = &*self.read;
        let seen = self.seen(at, Some(qd), t_dot);
        let stages = [&read.values, &read.velocity, &read.acceleration];
        stages.into_iter().map(|stage| stage.largest(&seen)).fold(0.0, f64::max)
    }

    fn axis(&self, first: usize) -> Axis {
        let vector =
            |k: usize| Vec3::new(self.numbers[k], self.numbers[k + 1], self.numbers[k + 2]);
        Axis { h: vector(first), f: vector(first + 3), g: vector(first + 6) }
    }
}

/// The instant of which requirements are asked: they read no state and no time.
fn nowhere() -> At<'static> {
    At::new(0.0, &[], &[])
}

impl Constraint for ReadConstraint {
    fn facts(&self) -> Facts<'_> {
        let read = &*self.read;
        Facts {
            description: &read.description,
            reason: RouteReason::Read,
            is_driver: read.is_driver,
            rows: &read.rows,
            pattern: &read.pattern,
            constants: &read.constants,
            dependence: read.dependence,
            measures: &read.measures,
            has_branches: !read.branches.is_empty(),
            ..Facts::of(&read.name)
        }
    }

    fn arguments(&self) -> Vec<Argument> {
        let slots = self.read.signature.slots.iter().zip(&self.targets).enumerate();
        let target = |k: usize, body: &Body| match *body {
            Body::Planar(body) => Target::Planar(body),
            Body::Spatial(body) => Target::Spatial(body),
            Body::Coord(coordinate) => {
                let trig = if self.read.trig.contains(&k) { Trig::Used } else { Trig::Unused };
                Target::Coord(coordinate, trig)
            }
        };
        slots.map(|(k, ((name, _), body))| Argument { name, target: target(k, body) }).collect()
    }

    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        self.compute(&self.read.residual, at, c);
    }

    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]) {
        self.linearize(at, &mut vec![0.0; self.read.rows.len()], c_q);
    }

    fn linearize(&self, at: &At<'_>, c: &mut [f64], c_q: &mut [f64]) {
        let rows = c.iter_mut().take(self.read.rows.len());
        self.read.values.compute(&self.seen(at, None, 1.0), rows.chain(c_q));
    }

    fn velocity_rhs(&self, at: &At<'_>, rhs: &mut [f64]) {
        rhs.iter_mut().take(self.read.rows.len()).for_each(|place| *place = 0.0);
        self.compute(&self.read.velocity, at, rhs);
    }

    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
        self.read.acceleration.compute(&self.seen(at, Some(qd), t_dot), q_d);
    }

    fn measure(&self, k: usize, at: &At<'_>, rates: &[Rates<'_>; 3]) -> [f64; 4] {
        self.read
            .measured
            .get(k)
            .map_or([f64::NAN; 4], |(value, _)| self.asked(value, at, Some(rates)))
    }

    fn wrong_branch(&self, at: &At<'_>) -> Option<&str> {
        self.broken(&self.read.branches, at).map(|(_, text)| text.as_str())
    }

    fn parts(&self) -> Parts<'_> {
        Parts { parameters: Some(self), written: Some(self) }
    }

    fn parameters_mut(&mut self) -> Option<&mut dyn Parameters> {
        Some(self)
    }
}

impl Parameters for ReadConstraint {
    fn ends(&self, k: usize) -> Option<[f64; 2]> {
        let ends = self.read.measured.get(k)?.1.as_ref()?;
        Some(ends.each_ref().map(|end| self.asked(end, &nowhere(), None)[0]))
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        let signature = &self.read.signature;
        for parameter in &signature.parameters {
            match &parameter.kind {
                ParameterKind::Numbers { shape, first } => {
                    let all = signature.numbers.iter().zip(&self.numbers).skip(*first);
                    all.take(count(shape)).for_each(|(name, value)| visit(name, *value));
                }
                ParameterKind::Axis { first } => {
                    let all = signature.numbers.iter().zip(&self.numbers).skip(*first);
                    all.take(3).for_each(|(name, value)| visit(name, *value));
                }
                ParameterKind::Law(k) => {
                    let own = |name: &str, value: f64| {
                        visit(&format!("{}.{name}", parameter.name), value)
                    };
                    self.laws[*k].parameters(&mut { own });
                }
            }
        }
    }

    fn set_parameter(&mut self, name: &str, value: f64) -> bool {
        for parameter in &self.read.signature.parameters {
            let ParameterKind::Axis { first } = parameter.kind else { continue };
            let mut axis = self.axis(first);
            if axis.set(&parameter.name, name, value) {
                self.numbers[first..first + 9].copy_from_slice(&numbers_of(&axis));
                return true;
            }
        }
        if let Some(k) = self.read.signature.number(name) {
            self.numbers[k] = value;
            return true;
        }
        let Some((law, rest)) = name.split_once('.') else { return false };
        match self.read.signature.law(law) {
            Some(k) => self.laws[k].set_parameter(rest, value),
            None => false,
        }
    }

    fn set_law(&mut self, name: &str, law: &Law) -> bool {
        let Some(k) = self.read.signature.law(name) else { return false };
        self.laws[k] = law.clone();
        true
    }

    fn take_bindings(&mut self) -> Bindings {
        std::mem::take(&mut self.bindings)
    }

    fn refusal(&self) -> Option<String> {
        for parameter in &self.read.signature.parameters {
            let own: Box<dyn Refuses> = match parameter.kind {
                ParameterKind::Law(k) => Box::new(self.laws[k].clone()),
                ParameterKind::Axis { first } => Box::new(self.axis(first)),
                ParameterKind::Numbers { .. } => continue,
            };
            if let Some(why) = refusal(&[(&parameter.name, &*own)]) {
                return Some(why);
            }
        }
        self.broken(&self.read.requirements, &nowhere()).map(|demand| self.refused(demand))
    }

    fn describe(&self, to: &mut Describer) {
        for parameter in &self.read.signature.parameters {
            let value = match &parameter.kind {
                ParameterKind::Numbers { shape, first } => {
                    as_json(shape, &mut self.numbers[*first..].iter())
                }
                ParameterKind::Axis { first } => self.axis(*first).to_value(),
                ParameterKind::Law(k) => self.laws[*k].to_value(),
            };
            to.put_value(&parameter.name, value);
        }
        to.put_equation(self.read.text.as_str());
    }
}

impl Written for ReadConstraint {
    fn laws(&self, at: &At<'_>, visit: &mut dyn FnMut(&str, &Law, f64)) {
        let mut x = vec![0.0; self.read.asked_laws.len()];
        self.compute(&self.read.asked, at, &mut x);
        for (&number, x) in self.read.asked_laws.iter().zip(x) {
            let named =
                self.read.signature.parameters.iter().find(
                    |parameter| matches!(parameter.kind, ParameterKind::Law(k) if k == number),
                );
            if let (Some(parameter), Some(law)) = (named, self.laws.get(number)) {
                visit(&parameter.name, law, x);
            }
        }
    }

    fn attachments(&self) -> Vec<Attachment> {
        let all = &self.read.attachments;
        let mut numbers = vec![0.0; all.iter().map(|one| one.local.len()).sum()];
        self.compute(&self.read.local, &nowhere(), &mut numbers);
        let mut numbers = numbers.into_iter();
        let mut vector = |local: &[Node]| {
            let mut components = [0.0; 3];
            local
                .iter()
                .zip(&mut components)
                .for_each(|(_, place)| *place = numbers.next().unwrap_or(f64::NAN));
            Vec3::from(components)
        };
        let attachment = |one: &kin_language::lower::Attachment| {
            let local = vector(&one.local);
            let what =
                if one.is_point { Attached::Point(local) } else { Attached::Direction(local) };
            Attachment { argument: one.slot, what }
        };
        all.iter().map(attachment).collect()
    }

    fn table(&self) -> Option<(&Table, Vec<f64>)> {
        Some((&self.read.formula.table, self.of(&self.read.formula)))
    }

    fn outside(&self, number: usize, x: &[Dual3_64], to: &mut Given) {
        self.give(&self.read.formula, number, x, to);
    }
}

/// Returns the number of numbers that a type contains.
pub fn count(shape: &Shape) -> usize {
    match shape {
        Shape::Scalar => 1,
        Shape::Vector(n) => *n,
        Shape::Matrix(n) => n * n,
        Shape::Euler => 4,
        Shape::Array(inner, n) => n * count(inner),
        Shape::Tuple(all) => all.iter().map(count).sum(),
        Shape::Any => 0,
    }
}

/// Numbers as JSON: a number, a list of the components of a vector or matrix, lists of these.
fn as_json(shape: &Shape, numbers: &mut dyn Iterator<Item = &f64>) -> Result<Value, String> {
    let parts: Result<Vec<Value>, String> = match shape {
        Shape::Scalar => return numbers.next().copied().unwrap_or(f64::NAN).to_value(),
        Shape::Array(inner, n) => (0..*n).map(|_| as_json(inner, numbers)).collect(),
        Shape::Tuple(all) => all.iter().map(|part| as_json(part, numbers)).collect(),
        other => (0..count(other)).map(|_| as_json(&Shape::Scalar, numbers)).collect(),
    };
    parts.map(Value::Array)
}
