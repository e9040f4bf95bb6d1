//! Structs and enums: values with named parts. The interpreter reads the methods of a type that the
//! body declares. For any other type it knows only the fields of a literal, and rustc computes the
//! rest.

mod declared;
mod operators;

use quote::ToTokens;
use syn::{ExprStruct, Type};

pub use declared::Own;

use super::integer::IntegerType;
use super::value::{Adt, Components, Value};
use super::{Read, Reader, Unreadable};
use crate::vocabulary::is_integer;

impl Reader {
    /// Reads `Vec2 { x: …, y: … }`, `Link { length, ..other }`.
    pub fn struct_literal(&mut self, literal: &ExprStruct) -> Read {
        let name = literal.path.segments.last().map(|s| s.ident.to_string()).unwrap_or_default();
        let kind = match name.as_str() {
            "Vec2" => Some((&["x", "y"][..], Components::Vector(2))),
            "Vec3" => Some((&["x", "y", "z"][..], Components::Vector(3))),
            "EulerParameters" => Some((&["e0", "e1", "e2", "e3"][..], Components::Euler)),
            _ => None,
        };
        let rest = match &literal.rest {
            Some(rest) if is_default(rest) => Some(self.default_of(
                &Type::Path(syn::TypePath { qself: None, path: literal.path.clone() }),
                rest,
            )?),
            Some(rest) => Some(self.expression(rest)?),
            None => None,
        };
        let mut fields = Vec::new();
        for field in &literal.fields {
            let name = field.member.to_token_stream().to_string();
            fields.push((name, self.raw_expression(&field.expr)?, &field.expr));
        }
        let Some((names, kind)) = kind else {
            return self.own_literal(
                literal,
                &name,
                fields.into_iter().map(|(name, value, _)| (name, value)).collect(),
                rest,
            );
        };
        let mut nodes = Vec::new();
        for wanted in names {
            match (
                fields.iter().find(|(name, ..)| name == wanted),
                rest.as_ref().and_then(Value::components),
            ) {
                (Some((_, value, place)), _) => nodes.push(self.scalar(value.clone(), place)),
                (None, Some((_, known))) if known.len() == names.len() => {
                    nodes.push(known[nodes.len()])
                }
                (None, _) => {
                    return Ok(
                        self.mistake(literal, format!("`{name}` needs the field `{wanted}`"))
                    );
                }
            }
        }
        Ok(kind.value(nodes))
    }

    fn own_literal(
        &mut self,
        literal: &ExprStruct,
        name: &str,
        mut fields: Vec<(String, Value)>,
        rest: Option<Value>,
    ) -> Read {
        match rest {
            Some(Value::Adt(rest)) => {
                let others: Vec<_> = rest
                    .fields
                    .into_iter()
                    .filter(|(name, _)| fields.iter().all(|(given, _)| given != name))
                    .collect();
                fields.extend(others);
            }
            Some(Value::Poison) | None => {}
            Some(_) => {
                return Err(Unreadable::new(
                    &literal.dot2_token,
                    "the other fields of a value of another type",
                ));
            }
        }
        fields.sort_by(|(a, _), (b, _)| a.cmp(b));
        let path = self.own.whole_path(&literal.path);
        let adt = Adt { path, name: name.into(), fields, braces: true };
        let mistaken =
            self.mistaken_field(literal, &adt).or_else(|| self.integer_field(literal, &adt));
        Ok(mistaken.unwrap_or(Value::Adt(adt)))
    }

    /// Reports an integer in a field of a struct that is declared as a number.
    fn integer_field(&mut self, literal: &ExprStruct, adt: &Adt) -> Option<Value> {
        let wanted = &self.own.declared(&adt.type_name())?.fields;
        let integer = |field: &syn::FieldValue| {
            let name = field.member.to_token_stream().to_string();
            let ty = &wanted.iter().find(|(known, _)| *known == name)?.1;
            match adt.field(&name) {
                Some(Value::Integer(k, _)) if ty.to_token_stream().to_string() == "f64" => Some(*k),
                _ => None,
            }
        };
        let (place, k) =
            literal.fields.iter().find_map(|field| Some((&field.expr, integer(field)?)))?;
        Some(self.mistake(place, crate::error::integer_for_a_number(place, k)))
    }

    /// Reports a field that a type of the body does not have, that occurs twice, or that is
    /// missing.
    fn mistaken_field(&mut self, literal: &ExprStruct, adt: &Adt) -> Option<Value> {
        let wanted = self.own.declared(&adt.type_name())?.fields_of(&adt.name);
        let given: Vec<String> =
            literal.fields.iter().map(|field| field.member.to_token_stream().to_string()).collect();
        let mut known = given.iter().enumerate();
        let wrong =
            known.find(|(k, name)| !wanted.contains(&name.as_str()) || given[..*k].contains(name));
        let name = &adt.name;
        let (place, text): (&dyn ToTokens, String) = match wrong {
            Some((k, field)) if wanted.contains(&field.as_str()) => {
                (&literal.fields[k].member, format!("your code gives the field `{field}` twice"))
            }
            Some((k, field)) => {
                let all =
                    wanted.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
                (
                    &literal.fields[k].member,
                    format!("`{name}` has no field `{field}`: the fields are {all}"),
                )
            }
            None => {
                let missing = wanted.iter().find(|field| adt.field(field).is_none())?;
                (&literal.path, format!("`{name}` needs the field `{missing}`"))
            }
        };
        Some(self.mistake(place, text))
    }

