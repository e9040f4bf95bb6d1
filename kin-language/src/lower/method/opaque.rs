//! Methods of values that only rustc knows.

use quote::{ToTokens, quote};

use super::Call;
use crate::lower::template::Template;
use crate::lower::value::Value;
use crate::lower::{Read, Reader, Unreadable};
use crate::parse::Shape;
use crate::vocabulary::{is_scalar_method, is_vector_method};

impl Reader {
    /// Where a number is needed for it to be read, a name of f64's vocabulary takes the receiver for one, and a vector beside it takes it for
    /// a vector; unless the receiver is a parameter itself, whose type is the user's.
    pub(super) fn opaque_method(&mut self, template: Template, call: Call) -> Read {
        let own = matches!(template, Template::Parameter(_));
        if own && matches!(call.name.as_str(), "point" | "direction" | "local") {
            let text = format!(
                "`{}` has a type the macro does not know, so `{}` cannot be read: types go by name; if it is an alias of `Planar` or \
                 `Spatial`, write that name itself",
                call.whole.receiver.to_token_stream(),
                call.name
            );
            return Ok(self.mistake(&call.whole.receiver, text));
        }
        if call.arguments.iter().any(|value| matches!(value, Value::Function(_) | Value::Iterator(_))) {
            return Err(Unreadable::new(&call.whole.method, "a closure handed to a function of your own"));
        }
        let numbers = !template.nodes().is_empty() || call.arguments.iter().any(|value| value.numbers().is_some());
        match (call.name.as_str(), call.arguments.first().map(|value| value.clone().referent())) {
            ("sin_cos", None) if !own => self.number_method(template, &call),
            (name, _) if is_scalar_method(name) && numbers && !own => self.number_method(template, &call),
            (name, Some(Value::Vector(v))) if is_vector_method(name) && !own => {
                let receiver = self.vector(Value::Opaque(template), v.len(), &call.whole.receiver);
                self.vector_method(&receiver, &call)
            }
            _ => {
                let templates = call.arguments.into_iter().zip(call.places).map(|(value, place)| self.template(value, place));
                let templates = templates.collect::<Read<Vec<_>>>()?;
                let (method, turbofish) = (&call.whole.method, &call.whole.turbofish);
                let name = quote!(#method #turbofish);
                Ok(Value::Opaque(template.each(&|part| Template::Method(Box::new(part), name.clone(), templates.clone()))))
            }
        }
    }

    fn number_method(&mut self, template: Template, call: &Call) -> Read {
        match self.shaped(Value::Opaque(template), &Shape::Scalar, &call.whole.receiver) {
            Value::Scalar(n) => self.scalar_method(n, call),
            other => Ok(other),
        }
    }
}
