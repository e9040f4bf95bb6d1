//! Reads mechanism files that contain equations as text.

use kin::Constraint;
use kin::data::Reader;
use kin::data::Registry;
use kin::emitted::Bindings;
use kin::extend::dual_route::ArgumentKind;
use kin::{Axis, Law};
use kin_language::parse::Shape;
use serde_json::Value;

use crate::constraint::{Body, ReadConstraint, count};
use crate::equation::Equation;
use crate::law;
use crate::signature::ParameterKind;

/// Returns a registry with all joints, drivers and laws of the library, which also reads equations
/// and laws as text.
///
/// Use the registry to read a mechanism file:
/// `Mechanism::read_json("slot.json", &kin::text::registry())`.
pub fn registry() -> Registry {
    Registry::new().reading_equations(with_text).reading_laws(law::of_file)
}

/// The registry with the constraint of a text.
fn with_text(registry: Registry, text: &str) -> Result<Registry, String> {
    let equation = Equation::read(text).map_err(|mistakes| mistakes.to_string())?;
    let name = equation.name().to_owned();
    let kinds = equation.arguments();
    registry.with_equation((&name, &kinds), text, move |from| {
        Some(Box::new(made(&equation, from)) as Box<dyn Constraint>)
    })
}

/// The constraint that a file describes; the reader notes what is wrong.
fn made(equation: &Equation, from: &mut Reader<'_>) -> ReadConstraint {
    let read = equation.inner().clone();
    let signature = &read.signature;
    let target = |from: &mut Reader<'_>, kind: ArgumentKind| match kind {
        ArgumentKind::Planar => Body::Planar(from.planar()),
        ArgumentKind::Spatial => Body::Spatial(from.spatial()),
        ArgumentKind::Coord => Body::Coord(from.coord()),
    };
    let targets = signature.slots.iter().map(|(_, kind)| target(from, *kind)).collect();
    let mut numbers = Vec::with_capacity(signature.numbers.len());
    let mut laws = Vec::new();
    for parameter in &signature.parameters {
        match &parameter.kind {
            ParameterKind::Numbers { shape, .. } => {
                let mut own = Vec::new();
                from.numbers(&parameter.name, &mut |value| {
                    own.clear();
                    of_json(shape, value, &mut own)
                });
                own.resize(count(shape), f64::NAN);
                numbers.extend(own);
            }
            ParameterKind::Axis { .. } => {
                let Axis { h, f, g } = from.get(&parameter.name);
                numbers.extend([h, f, g].into_iter().flat_map(|v| v.to_array()));
            }
            ParameterKind::Law(_) => laws.push(from.get::<Law>(&parameter.name)),
        }
    }
    ReadConstraint { targets, numbers, laws, bindings: Bindings::NONE, read: read.clone() }
}

/// Appends the numbers of a value.
fn of_json(shape: &Shape, value: &Value, to: &mut Vec<f64>) -> Result<(), String> {
    let parts = |n: usize| {
        let parts = value.as_array().filter(|parts| parts.len() == n);
        parts.ok_or_else(|| format!("{value} is not a list of {n} values"))
    };
    match shape {
        Shape::Scalar => {
            to.push(value.as_f64().ok_or_else(|| format!("{value} is not a number"))?);
            Ok(())
        }
        Shape::Array(inner, n) => parts(*n)?.iter().try_for_each(|part| of_json(inner, part, to)),
        Shape::Tuple(all) => {
            parts(all.len())?.iter().zip(all).try_for_each(|(part, shape)| of_json(shape, part, to))
        }
        other => parts(count(other))?.iter().try_for_each(|part| of_json(&Shape::Scalar, part, to)),
    }
}