    /// Reads `Slider(x)` with as many values as the type of the body has.
    pub fn own_tuple(
        &mut self,
        path: &syn::Path,
        arguments: Vec<Value>,
        at: &dyn ToTokens,
    ) -> Value {
        let adt = Adt::tuple(&self.own.whole_path(path), arguments);
        let wanted =
            self.own.declared(&adt.type_name()).map(|declared| declared.fields_of(&adt.name).len());
        match wanted {
            Some(wanted) if wanted != adt.fields.len() => {
                let text =
                    super::counted(&format!("`{}`", adt.name), wanted, "value", adt.fields.len());
                self.mistake(at, text)
            }
            _ => Value::Adt(adt),
        }
    }

    /// Calls a method of a type of the body; returns `None` if the type has no such method.
    pub fn own_method(
        &mut self,
        ty: &str,
        name: &str,
        arguments: Vec<Value>,
        at: &dyn ToTokens,
    ) -> Read<Option<Value>> {
        let Some((item, depth)) = self.own.function(ty, name, &arguments) else { return Ok(None) };
        self.own_call(&item, depth, arguments, at).map(Some)
    }

    fn own_call(
        &mut self,
        item: &syn::ItemFn,
        depth: usize,
        arguments: Vec<Value>,
        at: &dyn ToTokens,
    ) -> Read {
        self.calls += 1;
        if self.calls > super::MOST_CALLS {
            return Err(Unreadable::new(at, "a recursion of this depth"));
        }
        let value = self.apply_inner(item, depth, (arguments, &[]), None, at);
        self.calls -= 1;
        value
    }

    /// Reads a constant of a type of the body: `Link::LENGTH`, `<M8 as Thread>::PITCH`.
    pub fn own_constant(&mut self, path: &syn::ExprPath) -> Read<Option<Value>> {
        match self.own.by_path(path, &[]) {
            Some((item, depth))
                if item.sig.inputs.is_empty() && crate::vocabulary::is_type_name(path) =>
            {
                self.own_call(&item, depth, vec![], path).map(Some)
            }
            _ => Ok(None),
        }
    }

    /// Returns the value of `#[derive(Default)]`, or of the function `default` of the type.
    pub fn default_of(&mut self, ty: &Type, at: &dyn ToTokens) -> Read {
        let unknown = || Unreadable::new(at, "the default of this type");
        let name = ty.to_token_stream().to_string();
        match ty {
            _ if name == "f64" => Ok(Value::Scalar(self.graph.zero())),
            _ if name == "bool" => Ok(Value::Condition(self.graph.bool(false))),
            _ if is_integer(&name) => Ok(Value::Integer(0, IntegerType::named(&name))),
            Type::Tuple(tuple) => tuple
                .elems
                .iter()
                .map(|ty| self.default_of(ty, at))
                .collect::<Read<_>>()
                .map(Value::Tuple),
            Type::Array(array) => {
                let n = self.known_length(&array.len).filter(|n| *n <= super::MOST_NODES);
                let one = self.default_of(&array.elem, at)?;
                Ok(Value::Array(vec![one; n.ok_or_else(unknown)?]))
            }
            Type::Path(path) => {
                match path.path.segments.last().map(|last| last.ident.to_string()) {
                    Some(name) if name == "Vec" => Ok(Value::Array(vec![])),
                    Some(name) if name == "Option" => Ok(Value::none()),
                    Some(name) => self.default_of_own(&name, at),
                    None => Err(unknown()),
                }
            }
            _ => Err(unknown()),
        }
    }

    fn default_of_own(&mut self, name: &str, at: &dyn ToTokens) -> Read {
        if let Some(value) = self.own_method(name, "default", vec![], at)? {
            return Ok(value);
        }
        let ident = proc_macro2::Ident::new(name, proc_macro2::Span::call_site());
        let Some(declared) = self.own.declared(name).filter(|declared| declared.derives("Default"))
        else {
            return Err(Unreadable::new(at, "the default of this type"));
        };
        if let Some(variant) = &declared.default {
            let variant = proc_macro2::Ident::new(variant, proc_macro2::Span::call_site());
            return Ok(Value::Adt(Adt::tuple(&syn::parse_quote!(#ident::#variant), vec![])));
        }
        let fields = declared.fields.clone();
        let braces = declared.braces;
        let values = fields.into_iter().map(|(name, ty)| Ok((name, self.default_of(&ty, at)?)));
        let fields = values.collect::<Read<Vec<_>>>()?;
        Ok(Value::Adt(Adt { path: ident.into(), name: name.into(), fields, braces }))
    }

    /// Returns the integer of a variant without fields.
    pub fn discriminant(&self, adt: &Adt) -> Option<i64> {
        let variants = &self.own.declared(&adt.type_name())?.variants;
        variants.iter().find(|variant| variant.name == adt.name)?.integer
    }
}

/// Returns true for `Default::default()`.
fn is_default(expression: &syn::Expr) -> bool {
    matches!(expression, syn::Expr::Call(call) if call.args.is_empty()
        && matches!(&*call.func, syn::Expr::Path(path) if crate::vocabulary::names(path) == ["Default", "default"]))
}
