//! Functions with generics inside the body: the types and lengths of a call, from the values of its
//! arguments.

use std::collections::BTreeMap;

use quote::ToTokens;
use syn::visit_mut::VisitMut;
use syn::{
    Expr, FnArg, GenericArgument, GenericParam, ItemFn, PathArguments, Type, parse_quote, visit_mut,
};

use super::{Own, Value};

/// The types and numbers of the generics of a function in one call.
#[derive(Default)]
pub struct Found {
    types: BTreeMap<String, Type>,
    pub lengths: BTreeMap<String, usize>,
}

/// Returns the known generics of a function, or `None` if it has no generics.
pub fn found(
    item: &ItemFn,
    arguments: &[Value],
    given: Option<&syn::AngleBracketedGenericArguments>,
    own: &Own,
    length: &dyn Fn(&Expr) -> Option<usize>,
) -> Option<Found> {
    let generics = &item.sig.generics;
    if generics.params.is_empty()
        && !item.sig.inputs.iter().any(|input| matches!(input, FnArg::Receiver(_)))
    {
        return None;
    }
    let mut found = Found::default();
    // A generic about which no argument says anything may be any type.
    found.types.extend(
        generics.type_params().map(|parameter| (parameter.ident.to_string(), parse_quote!(_))),
    );
    let names: Vec<String> = generics.params.iter().filter_map(parameter_name).collect();
    for (name, given) in names.iter().zip(given.iter().flat_map(|given| &given.args)) {
        match given {
            GenericArgument::Type(Type::Path(path))
                if generics.const_params().any(|parameter| parameter.ident == name) =>
            {
                let path = &path.path;
                found.lengths.extend(length(&parse_quote!(#path)).map(|n| (name.clone(), n)));
            }
            GenericArgument::Type(ty) => drop(found.types.insert(name.clone(), ty.clone())),
            GenericArgument::Const(value) => {
                found.lengths.extend(length(value).map(|n| (name.clone(), n)))
            }
            _ => {}
        }
    }
    for (input, value) in item.sig.inputs.iter().zip(arguments) {
        let ty = match input {
            FnArg::Typed(typed) => &typed.ty,
            FnArg::Receiver(receiver) => &receiver.ty,
        };
        found.learn(ty, value, &names, own);
    }
    Some(found)
}

/// Returns the name of a type or a length; a lifetime has none.
pub fn parameter_name(parameter: &GenericParam) -> Option<String> {
    match parameter {
        GenericParam::Type(ty) => Some(ty.ident.to_string()),
        GenericParam::Const(length) => Some(length.ident.to_string()),
        GenericParam::Lifetime(_) => None,
    }
}

impl Found {
    fn learn(&mut self, ty: &Type, value: &Value, names: &[String], own: &Own) {
        match (ty, value) {
            (Type::Reference(ty), Value::Reference(inner)) => {
                self.learn(&ty.elem, inner, names, own)
            }
            (Type::Reference(ty), value) => self.learn(&ty.elem, value, names, own),
            (ty, Value::Reference(inner)) => self.learn(ty, inner, names, own),
            (Type::Array(array), Value::Array(all)) => {
                let length = array.len.to_token_stream().to_string();
                if names.contains(&length) {
                    self.lengths.entry(length).or_insert(all.len());
                }
                all.iter().take(1).for_each(|part| self.learn(&array.elem, part, names, own));
            }
            (Type::Slice(slice), Value::Array(all)) => {
                all.iter().take(1).for_each(|part| self.learn(&slice.elem, part, names, own))
            }
            (Type::Tuple(tuple), Value::Tuple(all)) => {
                tuple.elems.iter().zip(all).for_each(|(ty, part)| self.learn(ty, part, names, own))
            }
            (Type::Path(path), value) => match path.path.get_ident() {
                Some(name) if names.contains(&name.to_string()) => {
                    self.types.extend(type_of(value).map(|ty| (name.to_string(), ty)));
                }
                _ => self.learn_of_generics(&path.path, value, names, own),
            },
            _ => {}
        }
    }

    /// Reads generics from a value of `Vec<T>`, `Option<T>`, or a generic type that the body
    /// declares.
    fn learn_of_generics(&mut self, path: &syn::Path, value: &Value, names: &[String], own: &Own) {
        let Some(PathArguments::AngleBracketed(given)) =
            path.segments.last().map(|last| &last.arguments)
        else {
            return;
        };
        if let Value::Adt(adt) = value
            && let Some(declared) = own.declared(&adt.type_name())
        {
            let mut inside = Found::default();
            for (name, ty) in &declared.fields {
                if let Some(part) = adt.field(name) {
                    inside.learn(ty, part, &declared.generics, own);
                }
            }
            for (meant, given) in declared.generics.iter().zip(&given.args) {
                let name = given.to_token_stream().to_string();
                if names.contains(&name) {
                    self.types.extend(inside.types.get(meant).map(|ty| (name.clone(), ty.clone())));
                    self.lengths.extend(inside.lengths.get(meant).map(|n| (name, *n)));
                }
            }
            return;
        }
        let inner = match value {
            Value::Array(all) => all.first(),
            Value::Adt(adt) => adt.fields.first().map(|(_, value)| value),
            _ => None,
        };
        if let (Some(GenericArgument::Type(ty)), Some(inner)) = (given.args.first(), inner) {
            self.learn(ty, inner, names, own);
        }
    }

    /// Returns the function with types instead of its generics.
    pub fn put_into(&self, item: &ItemFn) -> ItemFn {
        let mut item = item.clone();
        Substitution(&self.types).visit_item_fn_mut(&mut item);
        item
    }
}

/// The visitor that replaces names by types.
pub struct Substitution<'a>(pub &'a BTreeMap<String, Type>);

impl VisitMut for Substitution<'_> {
    fn visit_type_mut(&mut self, ty: &mut Type) {
        if let Type::Path(path) = &*ty
            && let Some(meant) =
                path.path.get_ident().and_then(|name| self.0.get(&name.to_string()))
        {
            *ty = meant.clone();
            return;
        }
        visit_mut::visit_type_mut(self, ty);
    }

    /// Replaces the type in `T::from(x)`.
    fn visit_path_mut(&mut self, path: &mut syn::Path) {
        if let Some(first) = path.segments.first()
            && let Some(Type::Path(meant)) = self.0.get(&first.ident.to_string())
        {
            let mut whole = meant.path.clone();
            whole.segments.extend(path.segments.iter().skip(1).cloned());
            *path = whole;
        }
        visit_mut::visit_path_mut(self, path);
    }
}

/// Returns the type of a value made of numbers.
fn type_of(value: &Value) -> Option<Type> {
    Some(match value {
        Value::Scalar(_) => parse_quote!(f64),
        Value::Condition(_) => parse_quote!(bool),
        Value::Reference(inner) => type_of(inner)?,
        Value::Vector(_) | Value::Matrix(..) | Value::Euler(_) => {
            let name = proc_macro2::Ident::new(
                &value.components()?.0.shape().name(),
                proc_macro2::Span::call_site(),
            );
            parse_quote!(#name)
        }
        Value::Array(all) => {
            let ty = type_of(all.first()?)?;
            let n = all.len();
            parse_quote!([#ty; #n])
        }
        Value::Adt(adt) => {
            let name = proc_macro2::Ident::new(&adt.type_name(), proc_macro2::Span::call_site());
            parse_quote!(#name)
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lower::values::Value;

    #[test]
    fn an_array_gives_its_length() {
        let item: ItemFn = parse_quote!(
            fn f<const N: usize>(x: [f64; N]) -> f64 {
                x[0]
            }
        );
        let list = Value::Array(vec![Value::count(0); 3]);
        let found = found(&item, &[list], None, &Own::default(), &|_| None);
        assert_eq!(found.map(|found| found.lengths["N"]), Some(3));
    }
}
