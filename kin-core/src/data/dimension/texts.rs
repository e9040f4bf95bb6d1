//! Writes the numbers of a mechanism that depend on dimensions, in the form of a mechanism file.

use serde_json::{Map, Value};

use super::{NumberData, is_of, names, too_long};
use crate::dimensions::{Beside, Bound, Holder, text_of};
use crate::model::constraint::Constraint;
use crate::model::mechanism::Mechanism;
use crate::outcome::error::Result;

/// The numbers of a mechanism that depend on dimensions, as text.
pub(in crate::data) struct Texts(Vec<(Bound, String)>);

impl Texts {
    /// Collects these texts. Errors: an expression that is too long.
    pub(in crate::data) fn of(mechanism: &Mechanism) -> Result<Texts> {
        let Some(shared) = &mechanism.dimensions else { return Ok(Texts(Vec::new())) };
        let store = shared.store();
        let text = |hung: &crate::dimensions::Hung| {
            let text = text_of(&store.graph, &store.entries, hung.node).ok_or_else(too_long)?;
            Ok((hung.at.clone(), text))
        };
        Ok(Texts(mechanism.hung.iter().map(text).collect::<Result<_>>()?))
    }

    /// Returns a number, or its expression if it depends on dimensions.
    pub(in crate::data) fn number(&self, at: Bound, value: f64) -> NumberData {
        match self.text(&at) {
            Some(text) => NumberData::Expression(text.to_string()),
            None => NumberData::Number(value),
        }
    }

    /// Puts the expressions into the parameters of a constraint. For an axis it writes the given
    /// directions.
    pub(in crate::data) fn put(
        &self,
        holder: Holder,
        of: &dyn Constraint,
        parameters: &mut Map<String, Value>,
    ) {
        for (at, text) in &self.0 {
            match at {
                Bound::Parameter { of: known, name, .. } if *known == holder => {
                    if let Some(place) = place_of(of, parameters, name) {
                        *place = Value::String(text.clone());
                    }
                }
                Bound::Axis { of: known, name, part: 0 } if *known == holder => {
                    let own = |part: usize| Bound::Axis { of: holder, name: name.clone(), part };
                    parameters.insert(name.clone(), self.directions(own));
                }
                _ => {}
            }
        }
    }

    /// Returns the components of one direction, or two lists for two directions.
    fn directions(&self, at: impl Fn(usize) -> Bound) -> Value {
        let all: Vec<Value> = (0..6).map_while(|part| self.text(&at(part))).map(value_of).collect();
        match all.as_chunks::<3>().0 {
            [one] => one.to_vec().into(),
            several => several.iter().map(|one| Value::from(one.to_vec())).collect(),
        }
    }

    /// Returns the points between which a spatial body is drawn, if they depend on dimensions.
    /// `first` is its first coordinate.
    pub(in crate::data) fn between(&self, first: usize) -> Option<[[NumberData; 3]; 2]> {
        let number = |part: usize| Some(number_of(self.text(&Bound::Between { first, part })?));
        let point = |from: usize| Some([number(from)?, number(from + 1)?, number(from + 2)?]);
        Some([point(0)?, point(3)?])
    }

    /// Returns the place of a spatial body and the directions that it faces, if they depend on
    /// dimensions. `first` is its first coordinate.
    pub(in crate::data) fn facing(&self, first: usize) -> Option<Vec<NumberData>> {
        let number = |part: usize| Some(number_of(self.text(&Bound::Facing { first, part })?));
        let all: Vec<NumberData> = (0..9).map_while(number).collect();
        (!all.is_empty()).then_some(all)
    }

    /// Returns the numbers of a mass or load, by their names.
    pub(in crate::data) fn beside<const N: usize>(
        &self,
        of: &Beside,
        names: [&str; N],
        values: [f64; N],
    ) -> [NumberData; N] {
        let mut names = names.into_iter();
        values.map(|value| {
            let name = names.next().unwrap_or_default().to_string();
            self.number(Bound::Beside { of: of.clone(), name }, value)
        })
    }

    /// Puts the expressions into the data of a law of a load. `name` is the name of the law in the
    /// load.
    pub(in crate::data) fn put_law(&self, of: &Beside, name: &str, law: &mut Value) {
        for (at, text) in &self.0 {
            let Bound::Beside { of: known, name: own } = at else { continue };
            let own = own.strip_prefix(name).and_then(|rest| rest.strip_prefix('.'));
            if let Some(place) = own.filter(|_| known == of).and_then(|own| in_law(law, own)) {
                *place = Value::String(text.clone());
            }
        }
    }

    fn text(&self, at: &Bound) -> Option<&str> {
        self.0.iter().find(|(known, _)| known == at).map(|(_, text)| text.as_str())
    }
}

/// Returns the number of a text, or the expression.
fn number_of(text: &str) -> NumberData {
    text.parse().map_or_else(|_| NumberData::Expression(text.to_string()), NumberData::Number)
}

/// Returns the number of a text, or the expression, as JSON.
fn value_of(text: &str) -> Value {
    match number_of(text) {
        NumberData::Number(x) => x.into(),
        NumberData::Expression(text) => text.into(),
    }
}

/// Returns the place of a numeric parameter in the data of its constraint.
fn place_of<'a>(
    of: &dyn Constraint,
    parameters: &'a mut Map<String, Value>,
    name: &str,
) -> Option<&'a mut Value> {
    let key = parameters.keys().find(|key| is_of(name, key))?.clone();
    let value = parameters.get_mut(&key)?;
    if value.is_object() {
        return in_law(value, name.get(key.len() + 1..)?);
    }
    let number = names(of, &key).iter().position(|known| known == name)?;
    leaf(value, &mut { number })
}

/// Returns the number with this name in the data of a law.
fn in_law<'a>(law: &'a mut Value, name: &str) -> Option<&'a mut Value> {
    let law = law.as_object_mut()?;
    if law.get("numbers").and_then(|numbers| numbers.get(name)).is_some() {
        return law.get_mut("numbers")?.get_mut(name);
    }
    let parts = law.get_mut("parts")?.as_object_mut()?;
    let within = |part: &str| name.strip_prefix(part).and_then(|rest| rest.strip_prefix('.'));
    let (part, rest) = parts.keys().find_map(|part| Some((part.clone(), within(part)?)))?;
    in_law(parts.get_mut(&part)?, rest)
}

/// Returns the number with index `number` in nested lists.
fn leaf<'a>(value: &'a mut Value, number: &mut usize) -> Option<&'a mut Value> {
    match value {
        Value::Array(parts) => parts.iter_mut().find_map(|part| leaf(part, number)),
        value => match number.checked_sub(1) {
            Some(less) => {
                *number = less;
                None
            }
            None => Some(value),
        },
    }
}
