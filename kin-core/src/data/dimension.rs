//! Reads and writes dimensions in mechanism files: named numbers, and expressions of dimensions in
//! place of numbers.

mod number;
mod texts;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::expression;
use super::names::plain;
use crate::dimensions::{Dimension, Distribution, Entry, Of, text_of};
use crate::model::constraint::Constraint;
use crate::model::mechanism::Mechanism;
use crate::numbers::algebra::Axis;
use crate::outcome::error::{Error, Result};

pub use number::NumberData;
pub(super) use texts::Texts;

/// A dimension as data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct DimensionData {
    /// The name of the dimension.
    pub name: String,
    /// The nominal value, or the expression that has this name.
    pub value: NumberData,
    /// The unit, as text.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub unit: String,
    /// The permitted range of the value; `None` for no limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub within: Option<[f64; 2]>,
    /// The tolerance of the dimension; `None` for a dimension without tolerance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// The distribution within the tolerance; `None` means the normal distribution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distribution: Option<Distribution>,
    /// The clearance to which the dimension belongs; `None` for a dimension that belongs to no
    /// clearance. A clearance has two dimensions with a disc as their common distribution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clearance: Option<String>,
}

fn too_long() -> Error {
    let reason = "an expression of them is too long to write. Give names to its parts";
    Error::Data { place: "dimensions".to_string(), reason: reason.to_string() }
}

/// Returns true if a numeric parameter belongs to the function's parameter `key`.
fn is_of(name: &str, key: &str) -> bool {
    name.strip_prefix(key).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// Returns the numeric parameters that belong to the function's parameter `key`, in order.
fn names(of: &dyn Constraint, key: &str) -> Vec<String> {
    let mut names = Vec::new();
    of.parameters(&mut |name, _| {
        if is_of(name, key) {
            names.push(name.to_string());
        }
    });
    names
}

/// An expression in the data of a constraint, in place of a number.
pub(super) struct Found {
    /// The parameter of the function.
    key: String,
    place: Within,
    number: Dimension,
}

/// The place of a number within a parameter.
enum Within {
    /// Its index in a list.
    List(usize),
    /// Its name in a law.
    Law(String),
}

/// Returns the value with numbers in place of expressions, and records the expressions. In a list
/// with an expression the other numbers are recorded as constants. Errors: an expression that
/// cannot be read.
pub(super) fn without_expressions(
    mechanism: &Mechanism,
    key: &str,
    value: &Value,
    found: &mut Vec<Found>,
) -> std::result::Result<Value, String> {
    let mut value = value.clone();
    let mut note = |place: Within, known: Known<'_>| {
        let number = match known {
            Known::Number(x) => x.into(),
            Known::Text(text) => mechanism.read_expression(text)?,
        };
        found.push(Found { key: key.to_string(), place, number });
        Ok(serde_json::Number::from_f64(number.value()).map_or(Value::Null, Value::Number))
    };
    match &value {
        Value::Object(_) => replace_in_law(&mut value, "", &mut note)?,
        _ => replace(&mut value, &mut 0, &mut note)?,
    }
    Ok(value)
}

type Note<'a> = dyn FnMut(Within, Known<'_>) -> std::result::Result<Value, String> + 'a;

/// A number, or the text in its place.
enum Known<'a> {
    Number(f64),
    Text(&'a str),
}

fn replace(
    value: &mut Value,
    number: &mut usize,
    note: &mut Note<'_>,
) -> std::result::Result<(), String> {
    match value {
        Value::Array(parts) => parts.iter_mut().try_for_each(|part| replace(part, number, note)),
        Value::String(text) => {
            *value = note(Within::List(*number), Known::Text(text))?;
            *number += 1;
            Ok(())
        }
        value => {
            if let Some(x) = value.as_f64() {
                note(Within::List(*number), Known::Number(x))?;
            }
            *number += 1;
            Ok(())
        }
    }
}

