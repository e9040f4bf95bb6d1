//! Variables and parts of them: their values, and changes of these.

use std::rc::Rc;

use proc_macro2::Ident;
use quote::ToTokens;
use syn::Expr;

use super::{
    Function, Name, Place, Read, Step, Template, Unreadable, Value, Values, entry, position,
};
use crate::parse::SecondReader;

impl Values {
    /// Declares a variable in the innermost scope.
    pub fn declare(&mut self, name: String, value: Value) {
        let slot = self.store.declare(value);
        self.scopes.declare(name, slot);
    }

    /// Returns the value of a name.
    pub fn named(&self, name: &str) -> Option<&Value> {
        match self.scopes.get(name)? {
            Name::Variable(slot) => Some(self.store.get(slot)),
            Name::Item(value) => Some(value),
        }
    }

    /// Returns the value behind a reference, or any other value unchanged.
    pub fn loaded(&self, value: Value) -> Value {
        match value.referent() {
            Value::Place(place) => {
                self.at_place(&place).map_or(Value::Poison, |value| self.loaded(value))
            }
            Value::Choice(all) => Value::Choice(
                all.into_iter().map(|(taken, value)| (taken, self.loaded(value))).collect(),
            ),
            other => other,
        }
    }

    /// Returns the value at a place.
    pub fn at_place(&self, place: &Place) -> Option<Value> {
        let mut value = self.store.get(place.slot);
        for (k, step) in place.steps.iter().enumerate() {
            value = match (through(value), step) {
                (Value::Place(inner), _) => {
                    let inner = inner.then(&place.steps[k..]);
                    return self.at_place(&inner);
                }
                (Value::Array(all), Step::Index(k)) => all.get(*k)?,
                (Value::Tuple(all), Step::Field(name)) => all.get(name.parse::<usize>().ok()?)?,
                (Value::Adt(adt), Step::Field(name)) => adt.field(name)?,
                (other, _) => return part(other.clone(), &place.steps[k..]),
            };
        }
        Some(value.clone())
    }

    /// Stores a value at a place, and returns `None` if the place does not exist.
    pub fn put_at(&mut self, place: &Place, value: Value, at: &dyn ToTokens) -> Option<()> {
        let mut whole = self.store.get(place.slot).clone();
        if let (Value::Place(inner), true) = (through(&whole), !place.steps.is_empty()) {
            let inner = inner.then(&place.steps);
            return self.put_at(&inner, value, at);
        }
        self.put(&mut whole, &place.steps, value, at)?;
        self.store.set(place.slot, whole);
        Some(())
    }

    pub fn put(
        &mut self,
        whole: &mut Value,
        steps: &[Step],
        value: Value,
        at: &dyn ToTokens,
    ) -> Option<()> {
        let Some((step, rest)) = steps.split_first() else {
            if let Value::Place(inner) = whole {
                let inner = inner.clone();
                return self.put_at(&inner, value, at);
            }
            *whole = value;
            return Some(());
        };
        if let Value::Place(inner) = whole {
            let inner = inner.then(steps);
            return self.put_at(&inner, value, at);
        }
        match (whole, step) {
            (Value::Reference(inner), _) => self.put(inner, steps, value, at),
            (Value::Choice(all), _) => {
                all.iter_mut().try_for_each(|(_, one)| self.put(one, steps, value.clone(), at))
            }
            (Value::Tuple(all), Step::Field(name)) => {
                self.put(all.get_mut(name.parse::<usize>().ok()?)?, rest, value, at)
            }
            (Value::Array(all), Step::Index(k)) => self.put(all.get_mut(*k)?, rest, value, at),
            (Value::Adt(adt), Step::Field(name)) => self.put(adt.field_mut(name)?, rest, value, at),
            (Value::Array(all), Step::Slice(from, to)) => {
                let mut part = Value::Array(all.get(*from..*to)?.to_vec());
                self.put(&mut part, rest, value, at)?;
                let Value::Array(part) = part else { return None };
                (part.len() == to - from).then(|| all.splice(*from..*to, part).for_each(drop))
            }
            (Value::Matrix(n, m), Step::Index(k)) => {
                // Row and column are two steps.
                let [Step::Index(column)] = rest else { return None };
                let node = self.scalar(value, at);
                (*column < *n).then_some(())?;
                m.get_mut(k * *n + column).map(|place| *place = node)
            }
            (Value::Poison, _) => Some(()),
            (whole, step) => {
                rest.is_empty().then_some(())?;
                let node = self.scalar(value, at);
                let (nodes, k) = component(whole, step)?;
                nodes.get_mut(k).map(|place| *place = node)
            }
        }
    }

