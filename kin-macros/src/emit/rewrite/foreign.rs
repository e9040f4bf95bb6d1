//! Values that only rustc knows: reads of them are lifted, and calls hand over the numbers they ask
//! for.

use proc_macro2::Span;
use quote::quote;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::visit_mut::{self, VisitMut};
use syn::{Expr, ExprMethodCall, Lit, UnOp, parse_quote, parse_quote_spanned};

use super::scopes::Nature;
use super::{Copy, Rewriter};
use kin_language::vocabulary::{
    is_beyond_std, is_changing_method, is_kin_function, is_kin_type, is_number_function,
    is_number_method, is_reading_method, is_std_function, is_type_name, is_underived, names,
};

impl Rewriter {
    /// A variable, or a path that only rustc knows.
    pub fn path(&mut self, expression: &mut Expr) {
        let Expr::Path(path) = expression else { return };
        self.state_type(path);
        if let Some(inputs) = self.variable(path).and_then(|variable| variable.inputs.clone()) {
            // A closure that goes somewhere else than into a call may be given anything.
            return inputs
                .into_iter()
                .flatten()
                .for_each(|number| self.scopes.add(number, Nature::ANY));
        }
        match self.inner_function(path).map(|(_, lifted)| lifted) {
            Some(true) if self.copy == Copy::Dual => {
                let dual = &self.dual;
                *expression = parse_quote!(#path::<#dual>);
            }
            Some(_) => {}
            None if is_number_function(path) => self.number_function(expression),
            None if self.variable(path).is_none() && is_function_name(path) => {}
            None if self.is_foreign(expression) => self.lift_place(expression),
            None => {}
        }
    }

    fn number_function(&mut self, expression: &mut Expr) {
        if let (Expr::Path(path), Copy::Dual) = (&*expression, self.copy) {
            let rest = path.path.segments.iter().skip(1);
            let dual = &self.dual;
            *expression = parse_quote!(<::kin::emitted::Real<#dual>>::#(#rest)::*);
        }
    }

    /// Inside of a place only indices, and values that the place is a part of, are of this world.
    pub fn place(&mut self, expression: &mut Expr) {
        match expression {
            Expr::Path(_) => {}
            Expr::Field(field) => self.place(&mut field.base),
            Expr::Paren(inner) => self.place(&mut inner.expr),
            Expr::Group(inner) => self.place(&mut inner.expr),
            Expr::Reference(inner) => self.place(&mut inner.expr),
            Expr::Unary(syn::ExprUnary { op: UnOp::Deref(_), expr, .. }) => self.place(expr),
            Expr::Index(index) => {
                self.place(&mut index.expr);
                self.visit_expr_mut(&mut index.index);
            }
            Expr::Tuple(tuple) => tuple.elems.iter_mut().for_each(|part| self.place(part)),
            Expr::Array(array) => array.elems.iter_mut().for_each(|part| self.place(part)),
            other => self.visit_expr_mut(other),
        }
    }

    /// The value at a place, lifted.
    pub fn lift_place(&mut self, expression: &mut Expr) {
        if self.copy == Copy::Dual {
            let at = mixed(expression);
            let dual = &self.dual;
            let place = &*expression;
            let value = quote!(::core::clone::Clone::clone(&#place));
            *expression = parse_quote_spanned!(at=> (&::kin::emitted::Foreign(#value)).lifted(::core::marker::PhantomData::<#dual>));
        }
    }

    /// A result of the user's function, in the numbers of this copy.
    fn lift_result(&mut self, expression: &mut Expr) {
        let at = mixed(expression);
        let dual = &self.dual;
        let value = &*expression;
        *expression = match self.copy {
            Copy::Plain => parse_quote_spanned!(at=> ::kin::emitted::returned(#value).lowered()),
            Copy::Dual => {
                parse_quote_spanned!(at=> (&::kin::emitted::Foreign(#value)).lifted(::core::marker::PhantomData::<#dual>))
            }
        };
    }

    pub fn call(&mut self, expression: &mut Expr) {
        let Expr::Call(call) = expression else { return };
        let Expr::Path(path) = &*call.func else { return self.call_of_value(expression) };
        if let Some(variable) = self.variable(path).cloned() {
            return match variable.inputs {
                Some(inputs) => self.call_inner(&inputs, &mut call.args),
                None => self.call_of_value(expression),
            };
        }
        if let Some((inputs, _)) =
            self.inner_function(path).map(|(inputs, lifted)| (inputs.clone(), lifted))
        {
            self.call_inner(&inputs, &mut call.args);
            return self.path(&mut call.func);
        }
        let path = path.clone();
        if names(&path).first().is_some_and(|first| first == "Planar" || first == "Spatial") {
            call.args.iter_mut().for_each(|argument| self.visit_expr_mut(argument));
            return self.path(&mut call.func);
        }
        match names(&path).iter().map(String::as_str).collect::<Vec<_>>()[..] {
            ["f64", "from"] if self.copy == Copy::Dual => {
                let at = mixed(&call.func);
                let dual = self.dual.clone();
                *call.func = parse_quote_spanned!(at=> ::kin::emitted::cast::<#dual, _>);
                call.args.iter_mut().for_each(|argument| self.visit_expr_mut(argument));
            }
            _ if is_number_function(&path) => {
                self.number_function(&mut call.func);
                call.args.iter_mut().for_each(|argument| self.visit_expr_mut(argument));
            }
            _ if is_kin_function(&path) => self.kin_call(expression),
            _ if is_std_function(&path) => {
                visit_mut::visit_expr_path_mut(
                    self,
                    match &mut *call.func {
                        Expr::Path(path) => path,
                        _ => return,
                    },
                );
                self.arguments(&mut call.args, Nature::default());
            }
            _ => {
                let is_struct = is_type_name(&path);
                if !is_struct && self.copy == Copy::Plain && self.probes(call) {
                    self.probed_call(expression);
                    return self.lift_result(expression);
                }
                if is_struct && self.copy == Copy::Plain {
                    call.args.iter_mut().for_each(|argument| self.visit_expr_mut(argument));
                    return;
                }
                let place = if is_struct { Place::Field } else { Place::Argument };
                call.args.iter_mut().for_each(|argument| self.handed(argument, place));
                if !is_struct {
                    self.callee(&mut call.func);
                    self.lift_result(expression);
                }
            }
        }
    }

    /// The user's function in the dual copy: of unknown type where the function as it was written
    /// does not compile, so that what is wrong with the call is said once. In the plain copy it is
    /// in parentheses: where there is no such function, rustc then says the same of both.
    fn callee(&self, callee: &mut Expr) {
        *callee = match self.copy {
            Copy::Dual => {
                parse_quote_spanned!(mixed(callee)=> ::kin::emitted::callee::<__SOUND, _>(#callee))
            }
            Copy::Plain => parse_quote_spanned!(callee.span()=> (#callee)),
        };
    }

    /// A call of a closure or function of the body's own.
    fn call_inner(
        &mut self,
        inputs: &[Vec<usize>],
        arguments: &mut Punctuated<Expr, syn::Token![,]>,
    ) {
        for (argument, numbers) in arguments.iter().zip(inputs) {
            let nature = self.nature(argument);
            numbers.iter().for_each(|&number| self.scopes.add(number, nature));
        }
        arguments.iter_mut().for_each(|argument| self.visit_expr_mut(argument));
    }

    /// `vec2(x, y)`, `Mat2::identity()`
    fn kin_call(&mut self, expression: &mut Expr) {
        let Expr::Call(call) = expression else { return };
        call.args.iter_mut().for_each(|argument| self.visit_expr_mut(argument));
        if call.args.is_empty() && self.copy == Copy::Dual {
            let dual = &self.dual;
            *expression = parse_quote!(::kin::emitted::Lift::<#dual>::lift(#call));
        }
    }

    /// A call of a parameter, of a field, or of a closure where it stands.
    fn call_of_value(&mut self, expression: &mut Expr) {
        let Expr::Call(call) = expression else { return };
        if self.is_foreign(&call.func) {
            self.place(&mut call.func);
            call.args.iter_mut().for_each(|argument| self.argument(argument));
            return self.lift_result(expression);
        }
        self.visit_expr_mut(&mut call.func);
        call.args.iter_mut().for_each(|argument| self.visit_expr_mut(argument));
    }

    pub fn method_call(&mut self, expression: &mut Expr) {
        let Expr::MethodCall(call) = expression else { return };
        let name = call.method.to_string();
        let nature = self.nature(&call.receiver);
        let known = is_number_method(&name) || is_reading_method(&name);
        if !nature.foreign && is_underived(&name) && self.copy == Copy::Dual {
            // As a function of f64: its arguments are converted.
            let method = &call.method;
            let receiver = &call.receiver;
            let arguments = call.args.iter();
            *expression =
                parse_quote_spanned!(method.span()=> f64::#method(#receiver, #(#arguments),*));
            self.call(expression);
        } else if !nature.foreign {
            self.visit_expr_mut(&mut call.receiver);
            self.method_arguments(call, nature);
        } else if known && !self.is_own(&call.receiver) {
            self.receiver(&mut call.receiver, is_number_method(&name));
            self.method_arguments(call, nature);
        } else if is_changing_method(&name) && !self.is_own(&call.receiver) {
            self.place(&mut call.receiver);
            self.method_arguments(call, nature);
        } else {
            self.place(&mut call.receiver);
            call.args.iter_mut().for_each(|argument| self.argument(argument));
            self.lift_result(expression);
        }
        if self.copy == Copy::Plain && is_beyond_std(&name) {
            let at = mixed(expression);
            *expression = parse_quote_spanned!(at=> { use ::kin::emitted::math::{Functions as _, FunctionsOfTwo as _}; #expression });
        }
    }

    /// The receiver of a method of numbers, or of one that only looks at a container.
    fn receiver(&mut self, receiver: &mut Expr, of_number: bool) {
        let is_place =
            matches!(receiver, Expr::Path(_) | Expr::Field(_) | Expr::Index(_) | Expr::Unary(_));
        match is_place {
            true => self.place(receiver),
            false => self.visit_expr_mut(receiver),
        }
        if self.copy == Copy::Dual && (is_place || of_number) {
            let at = mixed(receiver);
            let dual = &self.dual;
            let value = &*receiver;
            let value = if is_place {
                quote!(::core::clone::Clone::clone(&#value))
            } else {
                quote!(#value)
            };
            *receiver = parse_quote_spanned!(at=> (&&::kin::emitted::Foreign(#value)).receiver(::core::marker::PhantomData::<#dual>));
        }
    }

    fn method_arguments(&mut self, call: &mut ExprMethodCall, receiver: Nature) {
        if let Some(turbofish) = &mut call.turbofish {
            self.visit_angle_bracketed_generic_arguments_mut(turbofish);
        }
        let applied = match call.method.to_string().as_str() {
            "map" | "flat_map" | "filter_map" | "then" | "and_then" => 1,
            "fold" => 2,
            _ => 0,
        };
        for argument in &mut call.args {
            self.name_as_closure(argument, applied);
        }
        self.arguments(&mut call.args, receiver);
    }

    /// The arguments of something that takes values as they are; closures among them are applied to
    /// what the others hold.
    fn arguments(&mut self, arguments: &mut Punctuated<Expr, syn::Token![,]>, receiver: Nature) {
        let nature = arguments.iter().fold(receiver, |all, argument| all.or(self.nature(argument)));
        for argument in arguments {
            match argument {
                Expr::Closure(closure) => drop(self.closure(closure, nature)),
                Expr::Path(path) => {
                    match self.variable(path).and_then(|variable| variable.inputs.clone()) {
                        Some(inputs) => inputs
                            .into_iter()
                            .flatten()
                            .for_each(|number| self.scopes.add(number, nature)),
                        None => self.visit_expr_mut(argument),
                    }
                }
                other => self.visit_expr_mut(other),
            }
        }
    }

    /// `map(f)` with a function of the user's as `map(|a| f(a))`, so that numbers are converted on
    /// their way into it.
    fn name_as_closure(&mut self, argument: &mut Expr, inputs: usize) {
        let Expr::Path(path) = &*argument else { return };
        let users = self.variable(path).is_none()
            && self.inner_function(path).is_none()
            && is_function_name(path);
        if inputs == 0
            || !users
            || is_number_function(path)
            || is_kin_function(path)
            || is_std_function(path)
        {
            return;
        }
        let inputs: Vec<syn::Ident> = ["a", "b"][..inputs]
            .iter()
            .map(|name| syn::Ident::new(name, Span::mixed_site()))
            .collect();
        *argument = parse_quote!(|#(#inputs),*| #path(#(#inputs),*));
    }

    fn is_own(&self, expression: &Expr) -> bool {
        matches!(expression, Expr::Path(path) if self.variable(path).is_some_and(|variable| variable.own))
    }

    /// An argument of the user's function: as it is, or as the plain or dual number that the
    /// function asks for.
    fn argument(&mut self, argument: &mut Expr) {
        self.handed(argument, Place::Argument);
    }

    /// Converts an argument that is handed to the user's function, or put into the user's struct.
    fn handed(&mut self, argument: &mut Expr, place: Place) {
        let nature = self.nature(argument);
        let at = mixed(argument);
        match argument {
            Expr::Closure(closure) => {
                return drop(self.closure(closure, Nature { foreign: true, ..nature }));
            }
            Expr::Lit(literal) if !matches!(literal.lit, Lit::Float(_)) => return,
            Expr::Reference(reference) if reference.mutability.is_some() => {
                self.feed(&reference.expr, nature);
                return self.place(&mut reference.expr);
            }
            Expr::Reference(reference) if nature.foreign => return self.place(&mut reference.expr),
            Expr::Reference(reference) if matches!(*reference.expr, Expr::Closure(_)) => {
                return self.argument(&mut reference.expr);
            }
            Expr::Reference(reference) if !nature.varies || self.copy == Copy::Plain => {
                self.visit_expr_mut(&mut reference.expr);
                let inner = &reference.expr;
                *argument = match self.copy {
                    Copy::Plain => {
                        let lifted = quote!(::kin::emitted::Lift::<f64>::lift(::core::clone::Clone::clone(&#inner)));
                        parse_quote_spanned!(at=> ::kin::emitted::reference_argument(&#inner, &#lifted))
                    }
                    Copy::Dual => {
                        parse_quote_spanned!(at=> ::kin::emitted::reference_argument(&::kin::emitted::constants(&#inner), &#inner))
                    }
                };
                return;
            }
            Expr::Path(path) if self.variable(path).is_none() && is_function_name(path) => {
                return self.visit_expr_mut(argument);
            }
            Expr::Path(_) if nature.foreign => {}
            Expr::Field(_) | Expr::Index(_) if nature.foreign => self.place(argument),
            _ => self.visit_expr_mut(argument),
        }
        *argument = match (self.copy, nature.varies) {
            (Copy::Plain, _) => {
                parse_quote_spanned!(at=> ::kin::emitted::plain_argument(#argument))
            }
            (Copy::Dual, true) if place == Place::Field => {
                parse_quote_spanned!(at=> ::kin::emitted::Jet(#argument).field())
            }
            (Copy::Dual, true) => {
                parse_quote_spanned!(at=> ::kin::emitted::Jet(#argument).argument())
            }
            (Copy::Dual, false) => {
                parse_quote_spanned!(at=> ::kin::emitted::constant_argument(#argument))
            }
        };
    }

    /// True for a field or an element of what only rustc knows.
    pub fn is_part_of_foreign(&self, place: &Expr) -> bool {
        matches!(place, Expr::Field(_) | Expr::Index(_)) && self.is_foreign(place)
    }

    /// A value that is put into a place of the user's struct.
    pub fn put(&mut self, value: &mut Expr) {
        match self.copy {
            Copy::Plain => self.visit_expr_mut(value),
            Copy::Dual => self.handed(value, Place::Field),
        }
    }

    /// A struct of the user's is given its numbers like a function.
    pub fn struct_literal(&mut self, literal: &mut syn::ExprStruct) {
        let kin = is_kin_type(&literal.path);
        for field in &mut literal.fields {
            field.colon_token.get_or_insert_with(Default::default);
            match kin {
                true => self.visit_expr_mut(&mut field.expr),
                false => self.put(&mut field.expr),
            }
        }
        if let Some(rest) = &mut literal.rest {
            self.place(rest);
        }
    }
}

/// Where a value of this world goes.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// Into the user's function.
    Argument,
    /// Into the user's struct.
    Field,
}

/// Where a message about an expression belongs, though its names are the macro's.
pub(super) fn mixed(expression: &Expr) -> Span {
    Span::mixed_site().located_at(expression.span())
}

/// A path that names a function, by convention: its last name is in small letters.
pub(super) fn is_function_name(path: &syn::ExprPath) -> bool {
    names(path).last().is_some_and(|name| name.starts_with(|c: char| c.is_lowercase() || c == '_'))
}
