//! Methods, by the kind of their receiver.

mod components;
mod list;
mod opaque;
mod scalar;
mod state;

use quote::ToTokens;
use syn::{Expr, ExprMethodCall};

use super::template::Template;
use super::value::Value;
use super::{Read, Reader, Unreadable};
use kin_graph::Node;

/// A method call: its name, its arguments' values, and their expressions for messages.
struct Call<'a> {
    name: String,
    arguments: Vec<Value>,
    places: Vec<&'a Expr>,
    whole: &'a ExprMethodCall,
}

impl Reader {
    pub fn method_call(&mut self, whole: &ExprMethodCall) -> Read {
        let (name, places) = (whole.method.to_string(), whole.args.iter().collect::<Vec<_>>());
        if let ("contains", Expr::Range(range)) = (name.as_str(), strip(&whole.receiver)) {
            return self.range_contains(range, whole);
        }
        let receiver = self.expression(&whole.receiver)?;
        let arguments = self.expressions(whole.args.iter())?;
        let call = Call { name, arguments, places, whole };
        match (receiver, call.name.as_str(), &call.arguments[..]) {
            (value @ (Value::Poison | Value::Never), ..) => Ok(value),
            (Value::Opaque(template), ..) => self.opaque_method(template, call),
            (Value::Iterator(all), ..) => self.list_method(all, false, call),
            (value, "clone" | "to_owned" | "borrow" | "as_ref" | "as_slice" | "each_ref", []) => Ok(value),
            (value, "into", []) => Ok(Value::Into(Box::new(value))),
            (Value::Scalar(n), ..) => self.scalar_method(n, &call),
            (Value::Integer(k, ty), ..) => self.integer_method(k, ty, &call),
            (Value::Vector(v), ..) => self.vector_method(&v, &call),
            (Value::Matrix(n, m), ..) => self.matrix_method(n, &m, &call),
            (Value::Euler(p), ..) => self.euler_method(&p, &call),
            (Value::Planar(slot), ..) => self.state_method(slot, 2, &call),
            (Value::Spatial(slot), ..) => self.state_method(slot, 3, &call),
            (Value::Law(law), ..) => self.law_method(law, &call),
            (Value::Array(all), ..) => self.list_method(all, true, call),
            (Value::Into(_) | Value::Generator(_), ..) => {
                Err(Unreadable::new(&whole.method, "a method of a value whose type is not known here"))
            }
            (Value::Condition(_), "then" | "then_some" | "not" | "cmp" | "eq" | "ne", _) => {
                Err(Unreadable::new(&whole.method, format!("`{}` of a condition", call.name)))
            }
            (Value::Condition(_), ..) => Ok(self.unknown(&call, "a condition", "; a number of it is `if … { 1.0 } else { 0.0 }`")),
            (other, ..) => Ok(self.unknown(&call, &other.name(), "")),
        }
    }

    fn unknown(&mut self, call: &Call, receiver: &str, cure: &str) -> Value {
        self.mistake(&call.whole.method, format!("{receiver} has no method `{}`{cure}", call.name))
    }

    /// Notes a mistake unless there are `count` arguments.
    fn counted(&mut self, count: usize, call: &Call) -> bool {
        let found = call.arguments.len();
        if found != count {
            let text = super::counted(&format!("`{}`", call.name), count, "argument", found);
            self.mistake(&call.whole.method, text);
        }
        found == count
    }

    /// The arguments as numbers, if there are `count` of them.
    fn scalars_of(&mut self, count: usize, call: &Call) -> Option<Vec<Node>> {
        if !self.counted(count, call) {
            return None;
        }
        Some(call.arguments.iter().zip(&call.places).map(|(value, place)| self.scalar(value.clone(), place)).collect())
    }

    /// `(low..=high).contains(&x)`
    fn range_contains(&mut self, range: &syn::ExprRange, whole: &ExprMethodCall) -> Read {
        let (Some(x), 1) = (whole.args.first(), whole.args.len()) else { return Err(Unreadable::new(&whole.method, "this `contains`")) };
        let lower = range.start.as_ref().map(|bound| (&**bound, syn::BinOp::Ge(syn::token::Ge::default())));
        let upper = range.end.as_ref().map(|bound| match range.limits {
            syn::RangeLimits::Closed(_) => (&**bound, syn::BinOp::Le(syn::token::Le::default())),
            syn::RangeLimits::HalfOpen(_) => (&**bound, syn::BinOp::Lt(syn::token::Lt::default())),
        });
        let mut all = self.graph.bool(true);
        for (bound, op) in [lower, upper].into_iter().flatten() {
            let comparison = syn::ExprBinary { attrs: vec![], left: Box::new(x.clone()), op, right: Box::new(bound.clone()) };
            let value = self.binary(&comparison)?;
            let one = self.condition(value, whole);
            all = self.graph.and(all, one);
        }
        Ok(Value::Condition(all))
    }

    /// `law.at(x)` and `law.slope(x)`
    fn law_method(&mut self, law: Template, call: &Call) -> Read {
        let order = match call.name.as_str() {
            "at" => 0,
            "slope" => 1,
            _ => return Ok(self.unknown(call, "a Law", "; ask it for a value with `.at(x)`, for its derivative with `.slope(x)`")),
        };
        let Some(x) = self.scalars_of(1, call) else { return Ok(Value::Poison) };
        let number = *self.law_index.entry(law.key()).or_insert_with(|| {
            self.laws.push(law);
            self.laws.len() - 1
        });
        let value = self.graph.law(number, x[0], order);
        Ok(Value::Scalar(value))
    }
}

fn strip(expression: &Expr) -> &Expr {
    match expression {
        Expr::Paren(inner) => strip(&inner.expr),
        Expr::Group(inner) => strip(&inner.expr),
        other => other,
    }
}

impl ToTokens for Call<'_> {
    fn to_tokens(&self, tokens: &mut proc_macro2::TokenStream) {
        self.whole.to_tokens(tokens);
    }
}