    /// Declares a variable of a pattern.
    pub fn declare_bound(&mut self, name: &Ident, mutable: bool, value: Value) {
        let slot = self.store.declare(value);
        if !mutable && self.signature.second_reader == SecondReader::Nobody {
            self.signature.fixed.insert(slot, name.to_string());
        }
        self.scopes.declare(name.to_string(), slot);
    }

    /// Reports a change of a variable that is not `mut`, unless the change is its first assignment.
    pub fn change(&mut self, expression: &Expr, place: &Place) {
        let Some(name) = self.signature.fixed.get(&place.slot) else { return };
        // A place behind a reference belongs to another variable.
        let is_own = root(expression).is_some_and(
            |root| matches!(self.scopes.get(&root), Some(Name::Variable(slot)) if slot == place.slot),
        );
        let is_first =
            place.steps.is_empty() && matches!(self.store.get(place.slot), Value::Unassigned);
        if is_own && !is_first {
            let message = format!("`{name}` cannot change: declare `mut {name}`");
            self.told_by_rustc(expression, &message);
        }
    }

    /// Returns the value of a variable that only one of two branches has assigned.
    pub fn perhaps(&self, value: Value) -> Value {
        match (self.signature.second_reader, value) {
            (SecondReader::Nobody, value)
                if !matches!(value, Value::Perhaps(_) | Value::Unassigned) =>
            {
                Value::Perhaps(Box::new(value))
            }
            (_, value) => value,
        }
    }

    /// Returns the values of the sequence of a `for` or an iterator, or `None` after a mistake.
    pub fn elements(&mut self, value: Value, at: &Expr) -> Read<Option<Vec<Value>>> {
        match value {
            Value::Reference(inner) => match *inner {
                Value::Array(all) => Ok(Some(
                    all.into_iter().map(|value| Value::Reference(Box::new(value))).collect(),
                )),
                inner => self.elements(inner, at),
            },
            Value::Place(place) => match self.at_place(&place) {
                Some(Value::Array(all)) => {
                    Ok(Some((0..all.len()).map(|k| Value::Place(place.index(k))).collect()))
                }
                Some(Value::Iterator(all)) => {
                    let _ = self.put_at(&place, Value::Iterator(vec![]), at);
                    Ok(Some(all))
                }
                Some(inner) => self.elements(inner, at),
                None => Err(Unreadable::new(at, "a loop over something of unknown length")),
            },
            Value::Array(all) | Value::Iterator(all) => Ok(Some(all)),
            Value::Opaque(ref template) if self.integers_of(template).is_some() => {
                Ok(self.integers_of(template))
            }
            Value::Poison => Ok(None),
            Value::Adt(adt) if matches!(adt.name.as_str(), "Some" | "None") => {
                Ok(Some(adt.fields.into_iter().map(|(_, value)| value).collect()))
            }
            Value::Opaque(_)
            | Value::Endless(_)
            | Value::Into(_)
            | Value::Generator(_)
            | Value::Never
            | Value::Choice(_)
            | Value::Left
            | Value::Adt(_) => Err(Unreadable::new(at, "a loop over something of unknown length")),
            other => {
                self.mistake(
                    at,
                    format!("a loop needs a range or an array, but the value is {}", other.name()),
                );
                Ok(None)
            }
        }
    }

