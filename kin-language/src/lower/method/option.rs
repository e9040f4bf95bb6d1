//! Methods of `Option` and `Result`, and of conditions that become them.

use super::Call;
use crate::lower::value::{Adt, Value};
use crate::lower::{Read, Reader, Unreadable};
use kin_graph::Node;

/// Methods of `Option` with a closure as argument. The interpreter takes a receiver that only rustc
/// knows for an `Option` if it has one of these.
pub const WITH_CLOSURES: &[&str] = &[
    "map",
    "map_or",
    "map_or_else",
    "and_then",
    "unwrap_or_else",
    "is_some_and",
    "is_none_or",
    "filter",
    "or_else",
];

impl Reader {
    /// Calls a method of `Some(x)`, `None`, `Ok(x)` or `Err(e)`.
    pub(super) fn option_method(&mut self, adt: Adt, call: &Call) -> Read {
        let held = matches!(adt.name.as_str(), "Some" | "Ok");
        let inner = adt.fields.first().map(|(_, value)| value.clone()).unwrap_or(Value::Unassigned);
        let same = Value::Adt(adt.clone());
        let with =
            |value: Value| Value::Adt(Adt { fields: vec![("0".into(), value)], ..adt.clone() });
        let argument = |k: usize| call.arguments.get(k).cloned().unwrap_or(Value::Poison);
        let place = |k: usize| call.places.get(k).copied();
        let truth = |reader: &mut Self, holds: bool| Ok(Value::Condition(reader.graph.bool(holds)));
        let apply = |reader: &mut Self, k: usize, inputs: Vec<Value>| {
            let Some(place) = place(k) else {
                return Err(Unreadable::new(&call.whole.method, "this method"));
            };
            let f = reader.function(argument(k), place)?;
            reader.apply(&f, inputs, &[], call)
        };
        match (call.name.as_str(), call.arguments.len()) {
            ("is_some" | "is_ok", 0) => truth(self, held),
            ("is_none" | "is_err", 0) => truth(self, !held),
            ("unwrap" | "expect" | "unwrap_or_default", 0 | 1) if held => Ok(inner),
            ("unwrap_or" | "unwrap_or_else", 1) if held => Ok(inner),
            ("unwrap" | "expect", _) => Ok(Value::Never),
            ("unwrap_or", 1) => Ok(argument(0)),
            ("unwrap_or_default", 0) => Ok(Value::Scalar(self.graph.zero())),
            ("unwrap_or_else", 1) => {
                apply(self, 0, if adt.name == "Err" { vec![inner] } else { vec![] })
            }
            ("map", 1) if held => Ok(with(apply(self, 0, vec![inner])?)),
            ("and_then", 1) if held => apply(self, 0, vec![inner]),
            ("map" | "and_then", 1) => Ok(same),
            ("filter", 1) if !held => Ok(same),
            ("filter", 1) => {
                let keeps = apply(self, 0, vec![Value::Reference(Box::new(inner))])?;
                let keeps = self.condition(keeps, call);
                self.joined(keeps, &same, &Value::none(), call)
            }
            ("map_or", 2) if held => apply(self, 1, vec![inner]),
            ("map_or", 2) => Ok(argument(0)),
            ("map_or_else", 2) if held => apply(self, 1, vec![inner]),
            ("map_or_else", 2) => {
                apply(self, 0, if adt.name == "Err" { vec![inner] } else { vec![] })
            }
            ("is_some_and" | "is_ok_and", 1) if held => apply(self, 0, vec![inner]),
            ("is_some_and" | "is_ok_and", 1) => truth(self, false),
            ("is_none_or", 1) if held => apply(self, 0, vec![inner]),
            ("is_none_or", 1) => truth(self, true),
            ("or" | "or_else", 1) if held => Ok(same),
            ("or", 1) => Ok(argument(0)),
            ("or_else", 1) => apply(self, 0, vec![]),
            ("and", 1) => Ok(if held { argument(0) } else { same }),
            ("ok" | "err" | "map_err" | "ok_or" | "ok_or_else", _) => self.between(adt, call),
            ("copied" | "cloned" | "as_ref" | "as_mut" | "clone" | "as_deref" | "take", 0) => {
                Ok(if held { with(self.loaded(inner)) } else { same })
            }
            ("zip", 1) => self.zipped(&same, argument(0), call),
            ("iter" | "into_iter", 0) => {
                Ok(Value::Iterator(if held { vec![inner] } else { vec![] }))
            }
            ("flatten", 0) => Ok(if held { self.loaded(inner) } else { same }),
            _ => self.other_count(&call.whole.method, call.arguments.len()).ok_or_else(|| {
                let what = format!("`{}` of an `Option` or `Result`", call.name);
                Unreadable::new(&call.whole.method, what)
            }),
        }
    }

