//! Makes and applies the functions inside the body.

use std::rc::Rc;

use quote::{ToTokens, quote};
use syn::visit::Visit;
use syn::{Expr, FnArg, ItemFn, ReturnType};

use super::flow::Kind;
use super::function::{Closure, Function};
use super::generic;
use super::scope::{Name, Scopes};
use super::template::Template;
use super::value::Value;
use super::{MOST_CALLS, Read, Reader, Unreadable};

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
                    let copy = self.store.declare(self.store.get(slot).clone());
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

    /// Returns a value as a function, if it can be one.
    pub fn function(&mut self, value: Value, at: &dyn ToTokens) -> Read<Function> {
        match self.loaded(value) {
            Value::Function(function) => Ok(function),
            Value::Opaque(Template::Path(path, _)) => Ok(Function::Path(Rc::new(path))),
            _ => Err(Unreadable::new(at, "a function that is not a closure")),
        }
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
        self.calls += 1;
        if self.calls > MOST_CALLS {
            return Err(Unreadable::new(at, "a recursion of this depth"));
        }
        let value = match function {
            Function::Closure(closure) => {
                // A method passes values that have no expression. A message then points at the
                // arguments of the method.
                let is_handed = places.len() != arguments.len();
                self.apply_closure(closure, arguments, if is_handed { &closure.head } else { at })
            }
            Function::Inner(item, depth) => {
                self.apply_inner(item, *depth, (arguments, places), None, at)
            }
            Function::Path(path) => self.call_path(path, arguments, places, at),
        };
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
            let text =
                super::counted("this closure", closure.inputs.len(), "argument", arguments.len());
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
            let text = super::counted(
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

    /// Returns the value of a length that is a constant of the body.
    pub fn known_length(&self, length: &Expr) -> Option<usize> {
        let name = length.to_token_stream().to_string();
        match (crate::parse::literal_length(length), self.named(&name)) {
            (Some(n), _) => Some(n),
            (None, Some(Value::Integer(n, _))) => usize::try_from(*n).ok(),
            _ => None,
        }
    }

    /// Reads with other variables in scope.
    pub fn within(&mut self, scopes: Scopes, read: impl FnOnce(&mut Self) -> Read) -> Read {
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
