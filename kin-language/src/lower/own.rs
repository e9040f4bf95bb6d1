//! Structs and enums: values with named parts. Of those declared inside of the body the methods are read too;
//! of others only what was put into them is known, and anything else is asked of rustc.

use std::rc::Rc;

use quote::ToTokens;
use syn::visit_mut::VisitMut;
use syn::{BinOp, ExprBinary, ExprStruct, Fields, ImplItem, Item, ItemFn, ItemImpl, Type, parse_quote};

use super::generic::Substitution;
use super::method::takes_itself;
use super::template::Template;
use super::value::{Adt, Components, Value};
use super::{Read, Reader, Unreadable};
use kin_graph::Comparison;

/// What the body declares of its own types.
#[derive(Default)]
pub struct Own {
    /// Names of structs and enums, with the names of the fields of structs.
    types: std::collections::HashMap<String, Vec<String>>,
    /// What traits give to whoever has them, by the trait's name.
    traits: std::collections::HashMap<String, Vec<syn::TraitItemFn>>,
    /// By the names of the type and the function, with the number of the scope.
    functions: std::collections::HashMap<(String, String), (Rc<ItemFn>, usize)>,
}

impl Own {
    /// Takes a type, or what a type can do, from the items of a block.
    pub fn take(&mut self, item: &Item, depth: usize) -> bool {
        match item {
            Item::Struct(of) => {
                let names = match &of.fields {
                    Fields::Named(fields) => fields
                        .named
                        .iter()
                        .filter_map(|field| field.ident.as_ref())
                        .map(ToString::to_string)
                        .collect(),
                    fields => (0..fields.len()).map(|k| k.to_string()).collect(),
                };
                self.types.insert(of.ident.to_string(), names);
            }
            Item::Enum(of) => drop(self.types.insert(of.ident.to_string(), vec![])),
            Item::Trait(of) => {
                let given = of.items.iter().filter_map(|item| match item {
                    syn::TraitItem::Fn(function) if function.default.is_some() => Some(function.clone()),
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
        let Some(name) = path
            .path
            .segments
            .last()
            .map(|last| last.ident.to_string())
            .filter(|name| self.types.contains_key(name))
        else {
            return false;
        };
        let own = of.items.iter().filter_map(|item| match item {
            ImplItem::Fn(function) => Some((function.sig.clone(), function.block.clone())),
            _ => None,
        });
        let of_trait = of
            .trait_
            .as_ref()
            .and_then(|(_, path, _)| self.traits.get(&path.segments.last()?.ident.to_string()));
        let given = of_trait
            .into_iter()
            .flatten()
            .filter_map(|function| Some((function.sig.clone(), function.default.clone()?)));
        // What the type has itself comes last: it stands in the place of what the trait gives.
        for (mut sig, block) in given.chain(own).collect::<Vec<_>>() {
            let function = sig.ident.to_string();
            sig.generics.params.extend(of.generics.params.iter().cloned());
            let mut item: ItemFn = parse_quote!(#sig #block);
            Substitution(&[("Self".to_string(), (*of.self_ty).clone())].into()).visit_item_fn_mut(&mut item);
            self.functions.insert((name.clone(), function), (Rc::new(item), depth));
        }
        true
    }

    pub fn is_type(&self, name: &str) -> bool {
        self.types.contains_key(name)
    }

    /// Whether some method of that name takes `&mut self`.
    pub fn changes(&self, name: &str) -> bool {
        self.functions.iter().any(|((_, known), (item, _))| known == name && takes_itself(item))
    }

    pub fn function(&self, ty: &str, name: &str) -> Option<(Rc<ItemFn>, usize)> {
        self.functions.get(&(ty.to_string(), name.to_string())).cloned()
    }
}

impl Reader {
    /// `Vec2 { x: …, y: … }`, `Link { length, ..other }`
    pub fn struct_literal(&mut self, literal: &ExprStruct) -> Read {
        let name = literal.path.segments.last().map(|s| s.ident.to_string()).unwrap_or_default();
        let kind = match name.as_str() {
            "Vec2" => Some((&["x", "y"][..], Components::Vector(2))),
            "Vec3" => Some((&["x", "y", "z"][..], Components::Vector(3))),
            "EulerParameters" => Some((&["e0", "e1", "e2", "e3"][..], Components::Euler)),
            _ => None,
        };
        let rest = match &literal.rest {
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
            match (fields.iter().find(|(name, ..)| name == wanted), rest.as_ref().and_then(Value::components))
            {
                (Some((_, value, place)), _) => nodes.push(self.scalar(value.clone(), place)),
                (None, Some((_, known))) if known.len() == names.len() => nodes.push(known[nodes.len()]),
                (None, _) => return Ok(self.mistake(literal, format!("`{name}` needs `{wanted}`"))),
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
            Some(_) => return Err(Unreadable::new(&literal.dot2_token, "the rest of another value")),
        }
        fields.sort_by(|(a, _), (b, _)| a.cmp(b));
        Ok(Value::Adt(Adt { path: literal.path.clone(), name: name.into(), fields, braces: true }))
    }

    /// A call of a method that the body's own type has; `None` if it has no such method.
    pub fn own_method(
        &mut self,
        ty: &str,
        name: &str,
        arguments: Vec<Value>,
        at: &dyn ToTokens,
    ) -> Read<Option<Value>> {
        let Some((item, depth)) = self.own.function(ty, name) else { return Ok(None) };
        self.calls += 1;
        if self.calls > super::MOST_CALLS {
            return Err(Unreadable::new(at, "a recursion this deep"));
        }
        let value = self.apply_inner(&item, depth, arguments, None, at);
        self.calls -= 1;
        value.map(Some)
    }

    /// An operator beside a value of a struct or an enum.
    pub fn operate_own(&mut self, op: BinOp, left: Value, right: Value, at: &ExprBinary) -> Read {
        let compared = match op {
            BinOp::Eq(_) => Some(Comparison::Equal),
            BinOp::Ne(_) => Some(Comparison::NotEqual),
            _ => None,
        };
        let method = match op {
            BinOp::Add(_) => "add",
            BinOp::Sub(_) => "sub",
            BinOp::Mul(_) => "mul",
            BinOp::Div(_) => "div",
            BinOp::Rem(_) => "rem",
            _ => "",
        };
        if let Value::Adt(adt) = &left
            && let Some(value) =
                self.own_method(&adt.type_name(), method, vec![left.clone(), right.clone()], at)?
        {
            return Ok(value);
        }
        if let (Value::Adt(a), Value::Adt(b), Some(comparison)) = (&left, &right, compared)
            && let Some(same) = self.same(a, b)
        {
            return Ok(Value::Condition(if comparison == Comparison::Equal {
                same
            } else {
                self.graph.not(same)
            }));
        }
        for (value, other, place) in [(&left, &right, &at.left), (&right, &left, &at.right)] {
            let number =
                matches!(other, Value::Scalar(_) | Value::Vector(_) | Value::Matrix(..) | Value::Integer(..));
            if let (Value::Adt(Adt { name, .. }), true) = (value, number)
                && matches!(name.as_str(), "Some" | "None" | "Ok" | "Err")
            {
                let text = "this may be no number: take it apart with `if let Some(x) = …`, or say what else it is, `.unwrap_or(0.0)`";
                return Ok(self.mistake(place, text));
            }
        }
        let (a, b) = (self.template(left, &at.left)?, self.template(right, &at.right)?);
        Ok(Value::Opaque(Template::Binary(Box::new(a), op, Box::new(b))))
    }

    /// Whether two values of one type are equal, part by part.
    fn same(&mut self, a: &Adt, b: &Adt) -> Option<kin_graph::Node> {
        if a.name != b.name || a.fields.len() != b.fields.len() {
            return Some(self.graph.bool(false));
        }
        let mut all = self.graph.bool(true);
        for ((_, a), (_, b)) in a.fields.iter().zip(&b.fields) {
            let one = match (a, b) {
                (Value::Integer(a, _), Value::Integer(b, _)) => self.graph.bool(a == b),
                (Value::Adt(a), Value::Adt(b)) => self.same(a, b)?,
                (a, b) => {
                    let ((a, shape), (b, other)) = (a.numbers()?, b.numbers()?);
                    (shape == other).then_some(())?;
                    let mut same = self.graph.bool(true);
                    for (a, b) in a.into_iter().zip(b) {
                        let one = self.graph.compare(Comparison::Equal, a, b);
                        same = self.graph.and(same, one);
                    }
                    same
                }
            };
            all = self.graph.and(all, one);
        }
        Some(all)
    }
}
