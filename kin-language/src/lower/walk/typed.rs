//! Values with a declared type in the body.

use quote::ToTokens;
use syn::Type;

use super::Reader;
use crate::lower::values::{
    Adt, Branching, Function, IntegerType, MOST_TURNS, Read, Unreadable, Value, named,
};
use crate::parse::{Shape, literal_length, shape};
use crate::vocabulary::{is_integer, type_argument};

impl Reader {
    /// Converts a value to a declared type.
    pub fn typed(&mut self, value: Value, ty: &Type, at: &dyn ToTokens) -> Read {
        let value = match (value, ty) {
            (value @ (Value::Poison | Value::Left), _) => return Ok(value),
            (value @ Value::Place(_), Type::Reference(_)) => return Ok(value),
            (value @ Value::Place(_), ty) => {
                let value = self.loaded(value);
                return self.typed(value, ty, at);
            }
            (value @ Value::Choice(_), ty) => {
                return self.each(value, at, &mut |reader, value| reader.typed(value, ty, at));
            }
            (Value::Array(all), Type::Slice(slice)) => {
                return self.typed_elements(all, &slice.elem, at);
            }
            (value @ Value::Iterator(_), Type::ImplTrait(_)) => return Ok(value),
            (Value::Adt(adt), Type::Path(path)) => return self.typed_adt(adt, path, at),
            (
                value @ Value::Function(_),
                Type::ImplTrait(_) | Type::BareFn(_) | Type::TraitObject(_),
            ) => {
                return Ok(value);
            }
            (Value::Into(inner), ty) if shape(ty).is_none() => {
                return self.typed_into(*inner, ty, at);
            }
            (Value::Reference(inner), Type::Reference(ty)) => {
                return Ok(Value::Reference(Box::new(self.typed(*inner, &ty.elem, at)?)));
            }
            (value, Type::Reference(ty)) => return self.typed(value, &ty.elem, at),
            (value, Type::Paren(ty)) => return self.typed(value, &ty.elem, at),
            (value, Type::Group(ty)) => return self.typed(value, &ty.elem, at),
            (value, Type::Infer(_)) => return Ok(value),
            (Value::Generator(f), ty) => return self.generated(&f, ty, at),
            (Value::Array(all), Type::Array(array))
                if self.is_of_another_length(&all, array, at) =>
            {
                return Ok(Value::Poison);
            }
            (Value::Array(all), Type::Array(array))
                if literal_length(&array.len).is_none_or(|n| n == all.len()) =>
            {
                return self.typed_elements(all, &array.elem, at);
            }
            (Value::Tuple(all), Type::Tuple(tuple)) if all.len() == tuple.elems.len() => {
                return all
                    .into_iter()
                    .zip(&tuple.elems)
                    .map(|(part, ty)| self.typed(part, ty, at))
                    .collect::<Read<_>>()
                    .map(Value::Tuple);
            }
            (value, _) => value,
        };
        self.of_type(value, ty, at)
    }

    /// Converts a value to a type that is no reference, list or tuple.
    fn of_type(&mut self, value: Value, ty: &Type, at: &dyn ToTokens) -> Read {
        match (shape(ty), named(ty).as_str()) {
            (Some(shape), _) => Ok(self.shaped(value, &shape, at)),
            (None, "bool") => Ok(Value::Condition(self.condition(value, at))),
            (None, "f32") => Ok(self.mistake(ty, "write `f64`: Kin computes with `f64` only")),
            (None, name) if is_integer(name) => self.typed_integer(value, name, at),
            (None, "Vec") => self.typed_list(value, ty, at),
            (None, "Vector2") => Ok(self.shaped(value, &Shape::Vector(2), at)),
            (None, "Vector3") => Ok(self.shaped(value, &Shape::Vector(3), at)),
            (None, "Box" | "Rc" | "Arc") => self.typed_inside(value, ty, at),
            (None, "Planar" | "PlanarState") if matches!(value, Value::Planar(_)) => Ok(value),
            (None, "Spatial" | "SpatialState") if matches!(value, Value::Spatial(_)) => Ok(value),
            (None, name @ ("PlanarState" | "SpatialState"))
                if !matches!(value, Value::Opaque(_)) =>
            {
                let family = if name == "PlanarState" { "a planar" } else { "a spatial" };
                let text =
                    format!("expected the state of {family} body, but found {}", value.name());
                Ok(self.mistake(at, text))
            }
            (None, "Coord" | "Time") if matches!(value, Value::Scalar(_)) => Ok(value),
            (None, name) => match value {
                Value::Opaque(_) | Value::Never | Value::Unassigned => Ok(value),
                Value::Axis(_) if name == "Axis" => Ok(value),
                Value::Function(_) if !matches!(ty, Type::Path(_)) => Ok(value),
                Value::Law(_) if name == "Law" => Ok(value),
                _ => Err(Unreadable::new(
                    ty,
                    format!("a value of type `{}`", crate::error::tidy_text(ty)),
                )),
            },
        }
    }

