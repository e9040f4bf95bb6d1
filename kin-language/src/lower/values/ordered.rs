//! Equality and order of structs and enums, part by part, and the type `Ordering`.

use quote::ToTokens;
use syn::ExprBinary;

use super::{Adt, Read, Unreadable, Value, Values};
use kin_graph::{Comparison, Node};

impl Values {
    /// Returns the condition that `Some(order)` is an order with one of these names.
    pub fn is_one_of(&mut self, order: Value, names: &[&str], at: &ExprBinary) -> Read {
        let mut any = self.graph.bool(false);
        if let Value::Adt(Adt { fields, .. }) = order
            && let Some((_, order)) = fields.into_iter().next()
        {
            for name in names {
                let one = self.is_ordered(order.clone(), name, at)?;
                any = self.graph.or(any, one);
            }
        }
        Ok(Value::Condition(any))
    }

    /// Returns the conditions that one value is less than another, and that both are equal, as
    /// `#[derive(PartialOrd)]` defines them: by the order of the variants, then by the fields in
    /// order.
    pub fn less(&mut self, a: &Adt, b: &Adt) -> Option<(Node, Node)> {
        let declared =
            self.own.declared(&a.type_name()).filter(|declared| declared.derives("PartialOrd"))?;
        let place =
            |adt: &Adt| declared.variants.iter().position(|variant| variant.name == adt.name);
        if place(a) != place(b) {
            let less = place(a) < place(b);
            let equal = false;
            return Some((self.graph.bool(less), self.graph.bool(equal)));
        }
        let named = declared.fields.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
        // The fields of a tuple variant have numbers as names.
        let names = if named.is_empty() {
            a.fields.iter().map(|(name, _)| name.clone()).collect()
        } else {
            named
        };
        let mut less = self.graph.bool(false);
        let mut equal = self.graph.bool(true);
        for name in names {
            let (x, y) = match (a.field(&name)?, b.field(&name)?) {
                (Value::Integer(x, _), Value::Integer(y, _)) => {
                    let (x, y) = (x < y, x == y);
                    (self.graph.bool(x), self.graph.bool(y))
                }
                (Value::Scalar(x), Value::Scalar(y)) => {
                    let x = *x;
                    let y = *y;
                    (
                        self.graph.compare(Comparison::Less, x, y),
                        self.graph.compare(Comparison::Equal, x, y),
                    )
                }
                (Value::Adt(x), Value::Adt(y)) => self.less(&x.clone(), &y.clone())?,
                _ => return None,
            };
            let here = self.graph.and(equal, x);
            less = self.graph.or(less, here);
            equal = self.graph.and(equal, y);
        }
        Some((less, equal))
    }

    /// Returns the condition that two values of one type are equal, part by part.
    pub fn same(&mut self, a: &Adt, b: &Adt) -> Option<Node> {
        if a.name != b.name || a.fields.len() != b.fields.len() {
            return Some(self.graph.bool(false));
        }
        let mut all = self.graph.bool(true);
        for ((_, a), (_, b)) in a.fields.iter().zip(&b.fields) {
            let one = match (a, b) {
                (Value::Integer(a, _), Value::Integer(b, _)) => self.graph.bool(a == b),
                (Value::Adt(a), Value::Adt(b)) => self.same(a, b)?,
                (a, b) => {
                    let (a, shape) = a.numbers()?;
                    let (b, other) = b.numbers()?;
                    (shape == other).then_some(())?;
                    self.all_equal(&a, &b)
                }
            };
            all = self.graph.and(all, one);
        }
        Some(all)
    }

    /// Returns the order of two numbers: a choice among three values.
    pub fn order_of(&mut self, a: Node, b: Node) -> Value {
        let less = self.graph.compare(Comparison::Less, a, b);
        let equal = self.graph.compare(Comparison::Equal, a, b);
        match (self.graph.truth(less), self.graph.truth(equal)) {
            (Some(true), _) => return order_named("Less"),
            (_, Some(true)) => return order_named("Equal"),
            (Some(false), Some(false)) => return order_named("Greater"),
            _ => {}
        }
        let not_less = self.graph.not(less);
        let not_equal = self.graph.not(equal);
        let greater = self.graph.and(not_less, not_equal);
        Value::Choice(vec![
            (less, order_named("Less")),
            (greater, order_named("Greater")),
            (equal, order_named("Equal")),
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
}

/// Returns true if a value with this name is an order.
pub fn is_order(name: &str) -> bool {
    matches!(name, "Less" | "Equal" | "Greater")
}

pub fn order_named(name: &str) -> Value {
    Value::Adt(Adt::new(name, None))
}

#[cfg(test)]
mod tests {
    use super::order_named;
    use crate::lower::values::{Value, Values};
    use kin_graph::{Graph, Input};
    use quote::quote;

    #[test]
    fn an_order_is_known_or_a_choice() {
        let mut values = Values::new(Graph::default());
        let one = values.graph.constant(1.0);
        let x = values.graph.input(Input::Parameter(0));
        assert!(matches!(values.order_of(one, one), Value::Adt(adt) if adt.name == "Equal"));
        assert!(matches!(values.order_of(x, one), Value::Choice(all) if all.len() == 3));
        let less = values.is_ordered(order_named("Less"), "Less", &quote!(order));
        assert!(less.is_ok_and(|holds| values.graph.truth(holds) == Some(true)));
    }
}
