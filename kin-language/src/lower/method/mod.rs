//! Methods, by the kind of their receiver.

mod axis;
mod changing;
mod components;
mod going;
mod list;
mod opaque;
mod option;
mod order;
mod scalar;
mod state;

use quote::ToTokens;
use syn::{Expr, ExprMethodCall};

use super::template::Template;
use super::value::Value;
use super::{Read, Reader, Unreadable};
pub use changing::takes_itself;
use kin_graph::Node;
pub use scalar::KINDS_OF_NUMBERS;

/// A method call: its name, the values of its arguments, and their expressions for messages.
struct Call<'a> {
    name: String,
    arguments: Vec<Value>,
    places: Vec<&'a Expr>,
    whole: &'a ExprMethodCall,
}

impl Reader {
    pub fn method_call(&mut self, whole: &ExprMethodCall) -> Read {
        let name = whole.method.to_string();
        if let ("contains", Expr::Range(range)) = (name.as_str(), strip(&whole.receiver)) {
            return self.range_contains(range, whole);
        }
        if let Some(value) = self.changing_method(&name, whole)? {
            return Ok(value);
        }
        let receiver = self.raw_expression(&whole.receiver)?;
        let arguments = self.expressions(whole.args.iter())?;
        self.method_with(whole, std::iter::once(receiver).chain(arguments).collect())
    }

    /// Calls a method with the first value as the receiver and the others as arguments.
    pub fn method_with(&mut self, whole: &ExprMethodCall, mut all: Vec<Value>) -> Read {
        let name = whole.method.to_string();
        let places = whole.args.iter().collect::<Vec<_>>();
        if let Some(receiver) = all.first_mut() {
            let old = std::mem::replace(receiver, Value::Poison);
            *receiver = match old {
                Value::Reference(_) if name == "iter" || name == "into_iter" => old,
                Value::Place(_) if matches!(name.as_str(), "iter_mut" | "into_iter") => old,
                old => self.loaded(old),
            };
        }
        self.each_list(all, &whole.method, &mut |reader, mut all| {
            let arguments = all.split_off(1);
            let call = Call { name: name.clone(), arguments, places: places.clone(), whole };
            reader.method_of(all.pop().unwrap_or(Value::Poison), call)
        })
    }

    /// Calls a method of a value of one kind.
    fn method_of(&mut self, receiver: Value, call: Call) -> Read {
        let whole = call.whole;
        match (receiver, call.name.as_str(), &call.arguments[..]) {
            (value @ (Value::Poison | Value::Never | Value::Left), ..) => Ok(value),
            (Value::Opaque(template), ..) => self.opaque_method(template, call),
            (Value::Iterator(all), ..) => self.list_method(all, false, call),
            (Value::Endless(endless), ..) => self.endless_method(endless, &call.arguments, whole),
            (Value::Reference(inner), "into_iter", []) => {
                self.method_of(*inner, Call { name: "iter".into(), ..call })
            }
            (Value::Reference(inner), ..) => self.method_of(*inner, call),
            (value @ Value::Place(_), ..) => match self.elements(value, &whole.receiver)? {
                Some(all) => Ok(Value::Iterator(all)),
                None => Ok(Value::Poison),
            },
            (Value::Adt(adt), ..)
                if matches!(adt.name.as_str(), "Some" | "None" | "Ok" | "Err") =>
            {
                self.option_method(adt, &call)
            }
            (Value::Adt(adt), ..) if order::is_order(&adt.name) => self.order_method(&adt, &call),
            (value @ Value::Adt(_), ..) => self.method_of_own(value, call),
            (
                value,
                "clone" | "to_owned" | "borrow" | "as_ref" | "as_slice" | "as_mut" | "by_ref"
                | "each_ref" | "copied" | "cloned",
                [],
            ) if !matches!(value, Value::Scalar(_)) || call.name != "copied" => Ok(value),
            (value, "into", []) => Ok(Value::Into(Box::new(value))),
            (Value::Scalar(n), ..) => {
                let arguments =
                    std::iter::once(Value::Scalar(n)).chain(call.arguments.iter().cloned());
                match self.own_method("f64", &call.name, arguments.collect(), &call)? {
                    Some(value) => Ok(value),
                    None => self.scalar_method(n, &call),
                }
            }
            (Value::Integer(k, ty), ..) => self.integer_method(k, ty, &call),
            (Value::Vector(v), ..) => self.vector_method(&v, &call),
            (Value::Matrix(n, m), ..) => self.matrix_method(n, &m, &call),
            (Value::Euler(p), ..) => self.euler_method(&p, &call),
            (Value::Planar(slot), ..) => self.state_method(slot, 2, &call),
            (Value::Spatial(slot), ..) => self.state_method(slot, 3, &call),
            (Value::Law(law), ..) => self.law_method(law, &call),
            (Value::Array(all), ..) => self.list_method(all, true, call),
            (Value::Into(_) | Value::Generator(_), ..) => {
                Err(Unreadable::new(&whole.method, "a method of a value of unknown type"))
            }
            (Value::Condition(holds), ..) => self.condition_method(holds, &call),
            (other, ..) => Ok(self.unknown(&call, &other.name(), "")),
        }
    }