fn replace_in_law(
    law: &mut Value,
    before: &str,
    note: &mut Note<'_>,
) -> std::result::Result<(), String> {
    let Value::Object(law) = law else { return Ok(()) };
    if let Some(Value::Object(numbers)) = law.get_mut("numbers") {
        for (name, value) in numbers {
            if let Value::String(text) = value {
                *value = note(Within::Law(format!("{before}{name}")), Known::Text(text))?;
            }
        }
    }
    let Some(Value::Object(parts)) = law.get_mut("parts") else { return Ok(()) };
    parts
        .iter_mut()
        .try_for_each(|(name, part)| replace_in_law(part, &format!("{before}{name}."), note))
}

/// Returns the data of a law with numbers in place of expressions, and the expressions by the names
/// of the law's numbers. Errors: an expression that cannot be read.
pub(super) fn law_without_expressions(
    mechanism: &Mechanism,
    law: &Value,
) -> std::result::Result<(Value, Vec<(String, Dimension)>), String> {
    let mut found = Vec::new();
    let plain = without_expressions(mechanism, "", law, &mut found)?;
    let named = |Found { place, number, .. }: Found| match place {
        Within::Law(name) => Some((name, number)),
        Within::List(_) => None,
    };
    Ok((plain, found.into_iter().filter_map(named).collect()))
}

/// Returns the parameters of a constraint that are expressions. Errors: an expression that belongs
/// to no parameter.
pub(super) fn bound(
    of: &dyn Constraint,
    found: Vec<Found>,
) -> std::result::Result<Vec<(String, Dimension)>, String> {
    let parameter = |Found { key, place, number }: Found| {
        let own = names(of, &key);
        let name = match place {
            // An axis has more numbers than it shows, which distinguishes it from a vector.
            Within::List(k)
                if k < 6 && of.clone_boxed().set_parameter(&Axis::name_of(&key, k), 1.0) =>
            {
                Some(Axis::name_of(&key, k))
            }
            Within::List(k) => own.get(k).cloned(),
            Within::Law(name) => own.into_iter().find(|known| *known == format!("{key}.{name}")),
        };
        let name = name.ok_or_else(|| format!("its parameter `{key}` cannot be an expression"))?;
        Ok((name, number))
    };
    let hangs =
        |key: &str| found.iter().any(|one| one.key == key && one.number.of() != Of::Nothing);
    let keys: Vec<String> =
        found.iter().map(|one| one.key.clone()).filter(|key| hangs(key)).collect();
    found.into_iter().filter(|one| keys.contains(&one.key)).map(parameter).collect()
}

impl Mechanism {
    /// Evaluates an expression of this mechanism's dimensions, such as `crank / 2` or `hypot(dx,
    /// dy)`, in the syntax of mechanism files.
    ///
    /// Write a name that is not a single word in backticks.
    ///
    /// Errors: the text is not an expression; no dimension has a name of the text; the result is
    /// infinite or NaN.
    pub fn expression(&self, text: &str) -> Result<Dimension> {
        let place = "dimensions".to_string();
        self.read_expression(text).map_err(|reason| Error::Data { place, reason })
    }

    pub(super) fn read_expression(&self, text: &str) -> std::result::Result<Dimension, String> {
        let mut named =
            |name: &str| self.dimension_named(name).ok_or_else(|| self.dimension_names());
        let read = expression::read(text, &mut named)?;
        match read.value() {
            value if value.is_finite() => Ok(read),
            value => Err(format!("`{text}` is {value}. Give numbers that make it finite")),
        }
    }

    /// Returns the dimension with this name.
    pub fn dimension_named(&self, name: &str) -> Option<Dimension> {
        let store = self.dimensions.as_ref()?.store();
        let entry = store.entries.iter().find(|entry| entry.name == name)?;
        Some(Dimension::new(entry.value, self.layout.mechanism, entry.node))
    }

    /// Returns the names of all dimensions in their order.
    fn dimension_names(&self) -> Vec<String> {
        let Some(shared) = &self.dimensions else { return Vec::new() };
        shared.store().entries.iter().map(|entry| entry.name.clone()).collect()
    }

