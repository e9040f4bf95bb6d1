//! The types that the body declares: structs and enums, their functions, constants and traits, and
//! values of these types.

use std::collections::HashMap;
use std::rc::Rc;

use quote::ToTokens;
use syn::spanned::Spanned;
use syn::visit_mut::VisitMut;
use syn::{
    Attribute, Expr, ExprStruct, Fields, FnArg, ImplItem, Item, ItemFn, ItemImpl, TraitItem, Type,
    parse_quote, parse_quote_spanned,
};

use super::generic::{Substitution, parameter_name};
use super::{Adt, Read, Unreadable, Value, Values, counted};

/// The types that the body declares.
#[derive(Default)]
pub struct Own {
    types: HashMap<String, Declared>,
    /// The default functions of each trait, by the name of the trait.
    traits: HashMap<String, Vec<ItemFn>>,
    /// The functions by the names of the type and the function; several functions of one name
    /// differ in the types of their arguments. A constant is a function without arguments.
    functions: HashMap<(String, String), Vec<Inner>>,
}

/// A function, and the number of the scope that declares it.
pub type Inner = (Rc<ItemFn>, usize);

/// A struct or an enum.
pub struct Declared {
    /// The names of its generic types and lengths.
    pub generics: Vec<String>,
    /// The fields of a struct in order; the fields of a tuple have numbers as names. Empty for an
    /// enum.
    pub fields: Vec<(String, Type)>,
    pub braces: bool,
    /// The variants of an enum in order. Empty for a struct.
    pub variants: Vec<Variant>,
    /// The name of the default variant.
    pub default: Option<String>,
    derives: Vec<String>,
}

/// A variant of an enum.
pub struct Variant {
    pub name: String,
    /// The integer of the variant, if the declaration gives one.
    pub integer: Option<i64>,
    /// The names of the fields, or their numbers.
    pub fields: Vec<String>,
}

impl Declared {
    fn new(generics: &syn::Generics, attributes: &[Attribute]) -> Self {
        Declared {
            generics: generics.params.iter().filter_map(parameter_name).collect(),
            fields: vec![],
            braces: false,
            variants: vec![],
            default: None,
            derives: attributes.iter().flat_map(derived).collect(),
        }
    }

    fn with_fields(self, fields: &Fields) -> Self {
        let named =
            field_names(fields).into_iter().zip(fields.iter().map(|field| field.ty.clone()));
        Declared { fields: named.collect(), braces: matches!(fields, Fields::Named(_)), ..self }
    }

    fn with_variants(mut self, of: &syn::ItemEnum) -> Self {
        let mut next = Some(0);
        for variant in &of.variants {
            if let Some((_, value)) = &variant.discriminant {
                next = integer(value);
            }
            let name = variant.ident.to_string();
            let fields = field_names(&variant.fields);
            self.variants.push(Variant { name, integer: next, fields });
            next = next.and_then(|k: i64| k.checked_add(1));
            if variant.attrs.iter().any(|attribute| attribute.path().is_ident("default")) {
                self.default = Some(variant.ident.to_string());
            }
        }
        self
    }

    /// Returns the names of the fields of the struct, or of the variant with this name.
    pub fn fields_of(&self, name: &str) -> Vec<&str> {
        match self.variants.iter().find(|variant| variant.name == name) {
            Some(variant) => variant.fields.iter().map(String::as_str).collect(),
            None => self.fields.iter().map(|(name, _)| name.as_str()).collect(),
        }
    }

    pub fn derives(&self, name: &str) -> bool {
        self.derives.iter().any(|derived| derived == name)
    }
}

impl Own {
    /// Takes a type, or an implementation for it, from the items of a block.
    pub fn take(&mut self, item: &Item, depth: usize) -> bool {
        match item {
            Item::Struct(of) => {
                let declared = Declared::new(&of.generics, &of.attrs).with_fields(&of.fields);
                self.types.insert(of.ident.to_string(), declared);
            }
            Item::Enum(of) => {
                let declared = Declared::new(&of.generics, &of.attrs).with_variants(of);
                self.types.insert(of.ident.to_string(), declared);
            }
            Item::Trait(of) => {
                let given = of.items.iter().filter_map(|item| match item {
                    TraitItem::Fn(function) => {
                        Some(whole(&function.sig, function.default.as_ref()?))
                    }
                    TraitItem::Const(constant) => Some(constant_function(
                        &constant.ident,
                        &constant.ty,
                        &constant.default.as_ref()?.1,
                    )),
                    _ => None,
                });
                self.traits.insert(of.ident.to_string(), given.collect());
            }
            Item::Impl(of) => return self.implementation(of, depth),
            _ => return false,
        }
        true
    }