    /// Calls a method of a struct or an enum.
    fn method_of_own(&mut self, value: Value, call: Call) -> Read {
        let Value::Adt(adt) = &value else { return Ok(Value::Poison) };
        if call.name == "clone" && call.arguments.is_empty() {
            return Ok(value);
        }
        let arguments =
            std::iter::once(value.clone()).chain(call.arguments.iter().cloned()).collect();
        if let Some(value) = self.own_method(&adt.type_name(), &call.name, arguments, &call)? {
            return Ok(value);
        }
        if let Some(told) = self.no_such_method(&adt.type_name(), &call.whole.method) {
            return Ok(told);
        }
        let template = self.template(value, &call.whole.receiver)?;
        self.opaque_method(template, call)
    }

    fn unknown(&mut self, call: &Call, receiver: &str, cure: &str) -> Value {
        self.mistake(&call.whole.method, format!("{receiver} has no method `{}`{cure}", call.name))
    }

    /// Returns true if there are `count` arguments, else reports a mistake.
    fn counted(&mut self, count: usize, call: &Call) -> bool {
        let found = call.arguments.len();
        if found != count {
            let text = super::counted(&format!("`{}`", call.name), count, "argument", found);
            self.mistake(&call.whole.method, text);
        }
        found == count
    }

    /// Returns the arguments as numbers, if there are `count` of them.
    fn scalars_of(&mut self, count: usize, call: &Call) -> Option<Vec<Node>> {
        if !self.counted(count, call) {
            return None;
        }
        Some(
            call.arguments
                .iter()
                .zip(&call.places)
                .map(|(value, place)| self.scalar(value.clone(), place))
                .collect(),
        )
    }

    /// Reads `(low..=high).contains(&x)`.
    fn range_contains(&mut self, range: &syn::ExprRange, whole: &ExprMethodCall) -> Read {
        let (Some(x), 1) = (whole.args.first(), whole.args.len()) else {
            return Err(Unreadable::new(&whole.method, "this `contains`"));
        };
        let lower =
            range.start.as_ref().map(|bound| (&**bound, syn::BinOp::Ge(syn::token::Ge::default())));
        let upper = range.end.as_ref().map(|bound| match range.limits {
            syn::RangeLimits::Closed(_) => (&**bound, syn::BinOp::Le(syn::token::Le::default())),
            syn::RangeLimits::HalfOpen(_) => (&**bound, syn::BinOp::Lt(syn::token::Lt::default())),
        });
        let mut all = self.graph.bool(true);
        for (bound, op) in [lower, upper].into_iter().flatten() {
            let comparison = syn::ExprBinary {
                attrs: vec![],
                left: Box::new(x.clone()),
                op,
                right: Box::new(bound.clone()),
            };
            let value = self.binary(&comparison)?;
            let one = self.condition(value, whole);
            all = self.graph.and(all, one);
        }
        Ok(Value::Condition(all))
    }

    /// Reads `law.at(x)` and `law.slope(x)`.
    fn law_method(&mut self, law: Template, call: &Call) -> Read {
        let order = match call.name.as_str() {
            "at" => 0,
            "slope" => 1,
            _ => {
                return Ok(self.unknown(
                    call,
                    "a Law",
                    ": write `.at(x)` for a value and `.slope(x)` for a derivative",
                ));
            }
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