    /// Returns a number of a file. Errors: an expression that cannot be read, or is not finite.
    pub(super) fn number(&self, place: &str, number: &NumberData) -> Result<Dimension> {
        match number {
            NumberData::Number(x) => Ok((*x).into()),
            NumberData::Expression(text) => self
                .read_expression(text)
                .map_err(|reason| Error::Data { place: place.to_string(), reason }),
        }
    }

    /// Returns the dimensions as data. Errors: an expression that is too long.
    pub(super) fn dimension_data(&self) -> Result<Vec<DimensionData>> {
        let Some(shared) = &self.dimensions else { return Ok(Vec::new()) };
        let store = shared.store();
        let data = |(k, entry): (usize, &Entry)| {
            let expression =
                || text_of(&store.graph, &store.entries[..k], entry.node).ok_or_else(too_long);
            let value = match entry.is_derived {
                true => NumberData::Expression(expression()?),
                false => NumberData::Number(entry.value),
            };
            let Entry { name, unit, range: within, tolerance, mut distribution, clearance, .. } =
                entry.clone();
            if clearance.is_some() {
                distribution = None;
            }
            Ok(DimensionData { name, value, unit, within, tolerance, distribution, clearance })
        };
        store.entries.iter().enumerate().map(data).collect()
    }

    /// Declares the dimensions of a file, each after those on which it depends. Errors: an
    /// expression that cannot be read, or a cyclic one.
    pub(super) fn add_dimensions(&mut self, all: &[DimensionData]) -> Result<()> {
        let mut open: Vec<&DimensionData> = all.iter().collect();
        while !open.is_empty() {
            let before = open.len();
            let mut waiting = Vec::new();
            for data in open {
                match unmade(data, all, self) {
                    Some(_) => waiting.push(data),
                    None => self.add_dimension(data)?,
                }
            }
            if waiting.len() == before {
                return Err(circle(waiting[0], all, self));
            }
            open = waiting;
        }
        Ok(())
    }

    fn add_dimension(&mut self, data: &DimensionData) -> Result<()> {
        let place = format!("dimension `{}`", data.name);
        let value = self.number(&place, &data.value)?;
        let mut made = self.dimension(plain("dimension", &data.name)?, value)?;
        if let Some([from, to]) = data.within {
            made = made.within(from, to);
        }
        if let Some(tolerance) = data.tolerance {
            made = made.tolerance(tolerance);
        }
        if let Some(distribution) = data.distribution {
            made = made.distributed(distribution);
        }
        if let Some(clearance) = &data.clearance {
            made = made.in_clearance(plain("clearance", clearance)?);
        }
        if !data.unit.is_empty() {
            made.unit(plain("unit", &data.unit)?);
        }
        Ok(())
    }
}

/// Returns the first dimension in an expression that the file contains and that is not declared
/// yet.
fn unmade<'a>(
    data: &DimensionData,
    all: &'a [DimensionData],
    made: &Mechanism,
) -> Option<&'a DimensionData> {
    let NumberData::Expression(text) = &data.value else { return None };
    let mut first = None;
    let _ = expression::read(text, &mut |name| {
        let known = made.dimension_named(name);
        if known.is_none() && first.is_none() {
            first = all.iter().find(|other| other.name == name);
        }
        Ok(known.unwrap_or(1.0.into()))
    });
    first
}

/// Builds the error for cyclic expressions.
fn circle(from: &DimensionData, all: &[DimensionData], made: &Mechanism) -> Error {
    let mut way = vec![from];
    while let Some(next) = way.last().and_then(|last| unmade(last, all, made)) {
        let seen = way.iter().position(|one| one.name == next.name);
        way.push(next);
        if let Some(first) = seen {
            way.drain(..first);
            break;
        }
    }
    let names: Vec<String> = way.iter().map(|one| format!("`{}`", one.name)).collect();
    let reason = format!(
        "they depend on one another in a circle, {}. Give one of them a number",
        names.join(" → ")
    );
    Error::Data { place: "dimensions".to_string(), reason }
}
