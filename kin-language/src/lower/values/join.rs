//! Joins two values by a condition: number by number if they are of one kind. Else the result is a
//! choice, and each later operation applies to both values.

use quote::ToTokens;

use super::{Adt, Read, Template, Unreadable, Value, Values};
use kin_graph::Node;

/// The most alternatives of one value.
const MOST_ALTERNATIVES: usize = 64;

impl Values {
    /// Returns the value of two branches, or reports a mistake where Rust has no common type.
    pub fn joined(&mut self, condition: Node, a: &Value, b: &Value, at: &dyn ToTokens) -> Read {
        match self.select(condition, a, b) {
            Some(value) => Ok(value),
            None if open(a) || open(b) => Err(Unreadable::new(at, "branches of different types")),
            None => {
                let nothing = |value: &Value| matches!(value, Value::Tuple(all) if all.is_empty());
                let cure = if nothing(a) || nothing(b) {
                    ". Give each branch a value, as in `else { 0.0 }`"
                } else {
                    ""
                };
                Ok(self.mistake(
                    at,
                    format!(
                        "the branches have different types: {} and {}{cure}",
                        a.name(),
                        b.name()
                    ),
                ))
            }
        }
    }

    /// Returns `a` or `b` if the condition is known, else the value of both.
    pub fn one_of(&mut self, condition: Node, a: Value, b: Value, at: &dyn ToTokens) -> Read {
        match self.graph.truth(condition) {
            Some(true) => Ok(a),
            Some(false) => Ok(b),
            None => self.joined(condition, &a, &b, at),
        }
    }

    /// Returns `a` where the condition holds, else `b`; returns `None` if Rust has no such value.
    pub fn select(&mut self, condition: Node, a: &Value, b: &Value) -> Option<Value> {
        match self.same_kind(condition, a, b) {
            Some(value) => Some(value),
            None if differs(a) && differs(b) => self.choice(condition, a, b),
            None => None,
        }
    }

    /// Returns a choice among several values; it joins those of one kind.
    pub fn choice(&mut self, condition: Node, a: &Value, b: &Value) -> Option<Value> {
        let otherwise = self.graph.not(condition);
        let mut all: Vec<(Node, Value)> = Vec::new();
        for (side, value) in [(condition, a), (otherwise, b)] {
            let alternatives = match value {
                Value::Choice(alternatives) => alternatives.clone(),
                value => vec![(self.graph.bool(true), value.clone())],
            };
            for (taken, value) in alternatives {
                let taken = self.graph.and(side, taken);
                let mut joined = None;
                for (k, (known, other)) in all.clone().into_iter().enumerate() {
                    // The first alternative comes first, so that emitted code searches a table from
                    // its beginning.
                    if let Some(one) = self.same_kind(known, &other, &value) {
                        joined = Some((k, self.graph.or(known, taken), one));
                        break;
                    }
                }
                match joined {
                    Some((k, either, one)) => all[k] = (either, one),
                    None => all.push((taken, value)),
                }
            }
        }
        match all.len() {
            1 => all.pop().map(|(_, value)| value),
            2..=MOST_ALTERNATIVES => Some(Value::Choice(all)),
            _ => None,
        }
    }

    /// Returns `a` where the condition holds, else `b`, number by number; returns `None` if they
    /// are of different kinds.
    pub fn same_kind(&mut self, condition: Node, a: &Value, b: &Value) -> Option<Value> {
        Some(match (a, b) {
            (Value::Poison, other) | (other, Value::Poison) => other.clone(),
            (Value::Left, other) | (other, Value::Left) => other.clone(),
            (Value::Never, Value::Never) => Value::Never,
            (Value::Never, known) | (known, Value::Never) => {
                let Some((_, shape)) = known.numbers() else { return Some(known.clone()) };
                let nowhere = self.nowhere(&shape);
                let (a, b) =
                    if matches!(a, Value::Never) { (&nowhere, known) } else { (known, &nowhere) };
                self.same_kind(condition, a, b)?
            }
            (Value::Reference(a), Value::Reference(b)) => {
                Value::Reference(Box::new(self.same_kind(condition, a, b)?))
            }
            (Value::Reference(a), b) => self.same_kind(condition, a, b)?,
            (a, Value::Reference(b)) => self.same_kind(condition, a, b)?,
            (Value::Scalar(a), Value::Scalar(b)) => {
                Value::Scalar(self.graph.select(condition, *a, *b))
            }
            (Value::Condition(a), Value::Condition(b)) => {
                Value::Condition(self.select_condition(condition, *a, *b))
            }
            (Value::Integer(a, x), Value::Integer(b, y)) if a == b => Value::Integer(*a, x.or(*y)),
            (Value::Tuple(a), Value::Tuple(b)) if a.len() == b.len() => {
                Value::Tuple(self.select_all(condition, a, b)?)
            }
            (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
                Value::Array(self.select_all(condition, a, b)?)
            }
            (Value::Iterator(a), Value::Iterator(b)) if a.len() == b.len() => {
                Value::Iterator(self.select_all(condition, a, b)?)
            }
            (Value::Adt(a), Value::Adt(b)) => Value::Adt(self.select_fields(condition, a, b)?),
            (Value::Planar(a), Value::Planar(b)) if a == b => Value::Planar(*a),
            (Value::Spatial(a), Value::Spatial(b)) if a == b => Value::Spatial(*a),
            (Value::Place(a), Value::Place(b)) if a == b => Value::Place(a.clone()),
            (Value::Unassigned, Value::Unassigned) => Value::Unassigned,
            (Value::Into(a), Value::Into(b)) => {
                Value::Into(Box::new(self.same_kind(condition, a, b)?))
            }
            (Value::Function(a), Value::Function(b)) if a.is(b) => Value::Function(a.clone()),
            (Value::Generator(a), Value::Generator(b)) if a.is(b) => Value::Generator(a.clone()),
            (Value::Law(a), Value::Law(b)) if a.key() == b.key() => Value::Law(a.clone()),
            (Value::Axis(a), Value::Axis(b)) => {
                let mut each = a.iter().zip(b).map(|(a, b)| {
                    a.iter().zip(b).map(|(&a, &b)| self.graph.select(condition, a, b)).collect()
                });
                Value::Axis([each.next()?, each.next()?, each.next()?])
            }
            (a, b) => self.same_numbers(condition, a, b)?,
        })
    }