    fn implementation(&mut self, of: &ItemImpl, depth: usize) -> bool {
        let Type::Path(path) = &*of.self_ty else { return false };
        let last = path.path.segments.last().map(|last| last.ident.to_string());
        let Some(name) = last.filter(|name| self.is_type(name) || name == "f64") else {
            return false;
        };
        let own = of.items.iter().filter_map(|item| match item {
            ImplItem::Fn(function) => Some(whole(&function.sig, &function.block)),
            ImplItem::Const(constant) => {
                Some(constant_function(&constant.ident, &constant.ty, &constant.expr))
            }
            _ => None,
        });
        let of_trait = of
            .trait_
            .as_ref()
            .and_then(|(_, path, _)| self.traits.get(&path.segments.last()?.ident.to_string()));
        let mut items: Vec<ItemFn> = own.collect();
        // A function of the type itself has precedence over that of the trait.
        let given = of_trait.into_iter().flatten();
        let given =
            given.filter(|given| items.iter().all(|item| item.sig.ident != given.sig.ident));
        items.extend(given.cloned().collect::<Vec<_>>());
        for mut item in items {
            let function = item.sig.ident.to_string();
            item.sig.generics.params.extend(of.generics.params.iter().cloned());
            Substitution(&[("Self".to_string(), (*of.self_ty).clone())].into())
                .visit_item_fn_mut(&mut item);
            self.functions
                .entry((name.clone(), function))
                .or_default()
                .push((Rc::new(item), depth));
        }
        true
    }

    pub fn declared(&self, name: &str) -> Option<&Declared> {
        self.types.get(name)
    }

    pub fn is_type(&self, name: &str) -> bool {
        self.types.contains_key(name)
    }

