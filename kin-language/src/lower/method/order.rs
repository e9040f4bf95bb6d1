//! The type `Ordering`: the results of `total_cmp` and similar methods, and the methods of these
//! results.

use quote::ToTokens;

use super::Call;
use crate::lower::value::{Adt, Value};
use crate::lower::{Read, Reader, Unreadable};
use kin_graph::{Comparison, Node};

impl Reader {
    /// Returns the order of two numbers: a choice among three values.
    pub fn order_of(&mut self, a: Node, b: Node) -> Value {
        let less = self.graph.compare(Comparison::Less, a, b);
        let equal = self.graph.compare(Comparison::Equal, a, b);
        match (self.graph.truth(less), self.graph.truth(equal)) {
            (Some(true), _) => return named("Less"),
            (_, Some(true)) => return named("Equal"),
            (Some(false), Some(false)) => return named("Greater"),
            _ => {}
        }
        let not_less = self.graph.not(less);
        let not_equal = self.graph.not(equal);
        let greater = self.graph.and(not_less, not_equal);
        Value::Choice(vec![
            (less, named("Less")),
            (greater, named("Greater")),
            (equal, named("Equal")),
        ])
    }

    /// Returns the condition that an order has this name.
    pub fn is_ordered(&mut self, order: Value, name: &str, at: &dyn ToTokens) -> Read<Node> {
        match self.loaded(order) {
            Value::Adt(adt) => Ok(self.graph.bool(adt.name == name)),
            Value::Choice(all) => {
                let never = self.graph.bool(false);
                let fitting = all
                    .into_iter()
                    .filter(|(_, value)| matches!(value, Value::Adt(adt) if adt.name == name));
                Ok(fitting.fold(never, |any, (taken, _)| self.graph.or(any, taken)))
            }
            Value::Poison => Ok(self.graph.bool(false)),
            other if other.numbers().is_some() || matches!(other, Value::Condition(_)) => {
                self.told_by_rustc(
                    at,
                    &format!(
                        "expected an order such as `a.total_cmp(b)`, but found {}",
                        other.name()
                    ),
                )
                .ok_or_else(|| Unreadable::new(at, "an unknown order"))?;
                Ok(self.graph.bool(false))
            }
            _ => Err(Unreadable::new(at, "an unknown order")),
        }
    }

    /// Calls a method of an order.
    pub(super) fn order_method(&mut self, adt: &Adt, call: &Call) -> Read {
        let is = |wanted: &[&str]| wanted.contains(&adt.name.as_str());
        let holds = match call.name.as_str() {
            "is_lt" => is(&["Less"]),
            "is_le" => is(&["Less", "Equal"]),
            "is_gt" => is(&["Greater"]),
            "is_ge" => is(&["Greater", "Equal"]),
            "is_eq" => is(&["Equal"]),
            "is_ne" => is(&["Less", "Greater"]),
            "reverse" => {
                return Ok(named(match adt.name.as_str() {
                    "Less" => "Greater",
                    "Greater" => "Less",
                    _ => "Equal",
                }));
            }
            "then" if is(&["Equal"]) && call.arguments.len() == 1 => {
                return Ok(call.arguments[0].clone());
            }
            "then_with" if is(&["Equal"]) && call.arguments.len() == 1 => {
                let f = self.function(call.arguments[0].clone(), call.places[0])?;
                return self.apply(&f, vec![], &[], call);
            }
            "then" | "then_with" => return Ok(Value::Adt(adt.clone())),
            _ => return Err(Unreadable::new(&call.whole.method, "this method of an order")),
        };
        Ok(Value::Condition(self.graph.bool(holds)))
    }
}

/// Returns true if a value with this name is an order.
pub fn is_order(name: &str) -> bool {
    matches!(name, "Less" | "Equal" | "Greater")
}

pub fn named(name: &str) -> Value {
    Value::Adt(Adt::new(name, None))
}
