//! Methods and exchanges by their paths: `Planar::point(&i, u)`, `std::mem::swap(&mut a, &mut b)`.

use quote::ToTokens;
use syn::{Expr, ExprPath};

use super::call::Call;
use super::value::Value;
use super::{Read, Reader, Unreadable};

impl Reader {
    /// Returns true if a value has the type with which the path of a method begins.
    pub fn is_receiver(&self, ty: &str, value: &Value) -> bool {
        let value = self.loaded(value.clone());
        match ty {
            "Vec2" | "Vec3" => matches!(value, Value::Vector(_)),
            "Mat2" | "Mat3" => matches!(value, Value::Matrix(..)),
            "EulerParameters" => matches!(value, Value::Euler(_)),
            "Planar" => matches!(value, Value::Planar(_) | Value::Choice(_)),
            "Spatial" => matches!(value, Value::Spatial(_) | Value::Choice(_)),
            "Law" => matches!(value, Value::Law(_)),
            "Vec" => matches!(value, Value::Array(_)),
            _ => matches!(value, Value::Adt(_) | Value::Choice(_)),
        }
    }

    /// Reads `Planar::point(&i, u)` as `i.point(u)`.
    pub fn method_by_path(
        &mut self,
        path: &ExprPath,
        arguments: Vec<Value>,
        places: &[&Expr],
        at: &dyn ToTokens,
    ) -> Read {
        let (Some(method), Some((receiver, rest))) =
            (path.path.segments.last(), places.split_first())
        else {
            return Err(Unreadable::new(at, "this function"));
        };
        let method = &method.ident;
        let rest = rest.iter();
        let whole: syn::ExprMethodCall = syn::parse_quote!((#receiver).#method(#(#rest),*));
        self.method_with(&whole, arguments)
    }

    /// Reads `std::mem::swap(&mut a, &mut b)`, and `replace` and `take` of the same module.
    pub fn exchange(&mut self, name: &str, arguments: Vec<Value>, call: &Call) -> Read {
        let unreadable = || Unreadable::new(call.path, "an exchange of unknown values");
        let (Some(Value::Place(a)), second) = (arguments.first(), arguments.get(1)) else {
            return Err(unreadable());
        };
        let old = self.at_place(a).ok_or_else(unreadable)?;
        let new = match (name, second) {
            ("swap", Some(Value::Place(b))) => {
                let other = self.at_place(b).ok_or_else(unreadable)?;
                self.put_at(b, old.clone(), call.at).ok_or_else(unreadable)?;
                other
            }
            ("replace", Some(value)) => value.clone(),
            ("take", None) if matches!(old, Value::Scalar(_)) => Value::Scalar(self.graph.zero()),
            ("take", None) if matches!(old, Value::Adt(_)) => Value::none(),
            _ => return Err(unreadable()),
        };
        self.put_at(a, new, call.at).ok_or_else(unreadable)?;
        Ok(if name == "swap" { Value::unit() } else { old })
    }
}