    /// Converts the values in an `Option<T>` or a struct to the declared types of its parts.
    fn typed_adt(&mut self, mut adt: Adt, path: &syn::TypePath, at: &dyn ToTokens) -> Read {
        let last = path.path.segments.last();
        if let (Some(ty), "Some" | "Ok") = (type_argument(&path.path), adt.name.as_str())
            && last.is_some_and(|last| last.ident == "Option" || last.ident == "Result")
        {
            for (_, value) in &mut adt.fields {
                *value = self.typed(value.clone(), ty, at)?;
            }
        }
        Ok(Value::Adt(adt))
    }

    /// Reads `value.into()` at a place whose type is no shape.
    fn typed_into(&mut self, value: Value, ty: &Type, at: &dyn ToTokens) -> Read {
        match named(ty).as_str() {
            "Vector2" | "Vector3" | "Option" => {
                let value = self.loaded(value);
                let value = if named(ty) == "Option" && !matches!(value, Value::Adt(_)) {
                    Value::some(value)
                } else {
                    value
                };
                self.typed(value, ty, at)
            }
            name if self.own.is_type(name) => {
                let made = self.own_method(name, "from", vec![value], at)?;
                made.ok_or_else(|| Unreadable::new(ty, format!("a conversion into `{name}`")))
            }
            _ => Err(Unreadable::new(
                ty,
                format!("a conversion into `{}`", crate::error::tidy_text(ty)),
            )),
        }
    }

    /// Converts the value in a `Box<T>`.
    fn typed_inside(&mut self, value: Value, ty: &Type, at: &dyn ToTokens) -> Read {
        let Type::Path(path) = ty else { return Ok(value) };
        match type_argument(&path.path) {
            Some(inner) => self.typed(value, inner, at),
            None => Ok(value),
        }
    }

    fn typed_elements(&mut self, all: Vec<Value>, ty: &Type, at: &dyn ToTokens) -> Read {
        let all = all.into_iter().map(|part| self.typed(part, ty, at));
        all.collect::<Read<_>>().map(Value::Array)
    }

    /// Converts the elements of a `Vec<T>` whose length is known here.
    fn typed_list(&mut self, value: Value, ty: &Type, at: &dyn ToTokens) -> Read {
        let (Value::Array(all) | Value::Iterator(all), Type::Path(path)) = (value, ty) else {
            return Err(Unreadable::new(ty, "a list of unknown length"));
        };
        match type_argument(&path.path) {
            Some(part) => self.typed_elements(all, part, at),
            None => Ok(Value::Array(all)),
        }
    }

    /// Reads `std::array::from_fn(f)` with the length from its type.
    fn generated(&mut self, f: &Function, ty: &Type, at: &dyn ToTokens) -> Read {
        let Type::Array(array) = ty else {
            return Err(Unreadable::new(at, "an array of unknown length"));
        };
        let length = match literal_length(&array.len) {
            Some(n) => i64::try_from(n).ok(),
            None => match self.expression(&array.len)? {
                Value::Integer(n, _) => Some(n),
                _ => None,
            },
        };
        let Some(n) = length.filter(|n| (0..=MOST_TURNS).contains(n)) else {
            return Err(Unreadable::new(&array.len, "an array of unknown length"));
        };
        let all = (0..n).map(|k| {
            let part = self.apply(f, vec![Value::Integer(k, Some(IntegerType::SIZE))], &[], at)?;
            self.typed(part, &array.elem, at)
        });
        all.collect::<Read<_>>().map(Value::Array)
    }
}

#[cfg(test)]
mod tests {
    use crate::lower::values::Value;
    use crate::lower::walk::Reader;
    use kin_graph::Graph;

    fn read(expression: syn::Expr) -> (Reader, Option<Value>) {
        let mut reader = Reader::new(Graph::default());
        let value = reader.expression(&expression).ok();
        (reader, value)
    }

    #[test]
    fn a_declared_type_converts_a_value() {
        let (_, value) = read(syn::parse_quote!({
            let all: [usize; 3] = std::array::from_fn(|k| k * k);
            all[2]
        }));
        assert!(matches!(value, Some(Value::Integer(4, _))));
        let (reader, _) = read(syn::parse_quote!({
            let x: f64 = 1;
            x
        }));
        assert!(!reader.mistakes.is_empty());
    }
}