    /// Returns the path of a variant with the name of its enum, which `use Joint::*` permits to
    /// omit.
    pub fn whole_path(&self, path: &syn::Path) -> syn::Path {
        let owner =
            path.get_ident().filter(|name| !self.is_type(&name.to_string())).and_then(|variant| {
                let has = |declared: &Declared| {
                    declared.variants.iter().any(|known| *variant == known.name)
                };
                self.types.iter().filter(|(_, declared)| has(declared)).map(|(name, _)| name).min()
            });
        match owner {
            Some(owner) => {
                let owner = syn::Ident::new(owner, proc_macro2::Span::call_site());
                parse_quote!(#owner::#path)
            }
            None => path.clone(),
        }
    }

    /// Returns the names of the methods of a type, in order.
    pub fn methods(&self, ty: &str) -> Vec<String> {
        let own = self.functions.keys().filter(|(known, _)| known == ty);
        let mut all: Vec<String> = own.map(|(_, name)| format!("`{name}`")).collect();
        all.sort_unstable();
        all
    }

    /// Returns true if some method with this name takes `&mut self`.
    pub fn changes(&self, name: &str) -> bool {
        let mut named = self.functions.iter().filter(|((_, known), _)| known == name);
        named.any(|(_, all)| all.iter().any(|(item, _)| takes_itself(item)))
    }

    /// Returns a function of a type by its name; among several, the first one whose arguments fit.
    pub fn function(&self, ty: &str, name: &str, arguments: &[Value]) -> Option<Inner> {
        let all = self.functions.get(&(ty.to_string(), name.to_string()))?;
        let fitting = all.iter().find(|(item, _)| {
            let inputs = item.sig.inputs.iter().zip(arguments);
            inputs.into_iter().all(|(input, value)| match input {
                FnArg::Typed(typed) => fits(&typed.ty, value),
                FnArg::Receiver(_) => true,
            })
        });
        fitting.or(all.last()).cloned()
    }

    /// Returns the function or constant that a path names: `Link::new`, `<M8 as Thread>::PITCH`.
    pub fn by_path(&self, path: &syn::ExprPath, arguments: &[Value]) -> Option<Inner> {
        let segments = &path.path.segments;
        let name = segments.last()?.ident.to_string();
        let ty = match &path.qself {
            Some(of) => match &*of.ty {
                Type::Path(ty) => ty.path.segments.last()?.ident.to_string(),
                _ => return None,
            },
            None => segments.iter().rev().nth(1)?.ident.to_string(),
        };
        self.function(&ty, &name, arguments)
    }
}

/// Returns true if a value may have a type, as far as both are known.
fn fits(ty: &Type, value: &Value) -> bool {
    match (ty, value) {
        (Type::Reference(ty), value) => fits(&ty.elem, value),
        (ty, Value::Reference(value)) => fits(ty, value),
        (Type::Path(path), value) => {
            match (path.path.segments.last().map(|s| s.ident.to_string()), value) {
                (Some(name), Value::Adt(adt)) => name == adt.type_name(),
                (Some(name), Value::Scalar(_)) => name == "f64",
                (Some(name), Value::Vector(v)) => name == format!("Vec{}", v.len()),
                (Some(name), Value::Integer(..)) => name != "f64",
                _ => true,
            }
        }
        (Type::Tuple(_), value) => !matches!(value, Value::Scalar(_) | Value::Adt(_)),
        _ => true,
    }
}

fn field_names(fields: &Fields) -> Vec<String> {
    let name = |(k, field): (usize, &syn::Field)| match &field.ident {
        Some(name) => name.to_string(),
        None => k.to_string(),
    };
    fields.iter().enumerate().map(name).collect()
}

fn whole(sig: &syn::Signature, block: &syn::Block) -> ItemFn {
    parse_quote!(#sig #block)
}

/// Returns `const PITCH: f64 = 1.25;` as `fn PITCH() -> f64 { 1.25 }`, with the span of the value.
fn constant_function(name: &syn::Ident, ty: &Type, value: &Expr) -> ItemFn {
    parse_quote_spanned!(value.span()=> fn #name() -> #ty { #value })
}

/// Returns the names in `#[derive(…)]`.
fn derived(attribute: &Attribute) -> Vec<String> {
    let mut names = Vec::new();
    if attribute.path().is_ident("derive") {
        // Rustc reports an attribute that is no list of names.
        let _ = attribute.parse_nested_meta(|meta| {
            names.extend(meta.path.segments.last().map(|last| last.ident.to_string()));
            Ok(())
        });
    }
    names
}

/// Reads a literal integer: `5`, `-1`.
fn integer(value: &Expr) -> Option<i64> {
    match value {
        Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(k), .. }) => k.base10_parse().ok(),
        Expr::Unary(syn::ExprUnary { op: syn::UnOp::Neg(_), expr, .. }) => {
            integer(expr)?.checked_neg()
        }
        _ => None,
    }
}

/// Returns true if a method takes `&mut self`.
pub fn takes_itself(function: &syn::ItemFn) -> bool {
    matches!(function.sig.inputs.first(), Some(FnArg::Receiver(receiver)) if receiver.reference.is_some() && receiver.mutability.is_some())
}

impl Values {
    pub fn own_literal(
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
    pub fn integer_field(&mut self, literal: &ExprStruct, adt: &Adt) -> Option<Value> {
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
    pub fn mistaken_field(&mut self, literal: &ExprStruct, adt: &Adt) -> Option<Value> {
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
                let text = counted(&format!("`{}`", adt.name), wanted, "value", adt.fields.len());
                self.mistake(at, text)
            }
            _ => Value::Adt(adt),
        }
    }

    /// Returns the integer of a variant without fields.
    pub fn discriminant(&self, adt: &Adt) -> Option<i64> {
        let variants = &self.own.declared(&adt.type_name())?.variants;
        variants.iter().find(|variant| variant.name == adt.name)?.integer
    }
}

#[cfg(test)]
mod tests {
    use super::Own;
    use crate::lower::values::Value;

    #[test]
    fn a_type_has_its_fields_variants_and_functions() {
        let mut own = Own::default();
        own.take(
            &syn::parse_quote!(
                struct Link {
                    length: f64,
                    mass: f64,
                }
            ),
            1,
        );
        own.take(
            &syn::parse_quote!(
                enum Side {
                    Left = 3,
                    Right,
                }
            ),
            1,
        );
        let methods = syn::parse_quote!(impl Link { fn half(&self) -> f64 { 0.5 * self.length } });
        assert!(own.take(&methods, 1));
        let fields = own.declared("Link").map(|link| link.fields_of("Link").join(" "));
        assert_eq!(fields.as_deref(), Some("length mass"));
        let right = own.declared("Side").and_then(|side| side.variants[1].integer);
        assert_eq!(right, Some(4));
        assert!(own.function("Link", "half", &[Value::unit()]).is_some());
        assert_eq!(own.methods("Link"), ["`half`"]);
        assert!(!own.changes("half"));
    }
}