    /// Joins values made of numbers, and values that only rustc knows.
    pub fn same_numbers(&mut self, condition: Node, a: &Value, b: &Value) -> Option<Value> {
        Some(match (a, b) {
            (Value::Opaque(a), Value::Opaque(b)) if a.key() == b.key() => Value::Opaque(a.clone()),
            (Value::Opaque(a), Value::Opaque(b)) => {
                Value::Opaque(Template::Choice(condition, Box::new(a.clone()), Box::new(b.clone())))
            }
            (Value::Opaque(_), known) | (known, Value::Opaque(_)) if known.numbers().is_some() => {
                let shape = known.numbers()?.1;
                let nowhere = proc_macro2::TokenStream::new();
                let a = self.shaped(a.clone(), &shape, &nowhere);
                let b = self.shaped(b.clone(), &shape, &nowhere);
                self.same_kind(condition, &a, &b)?
            }
            (Value::Opaque(template), Value::Condition(_))
            | (Value::Condition(_), Value::Opaque(template)) => {
                let taken = self
                    .condition(Value::Opaque(template.clone()), &proc_macro2::TokenStream::new());
                let of =
                    |value: &Value| if let Value::Condition(node) = value { *node } else { taken };
                Value::Condition(self.select_condition(condition, of(a), of(b)))
            }
            (a, b) => {
                let (kind, a) = a.components()?;
                let (other, b) = b.components()?;
                let each =
                    a.iter().zip(b).map(|(&a, &b)| self.graph.select(condition, a, b)).collect();
                (kind == other).then(|| kind.value(each))?
            }
        })
    }

    pub fn select_condition(&mut self, condition: Node, a: Node, b: Node) -> Node {
        if a == b {
            return a;
        }
        let yes = self.graph.and(condition, a);
        let not = self.graph.not(condition);
        let no = self.graph.and(not, b);
        self.graph.or(yes, no)
    }

    pub fn select_all(&mut self, condition: Node, a: &[Value], b: &[Value]) -> Option<Vec<Value>> {
        a.iter().zip(b).map(|(a, b)| self.select(condition, a, b)).collect()
    }

    pub fn select_fields(&mut self, condition: Node, a: &Adt, b: &Adt) -> Option<Adt> {
        let same = a.name == b.name && a.fields.len() == b.fields.len();
        let mut fields = Vec::new();
        for ((name, a), (other, b)) in a.fields.iter().zip(&b.fields).filter(|_| same) {
            fields.push((name.clone(), self.select(condition, a, b).filter(|_| name == other)?));
        }
        same.then(|| Adt { fields, ..a.clone() })
    }
}

/// Returns true if a value may have the Rust type of another one although the interpreter gives
/// them different kinds.
fn differs(value: &Value) -> bool {
    match value {
        Value::Integer(..)
        | Value::Function(_)
        | Value::Iterator(_)
        | Value::Array(_)
        | Value::Law(_)
        | Value::Adt(_) => true,
        Value::Planar(_)
        | Value::Spatial(_)
        | Value::Place(_)
        | Value::Choice(_)
        | Value::Opaque(_) => true,
        Value::Reference(inner) => differs(inner),
        Value::Tuple(all) => all.iter().any(differs),
        _ => false,
    }
}

/// Returns true for kinds whose mismatch may still be good Rust.
fn open(value: &Value) -> bool {
    match value {
        Value::Into(_) | Value::Generator(_) | Value::Never | Value::Axis(_) => true,
        Value::Tuple(all) | Value::Array(all) => all.iter().any(open),
        Value::Reference(inner) => open(inner),
        value => differs(value),
    }
}

#[cfg(test)]
mod tests {
    use crate::lower::values::{Value, Values};
    use kin_graph::{Comparison, Graph, Input};
    use quote::quote;

    #[test]
    fn numbers_join_and_other_kinds_are_a_choice() {
        let mut values = Values::new(Graph::default());
        let k = values.graph.input(Input::Parameter(0));
        let zero = values.graph.zero();
        let holds = values.graph.compare(Comparison::Less, k, zero);
        let [a, b] = [1.0, 2.0].map(|x| Value::Scalar(values.graph.constant(x)));
        assert!(matches!(values.select(holds, &a, &b), Some(Value::Scalar(_))));
        let [one, two] = [1, 2].map(|k| Value::Integer(k, None));
        assert!(
            matches!(values.select(holds, &one, &two), Some(Value::Choice(all)) if all.len() == 2)
        );
        assert!(matches!(values.select(holds, &one, &one), Some(Value::Integer(1, _))));
        assert!(values.select(holds, &a, &Value::unit()).is_none());
        let told = values.joined(holds, &a, &Value::unit(), &quote!(x));
        assert!(matches!(told, Ok(Value::Poison)) && !values.mistakes.is_empty());
    }
}
