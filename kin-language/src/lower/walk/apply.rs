//! Makes and applies the functions of the body, and reads values of the types that it declares.

use std::rc::Rc;

use quote::{ToTokens, quote};
use syn::visit::Visit;
use syn::{Expr, ExprStruct, FnArg, ItemFn, ReturnType, Type};

use super::{MOST_CALLS, MOST_NODES, Reader};
use crate::lower::scope::{Kind, Scopes};
use crate::lower::values::{
    Adt, Closure, Components, Function, IntegerType, Name, Read, Unreadable, Value, counted,
    generic,
};
use crate::vocabulary::{is_integer, last_name};

impl Reader {
    /// Makes a closure. A closure sees the variables as they are at the time of the call; with
    /// `move` it holds copies of those that it names.
    pub fn closure(&mut self, closure: &syn::ExprClosure) -> Read {
        let inputs = closure.inputs.iter().cloned().collect();
        let output = closure.output.clone();
        let body = (*closure.body).clone();
        let mut scopes = self.scopes.clone();
        if closure.capture.is_some() {
            scopes.push();
            for name in named(&closure.body) {
                if let Some(Name::Variable(slot)) = self.scopes.get(&name) {
                    let present = self.store.get(slot).clone();
                    let copy = self.store.declare(present);
                    scopes.declare(name, copy);
                }
            }
        }
        let open = &closure.or1_token;
        let arguments = &closure.inputs;
        let close = &closure.or2_token;
        let head = quote!(#open #arguments #close);
        Ok(Value::Function(Function::Closure(Rc::new(Closure {
            head,
            inputs,
            output,
            body,
            scopes,
        }))))
    }

    /// Returns the value of a function at `arguments`; `places` are their expressions, for
    /// messages.
    pub fn apply(
        &mut self,
        function: &Function,
        arguments: Vec<Value>,
        places: &[&Expr],
        at: &dyn ToTokens,
    ) -> Read {
        self.deeper(at, |reader| match function {
            Function::Closure(closure) => {
                // A method passes values that have no expression. A message then points at the
                // arguments of the method.
                let is_handed = places.len() != arguments.len();
                reader.apply_closure(closure, arguments, if is_handed { &closure.head } else { at })
            }
            Function::Inner(item, depth) => {
                reader.apply_inner(item, *depth, (arguments, places), None, at)
            }
            Function::Path(path) => reader.call_path(path, arguments, places, at),
        })
    }

    /// Reads a call within the allowed depth of calls.
    pub fn deeper(&mut self, at: &dyn ToTokens, read: impl FnOnce(&mut Self) -> Read) -> Read {
        self.calls += 1;
        if self.calls > MOST_CALLS {
            return Err(Unreadable::new(at, "a recursion of this depth"));
        }
        let value = read(self);
        self.calls -= 1;
        value
    }

    fn apply_closure(
        &mut self,
        closure: &Closure,
        arguments: Vec<Value>,
        at: &dyn ToTokens,
    ) -> Read {
        if closure.inputs.len() != arguments.len() {
            let text = counted("this closure", closure.inputs.len(), "argument", arguments.len());
            return Ok(self.mistake(at, text));
        }
        self.within(closure.scopes.clone(), |reader| {
            closure
                .inputs
                .iter()
                .zip(arguments)
                .try_for_each(|(pattern, value)| reader.bind(pattern, value))?;
            reader.enter(Kind::Function, None);
            let value = reader.raw_expression(&closure.body)?;
            let value = reader.exit(value, &closure.body)?;
            reader.returned(value, &closure.output, &closure.body)
        })
    }

    /// Applies a function declared inside the body, which sees none of the body's variables.
    /// `places` are the expressions of its arguments, for messages; `given` are the generics in
    /// `f::<3>(x)`.
    pub fn apply_inner(
        &mut self,
        item: &ItemFn,
        depth: usize,
        (arguments, places): (Vec<Value>, &[&Expr]),
        given: Option<&syn::AngleBracketedGenericArguments>,
        at: &dyn ToTokens,
    ) -> Read {
        if item.sig.inputs.len() != arguments.len() {
            let text = counted(
                &format!("`{}`", item.sig.ident),
                item.sig.inputs.len(),
                "argument",
                arguments.len(),
            );
            return Ok(self.mistake(at, text));
        }
        let scopes = self.scopes.around_function(depth);
        let generics =
            generic::found(item, &arguments, given, &self.own, &|length| self.known_length(length));
        let meant = generics.as_ref().map(|generics| generics.put_into(item));
        let item = meant.as_ref().unwrap_or(item);
        self.within(scopes, |reader| {
            for (name, length) in generics.iter().flat_map(|generics| &generics.lengths) {
                reader.scopes.declare_item(name.clone(), Value::count(*length));
            }
            for (k, (input, value)) in item.sig.inputs.iter().zip(arguments).enumerate() {
                match input {
                    FnArg::Typed(typed) => {
                        let place = places.get(k).map_or(at, |place| *place as &dyn ToTokens);
                        let value = reader.typed(value, &typed.ty, place)?;
                        reader.bind(&typed.pat, value)?;
                    }
                    FnArg::Receiver(receiver) => {
                        let changes = receiver.mutability.is_some() && receiver.reference.is_some();
                        let value = if changes { value } else { reader.loaded(value) };
                        reader.declare("self".into(), value);
                    }
                }
            }
            let value = reader.body(&item.block)?;
            reader.returned(value, &item.sig.output, &item.block)
        })
    }

    /// Reads with other variables in scope.
    pub fn within(&mut self, scopes: Scopes<Value>, read: impl FnOnce(&mut Self) -> Read) -> Read {
        let outer = std::mem::replace(&mut self.scopes, scopes);
        self.scopes.push();
        let value = read(self);
        self.scopes = outer;
        value
    }

    fn returned(&mut self, value: Value, output: &ReturnType, at: &dyn ToTokens) -> Read {
        match output {
            ReturnType::Default => Ok(value),
            ReturnType::Type(_, ty) => self.typed(value, ty, at),
        }
    }

    /// Reads `Vec2 { x: …, y: … }`, `Link { length, ..other }`.
    pub fn struct_literal(&mut self, literal: &ExprStruct) -> Read {
        let name = last_name(&literal.path);
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

    /// Calls a method of a type of the body; returns `None` if the type has no such method.
    pub fn own_method(
        &mut self,
        ty: &str,
        name: &str,
        arguments: Vec<Value>,
        at: &dyn ToTokens,
    ) -> Read<Option<Value>> {
        let Some((item, depth)) = self.own.function(ty, name, &arguments) else { return Ok(None) };
        self.deeper(at, |reader| reader.apply_inner(&item, depth, (arguments, &[]), None, at))
            .map(Some)
    }

    /// Reads a constant of a type of the body: `Link::LENGTH`, `<M8 as Thread>::PITCH`.
    pub fn own_constant(&mut self, path: &syn::ExprPath) -> Read<Option<Value>> {
        match self.own.by_path(path, &[]) {
            Some((item, depth))
                if item.sig.inputs.is_empty() && crate::vocabulary::is_type_name(path) =>
            {
                self.deeper(path, |reader| {
                    reader.apply_inner(&item, depth, (vec![], &[]), None, path)
                })
                .map(Some)
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
            _ if name == "bool" => Ok(self.truth(false)),
            _ if is_integer(&name) => Ok(Value::Integer(0, IntegerType::named(&name))),
            Type::Tuple(tuple) => tuple
                .elems
                .iter()
                .map(|ty| self.default_of(ty, at))
                .collect::<Read<_>>()
                .map(Value::Tuple),
            Type::Array(array) => {
                let n = self.known_length(&array.len).filter(|n| *n <= MOST_NODES);
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
}

/// Returns the single names in an expression, each once.
fn named(expression: &Expr) -> std::collections::BTreeSet<String> {
    #[derive(Default)]
    struct Search(std::collections::BTreeSet<String>);
    impl Visit<'_> for Search {
        fn visit_ident(&mut self, name: &proc_macro2::Ident) {
            self.0.insert(name.to_string());
        }
    }
    let mut search = Search::default();
    search.visit_expr(expression);
    search.0
}

/// Returns true for `Default::default()`.
fn is_default(expression: &syn::Expr) -> bool {
    matches!(expression, syn::Expr::Call(call) if call.args.is_empty()
        && matches!(&*call.func, syn::Expr::Path(path) if crate::vocabulary::names(path) == ["Default", "default"]))
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
    fn a_closure_sees_later_changes_and_a_function_none() {
        let (_, value) = read(syn::parse_quote!({
            let mut k = 1;
            let add = |x| x + k;
            k = 10;
            fn twice(x: i64) -> i64 {
                2 * x
            }
            twice(add(1))
        }));
        assert!(matches!(value, Some(Value::Integer(22, _))));
        let endless = syn::parse_quote!({
            fn f(x: i64) -> i64 {
                f(x)
            }
            f(1)
        });
        assert!(read(endless).1.is_none());
    }
}