    /// Converts an `Option` into a `Result`, or a `Result` into an `Option`.
    fn between(&mut self, adt: Adt, call: &Call) -> Read {
        let held = matches!(adt.name.as_str(), "Some" | "Ok");
        let inner = adt.fields.first().map(|(_, value)| value.clone());
        let error = |value: Value| Value::Adt(Adt::new("Err", Some(value)));
        let applied = |reader: &mut Self, inputs: Vec<Value>| {
            let f = reader.function(call.arguments[0].clone(), call.places[0])?;
            reader.apply(&f, inputs, &[], call)
        };
        Ok(match (call.name.as_str(), &call.arguments[..]) {
            ("ok", []) if held => Value::Adt(Adt::new("Some", inner)),
            ("err", []) if !held => Value::Adt(Adt::new("Some", inner)),
            ("ok" | "err", []) => Value::none(),
            ("ok_or" | "ok_or_else", [_]) if held => Value::Adt(Adt::new("Ok", inner)),
            ("map_err", [_]) if held => Value::Adt(adt),
            ("map_err", [_]) => error(applied(self, inner.into_iter().collect())?),
            ("ok_or", [value]) => error(value.clone()),
            ("ok_or_else", [_]) => error(applied(self, vec![])?),
            _ => return Err(Unreadable::new(&call.whole.method, "this method")),
        })
    }

    fn zipped(&mut self, one: &Value, other: Value, call: &Call) -> Read {
        let other = self.loaded(other);
        self.each(other, call, &mut |_, other| match (one, other) {
            (Value::Adt(a), Value::Adt(b)) => Ok(match (a.fields.first(), b.fields.first()) {
                (Some((_, a)), Some((_, b))) => {
                    Value::some(Value::Tuple(vec![a.clone(), b.clone()]))
                }
                _ => Value::none(),
            }),
            _ => Err(Unreadable::new(&call.whole.method, "`zip` of these values")),
        })
    }

    /// Reads `condition.then(|| value)` and `condition.then_some(value)`.
    pub(super) fn condition_method(&mut self, holds: Node, call: &Call) -> Read {
        match (call.name.as_str(), &call.arguments[..]) {
            ("then", [f]) => {
                let f = self.function(f.clone(), call.places[0])?;
                let some =
                    |reader: &mut Self| Ok(Value::some(reader.apply(&f, vec![], &[], call)?));
                self.choose(holds, some, |_| Ok(Value::none()), call)
            }
            ("then_some", [value]) => {
                self.joined(holds, &Value::some(value.clone()), &Value::none(), call)
            }
            ("not", []) => Ok(Value::Condition(self.graph.not(holds))),
            ("cmp" | "eq" | "ne", _) => {
                Err(Unreadable::new(&call.whole.method, format!("`{}` of a condition", call.name)))
            }
            _ => Ok(self.unknown(
                call,
                "a condition",
                ": write `if … { 1.0 } else { 0.0 }` for a number",
            )),
        }
    }
}
