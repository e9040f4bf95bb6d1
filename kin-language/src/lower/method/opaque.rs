//! Methods of values that only rustc knows.

use quote::{ToTokens, quote};

use super::Call;
use crate::lower::template::Template;
use crate::lower::value::Value;
use crate::lower::{Read, Reader, Unreadable};
use crate::parse::{Shape, literal_length};
use crate::vocabulary::{is_integer, is_scalar_method, is_vector_method};

impl Reader {
    /// Calls a method of a value that only rustc knows.
    ///
    /// If the interpreter needs the type of the receiver, a method name of f64 makes the receiver a
    /// number, and a vector as argument makes it a vector. A receiver that is itself a parameter is
    /// an exception: the user's program decides its type.
    pub(super) fn opaque_method(&mut self, template: Template, call: Call) -> Read {
        if matches!(call.name.as_str(), "iter" | "into_iter" | "len" | "windows" | "chunks" | "map")
            && let Some(all) = self.integers_of(&template)
        {
            return self.list_method(all, true, call);
        }
        let own = matches!(template, Template::Parameter(_));
        let applies = call.arguments.iter().any(|value| matches!(value, Value::Function(_)));
        if self.is_option(&template)
            || applies && super::option::WITH_CLOSURES.contains(&call.name.as_str())
        {
            return self.option_at_run_time(template, &call);
        }
        if applies || call.arguments.iter().any(|value| matches!(value, Value::Iterator(_))) {
            return Err(Unreadable::new(
                &call.whole.method,
                "a closure passed to a user-defined function",
            ));
        }
        let numbers = !template.nodes().is_empty()
            || call.arguments.iter().any(|value| value.numbers().is_some());
        match (call.name.as_str(), call.arguments.first().map(|value| value.clone().referent())) {
            ("sin_cos", None) if !own => self.number_method(template, &call),
            (name, _) if is_scalar_method(name) && numbers && !own => {
                self.number_method(template, &call)
            }
            (name, Some(Value::Vector(v))) if is_vector_method(name) && !own => {
                let receiver = self.vector(Value::Opaque(template), v.len(), &call.whole.receiver);
                self.vector_method(&receiver, &call)
            }
            _ => {
                let templates = call
                    .arguments
                    .into_iter()
                    .zip(call.places)
                    .map(|(value, place)| self.template(value, place));
                let templates = templates.collect::<Read<Vec<_>>>()?;
                let method = &call.whole.method;
                let turbofish = &call.whole.turbofish;
                let name = quote!(#method #turbofish);
                Ok(Value::Opaque(template.each(&|part| {
                    Template::Method(Box::new(part), name.clone(), templates.clone())
                })))
            }
        }
    }

    fn number_method(&mut self, template: Template, call: &Call) -> Read {
        match self.shaped(Value::Opaque(template), &Shape::Scalar, &call.whole.receiver) {
            Value::Scalar(n) => self.scalar_method(n, call),
            other => Ok(other),
        }
    }

    /// Returns the elements of a parameter whose type is an array of integers or conditions; the
    /// type gives their number.
    pub fn integers_of(&self, template: &Template) -> Option<Vec<Value>> {
        let Template::Parameter(name) = template else { return None };
        let syn::Type::Array(array) = self.parameter_types.get(&name.to_string())? else {
            return None;
        };
        let element = array.elem.to_token_stream().to_string();
        let n = literal_length(&array.len).filter(|_| element == "bool" || is_integer(&element))?;
        let at = |k: usize| {
            let k = Template::Tokens(proc_macro2::Literal::usize_unsuffixed(k).to_token_stream());
            Value::Opaque(Template::Index(Box::new(template.clone()), Box::new(k)))
        };
        Some((0..n).map(at).collect())
    }

    /// Returns true if a value is a parameter of the type `Option`.
    fn is_option(&self, template: &Template) -> bool {
        let Template::Parameter(name) = template else { return false };
        let named = |ty: &syn::Type| matches!(ty, syn::Type::Path(path) if path.path.segments.last().is_some_and(|last| last.ident == "Option"));
        self.parameter_types.get(&name.to_string()).is_some_and(named)
    }

    /// Calls a method of an `Option` that only rustc knows: once with `Some` and the inner value,
    /// and once with `None`.
    fn option_at_run_time(&mut self, template: Template, call: &Call) -> Read {
        let held: syn::Pat = syn::parse_quote!(Some(held));
        self.scopes.push();
        let matched = self.test(&held, &Value::Opaque(template));
        let value = self.named("held").cloned().unwrap_or(Value::Poison);
        self.scopes.pop();
        let matched = matched?;
        let some = Value::some(value);
        let none = Value::none();
        let option = self.joined(matched, &some, &none, call)?;
        self.each(option, call, &mut |reader, value| match value {
            Value::Adt(adt) => reader.option_method(adt, call),
            value => Ok(value),
        })
    }
}