    /// Returns a value as a function, if it can be one.
    pub fn function(&mut self, value: Value, at: &dyn ToTokens) -> Read<Function> {
        match self.loaded(value) {
            Value::Function(function) => Ok(function),
            Value::Opaque(Template::Path(path, _)) => Ok(Function::Path(Rc::new(path))),
            _ => Err(Unreadable::new(at, "a function that is not a closure")),
        }
    }

    /// Returns the value of a length that is a constant of the body.
    pub fn known_length(&self, length: &Expr) -> Option<usize> {
        let name = length.to_token_stream().to_string();
        match (crate::parse::literal_length(length), self.named(&name)) {
            (Some(n), _) => Some(n),
            (None, Some(Value::Integer(n, _))) => usize::try_from(*n).ok(),
            _ => None,
        }
    }
}

fn through(value: &Value) -> &Value {
    match value {
        Value::Reference(inner) => through(inner),
        value => value,
    }
}

/// Returns the part of a value at the end of some steps.
fn part(value: Value, steps: &[Step]) -> Option<Value> {
    let Some((step, rest)) = steps.split_first() else { return Some(value) };
    match (value.referent(), step) {
        (Value::Array(all), Step::Slice(from, to)) => {
            part(Value::Array(all.get(*from..*to)?.to_vec()), rest)
        }
        (Value::Array(all), Step::Index(k)) => part(all.get(*k)?.clone(), rest),
        (Value::Matrix(n, m), Step::Index(row)) => match rest {
            [Step::Index(column)] if *column < n => {
                m.get(row * n + column).copied().map(Value::Scalar)
            }
            _ => None,
        },
        (Value::Choice(all), _) => {
            let parts = all.into_iter().map(|(taken, value)| Some((taken, part(value, steps)?)));
            parts.collect::<Option<Vec<_>>>().map(Value::Choice)
        }
        (mut value, step) => {
            let (nodes, k) = component(&mut value, step)?;
            nodes.get(k).copied().filter(|_| rest.is_empty()).map(Value::Scalar)
        }
    }
}

/// Returns the numbers of a value with components, and the index of the selected one.
fn component<'a>(
    value: &'a mut Value,
    step: &Step,
) -> Option<(&'a mut Vec<kin_graph::Node>, usize)> {
    match (value, step) {
        (Value::Vector(v), Step::Field(name)) => {
            let k = position(name, &["x", "y", "z"][..v.len()])?;
            Some((v, k))
        }
        (Value::Euler(p), Step::Field(name)) => {
            position(name, &["e0", "e1", "e2", "e3"]).map(|k| (p, k))
        }
        (Value::Matrix(n, m), Step::Field(name)) => entry(name, *n).map(|k| (m, k)),
        (Value::Vector(v) | Value::Euler(v), Step::Index(k)) => Some((v, *k)),
        _ => None,
    }
}

/// Returns the variable of which an expression is a part, without following references.
fn root(expression: &Expr) -> Option<String> {
    match expression {
        Expr::Path(path) => path.path.get_ident().map(ToString::to_string),
        Expr::Field(field) => root(&field.base),
        Expr::Index(index) => root(&index.expr),
        Expr::Paren(inner) => root(&inner.expr),
        Expr::Group(inner) => root(&inner.expr),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::lower::scope::Place;
    use crate::lower::values::{Value, Values};
    use kin_graph::Graph;
    use quote::quote;

    #[test]
    fn a_part_of_a_variable_changes_alone() {
        let mut values = Values::new(Graph::default());
        let list = Value::Array(vec![Value::count(1), Value::count(2)]);
        values.declare("list".into(), list);
        let second = Place::whole(0).index(1);
        assert!(values.put_at(&second, Value::count(5), &quote!(list[1])).is_some());
        assert!(matches!(values.at_place(&second), Some(Value::Integer(5, _))));
        assert!(matches!(values.at_place(&Place::whole(0).index(0)), Some(Value::Integer(1, _))));
        assert!(values.put_at(&Place::whole(0).index(2), Value::count(0), &quote!(x)).is_none());
        let behind = Value::Reference(Box::new(Value::Place(second)));
        assert!(matches!(values.loaded(behind), Value::Integer(5, _)));
    }
}
