//! Casts, `value as T`. If the bounds of a number are known, its cast to an integer is a choice
//! among several integers.

use super::{IntegerType, Read, Template, Unreadable, Value, Values, integer};
use crate::vocabulary::is_integer;
use kin_graph::{Comparison, Function2, Node, Op};

/// The most integers in such a choice.
const MOST_INTEGERS: i64 = 64;

impl Values {
    /// Reads `x.clamp(0.0, 9.0) as usize`: the integer below x, as a choice among several.
    pub fn whole_of(&mut self, x: Node, name: &str, cast: &syn::ExprCast) -> Read {
        let unknown = || Unreadable::new(&cast.as_token, "a cast of a number to an integer");
        let (low, high) = self.bounds(x).ok_or_else(unknown)?;
        // Below zero `as` rounds upwards.
        if !(low >= 0.0 && high <= 1e9 && fits(high as i64, name)) {
            return Err(unknown());
        }
        let low = low as i64;
        let high = high as i64;
        if high - low >= MOST_INTEGERS {
            return Err(unknown());
        }
        let integer = |k: i64| Value::Integer(k, IntegerType::named(name));
        let at_least = |reader: &mut Self, k: i64| {
            let k = reader.graph.constant(k as f64);
            reader.graph.compare(Comparison::GreaterEqual, x, k)
        };
        let mut all = Vec::new();
        let mut above = self.graph.bool(false);
        for k in (low + 1..=high).rev() {
            let reached = at_least(self, k);
            let not_above = self.graph.not(above);
            all.push((self.graph.and(reached, not_above), integer(k)));
            above = reached;
        }
        // The lowest integer comes last, because `as` makes it from NaN too if it is 0.
        all.push((self.graph.not(above), integer(low)));
        Ok(if all.len() == 1 { integer(low) } else { Value::Choice(all) })
    }

    /// Returns constants between which a number lies, from `clamp`, `min` and `max`.
    pub fn bounds(&self, x: Node) -> Option<(f64, f64)> {
        let constant = |node: Node| self.graph.constant_value(node);
        match self.graph.op(x) {
            Op::Call(kin_graph::Function::Floor, inner) => {
                let (low, high) = self.bounds(inner)?;
                Some((low.floor(), high.floor()))
            }
            Op::Call2(Function2::Min, inner, bound) | Op::Call2(Function2::Max, inner, bound) => {
                let is_min = matches!(self.graph.op(x), Op::Call2(Function2::Min, ..));
                let (inner, bound) = match (constant(inner), constant(bound)) {
                    (None, Some(bound)) => (inner, bound),
                    (Some(other), None) => (bound, other),
                    _ => return None,
                };
                let (low, high) = self.bounds(inner).unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
                Some(if is_min {
                    (low.min(bound), high.min(bound))
                } else {
                    (low.max(bound), high.max(bound))
                })
            }
            _ => None,
        }
    }

    pub fn cast_of(
        &mut self,
        value: Value,
        ty: &proc_macro2::TokenStream,
        name: &str,
        cast: &syn::ExprCast,
    ) -> Read {
        let integer = is_integer(name);
        Ok(match value {
            Value::Integer(k, _) if name == "f64" => Value::Scalar(self.graph.constant(k as f64)),
            Value::Integer(k, _) if integer && fits(k, name) => {
                Value::Integer(k, IntegerType::named(name))
            }
            Value::Integer(k, _) if integer => {
                let cut = integer::cut(k, name);
                cut.ok_or_else(|| Unreadable::new(&cast.as_token, "this cast of an integer"))?
            }
            Value::Integer(..) => {
                return Err(Unreadable::new(&cast.as_token, "this cast of an integer"));
            }
            Value::Scalar(n) if name == "f64" => Value::Scalar(n),
            Value::Scalar(x) if integer => match self.graph.constant_value(x) {
                Some(x) if x.is_finite() && x.abs() < 1e9 && fits(x as i64, name) => {
                    Value::Integer(x as i64, IntegerType::named(name))
                }
                _ => return self.whole_of(x, name, cast),
            },
            Value::Condition(holds) if integer => {
                let [one, zero] = [1, 0].map(|k| Value::Integer(k, IntegerType::named(name)));
                return self.joined(holds, &one, &zero, cast);
            }
            Value::Condition(_) => {
                return Err(Unreadable::new(
                    &cast.as_token,
                    "a cast of a condition to another type",
                ));
            }
            Value::Opaque(template) => {
                Value::Opaque(template.each(&|part| Template::Cast(Box::new(part), ty.clone())))
            }
            Value::Adt(adt) if integer => match self.discriminant(&adt) {
                Some(k) => Value::Integer(k, IntegerType::named(name)),
                None => return Err(Unreadable::new(&cast.as_token, "this cast")),
            },
            value @ (Value::Poison | Value::Never | Value::Left) => value,
            other => {
                self.mistake(&cast.as_token, format!("{} cannot be cast to {name}", other.name()))
            }
        })
    }
}

/// Returns true if an integer keeps its value under `as`.
pub fn fits(k: i64, name: &str) -> bool {
    match name {
        "u8" => u8::try_from(k).is_ok(),
        "i8" => i8::try_from(k).is_ok(),
        "u16" => u16::try_from(k).is_ok(),
        "i16" => i16::try_from(k).is_ok(),
        "u32" => u32::try_from(k).is_ok(),
        "i32" => i32::try_from(k).is_ok(),
        "usize" | "u64" | "u128" => k >= 0,
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use crate::lower::values::{Value, Values};
    use kin_graph::{Function2, Graph, Input};

    #[test]
    fn a_clamped_number_becomes_one_of_a_few_integers() {
        let mut values = Values::new(Graph::default());
        let x = values.graph.input(Input::Parameter(0));
        let zero = values.graph.zero();
        let two = values.graph.constant(2.0);
        let above = values.graph.call2(Function2::Max, x, zero);
        let within = values.graph.call2(Function2::Min, above, two);
        let cast = syn::parse_quote!(x as usize);
        let whole = values.whole_of(within, "usize", &cast);
        assert!(matches!(whole, Ok(Value::Choice(all)) if all.len() == 3));
        assert!(values.whole_of(x, "usize", &cast).is_err());
    }
}
