//! Expressions of the user's that emitted code repeats, with values of the graph put in.

mod handed;

use proc_macro2::{Delimiter, Group, Ident, Literal, Span, TokenStream};
use quote::{ToTokens, format_ident, quote, quote_spanned};
use syn::spanned::Spanned;

use super::written::{located, silent};
use handed::{MOST_ARGUMENTS, is_bindable, renamed};
use kin_graph::{Graph, Node};
use kin_language::lower::Template;
use kin_language::lower::{OpaqueKind, OpaqueValue, component_paths};
use kin_language::parse::Shape;
use kin_language::vocabulary::{
    is_kin_function, is_number_method, is_reading_method, is_std_function, is_type_name,
};

/// The expression in plain numbers.
pub fn plain(template: &Template, value: &mut dyn FnMut(Node) -> TokenStream) -> TokenStream {
    if let Template::When(condition, inner) = template {
        let condition = value(*condition);
        let inner = plain(inner, value);
        return quote!(if #condition { #inner } else { ::kin::emitted::absent() });
    }
    Writer::new(value, Site::Kernel).lowered(template)
}

/// The expression as a place: parameters are not cloned.
pub fn place(template: &Template) -> TokenStream {
    Writer::new(&mut |_| quote!(()), Site::Kernel).write(template, Use::Place)
}

/// An expression without values of the graph, for rustc to say what is wrong with it; the
/// constraint is `__self`.
pub fn check(template: &Template) -> TokenStream {
    Writer::new(&mut |_| quote!(()), Site::Check).lowered(template)
}

/// True if the value may come out of a function of the user's, which may give `Real<f64>`.
fn calls(template: &Template) -> bool {
    use syn::BinOp::{And, Eq, Ge, Gt, Le, Lt, Ne, Or};
    match template {
        Template::Call(..) | Template::Method(..) | Template::Part(..) => true,
        Template::Field(a, _)
        | Template::Index(a, _)
        | Template::Unary(_, a)
        | Template::Reference(a)
        | Template::Cast(a, _) => calls(a),
        Template::Binary(_, And(_) | Eq(_) | Ge(_) | Gt(_) | Le(_) | Lt(_) | Ne(_) | Or(_), _) => {
            false
        }
        Template::Binary(a, _, b) => calls(a) || calls(b),
        _ => false,
    }
}

/// The treatment of a part of the expression.
#[derive(Clone, Copy, PartialEq)]
enum Use {
    /// It is handed over.
    Value,
    /// It is only looked at.
    Place,
    /// It is an argument of the user's function, which may ask for f64 or for `Real<D>`.
    Argument,
    /// It is put into the user's struct.
    Field,
}

/// Where it is written.
#[derive(Clone, Copy)]
enum Site<'a> {
    /// In a method of plain numbers.
    Kernel,
    /// In a method generic over `__D`.
    Leaf(&'a Graph),
    /// In the check of constants.
    Check,
}

struct Writer<'a> {
    value: &'a mut dyn FnMut(Node) -> TokenStream,
    site: Site<'a>,
    /// The parts that a pattern calls by a name in a value that it matches: the key of each, and
    /// its name here.
    parts: Vec<(String, Ident)>,
}

impl<'a> Writer<'a> {
    fn new(value: &'a mut dyn FnMut(Node) -> TokenStream, site: Site<'a>) -> Self {
        Writer { value, site, parts: vec![] }
    }

    /// The expression, inside of the matches that what is in it comes from.
    fn whole(&mut self, template: &Template) -> TokenStream {
        let mut matches: Vec<(TokenStream, TokenStream)> = Vec::new();
        for part in template.matched_parts() {
            let (Template::Part(value, pattern, name), key) = (part, part.key()) else { continue };
            if self.parts.iter().any(|(known, _)| *known == key) {
                continue;
            }
            let own = super::own(&format!("part_{}", self.parts.len()));
            let place = self.write(value, Use::Place);
            let borrows = matches!(
                **value,
                Template::Parameter(_)
                    | Template::Field(..)
                    | Template::Part(..)
                    | Template::Index(..)
            );
            matches.push((
                if borrows { quote!(&#place) } else { place },
                renamed(pattern, name, &own, borrows),
            ));
            self.parts.push((key, own));
        }
        let inner = self.write(template, Use::Value);
        matches.into_iter().rev().fold(inner, |inner, (value, pattern)| {
            quote!(match #value { #pattern => { #inner } #[allow(unreachable_patterns)] _ => ::kin::emitted::absent() })
        })
    }

    /// In plain numbers, though a function of the user's may give `Real<f64>`.
    fn lowered(&mut self, template: &Template) -> TokenStream {
        let written = self.whole(template);
        if calls(template) { quote!(::kin::emitted::lowered(#written)) } else { written }
    }

    fn write(&mut self, template: &Template, using: Use) -> TokenStream {
        match template {
            Template::Tokens(tokens) => tokens.clone(),
            Template::Numbers(nodes, shape, at) => {
                self.numbers(nodes, shape, Span::mixed_site().located_at(*at), using)
            }
            Template::Reference(a) => self.reference(a, using),
            Template::Tuple(all) => {
                let all: Vec<_> = all.iter().map(|a| self.write(a, using)).collect();
                quote!((#(#all,)*))
            }
            Template::Array(all) => {
                let all: Vec<_> = all.iter().map(|a| self.write(a, using)).collect();
                quote!([#(#all),*])
            }
            Template::Choice(condition, a, b) => {
                let condition = (self.value)(*condition);
                let a = self.write(a, using);
                let b = self.write(b, using);
                quote!(if #condition { #a } else { #b })
            }
            Template::When(_, a) => self.write(a, using),
            Template::State(nodes, dimension, at) => {
                self.state(nodes, *dimension, Span::mixed_site().located_at(*at), using)
            }
            Template::Struct(path, fields, braces) => self.structure(path, fields, *braces, using),
            Template::Part(..) if !matches!(using, Use::Argument | Use::Field) => {
                let key = template.key();
                let name = self.parts.iter().find(|(known, _)| *known == key).map(|(_, name)| name);
                if using == Use::Place { quote!(#name) } else { quote!(#name.clone()) }
            }
            other if matches!(using, Use::Argument | Use::Field) => {
                let written = self.write(other, Use::Value);
                match self.site {
                    Site::Leaf(_) => quote!(::kin::emitted::constant_argument(#written)),
                    Site::Kernel | Site::Check => quote!(::kin::emitted::plain_argument(#written)),
                }
            }
            Template::Part(..) => quote!(()),
            Template::Path(path, around) if around.is_empty() || using == Use::Place => {
                path.to_token_stream()
            }
            Template::Path(path, around) => {
                let names = around.iter();
                let units = around.iter().map(|_| quote!(()));
                quote!({ let [#(#names),*] = [#(#units),*]; #path })
            }
            Template::Parameter(name) => {
                let place = if let Site::Check = self.site {
                    quote!(__self.#name)
                } else {
                    quote!(self.#name)
                };
                let at = Span::mixed_site().located_at(name.span());
                match using {
                    Use::Place => place,
                    _ => quote_spanned!(at=> ::core::clone::Clone::clone(&#place)),
                }
            }
            other => self.computed(other),
        }
    }

    /// The code that is computed of parts.
    fn computed(&mut self, template: &Template) -> TokenStream {
        match template {
            Template::Call(callee, all, at) => self.call(callee, all, *at),
            Template::Method(receiver, method, all) => self.method(receiver, method, all),
            Template::Field(base, member) => {
                let base = self.write(base, Use::Place);
                quote!(#base.#member)
            }
            Template::Index(base, index) => {
                let base = self.write(base, Use::Place);
                let index = self.write(index, Use::Value);
                quote!(#base[#index])
            }
            Template::Binary(a, op, b) => {
                let a = self.write(a, Use::Value);
                let b = self.write(b, Use::Value);
                if super::rewrite::is_compound(op) {
                    let whole = Ident::new("whole", Span::mixed_site());
                    return quote!({ let mut #whole = #a; #whole #op #b; #whole });
                }
                // In parentheses at the user's operator: what is wrong with the whole is said
                // there.
                quote_spanned!(Span::mixed_site().located_at(op.span())=> (#a #op #b))
            }
            Template::Unary(op, a) => {
                let a = self.write(a, Use::Value);
                quote_spanned!(Span::mixed_site().located_at(op.span())=> (#op #a))
            }
            Template::Cast(a, ty) => self.cast(a, ty),
            Template::Matches(a, pattern) => {
                let a = self.write(a, Use::Place);
                quote!(::core::matches!(#a, #pattern))
            }
            _ => quote!(()),
        }
    }

    fn method(
        &mut self,
        receiver: &Template,
        method: &TokenStream,
        all: &[Template],
    ) -> TokenStream {
        let using = if takes_numbers(receiver, method) { Use::Value } else { Use::Argument };
        let receiver = self.write(receiver, Use::Place);
        let all: Vec<_> = all.iter().map(|a| self.write(a, using)).collect();
        quote!(#receiver.#method(#(#all),*))
    }

    /// Values of the graph, converted where the user's function may ask for another kind of number.
    fn numbers(&mut self, nodes: &[Node], shape: &Shape, at: Span, using: Use) -> TokenStream {
        let built = self.built(nodes, shape);
        let built =
            if matches!(using, Use::Argument | Use::Field) { located(built, at) } else { built };
        match (using, self.site) {
            (Use::Place, _) => quote!((#built)),
            (Use::Value, _) => built,
            (Use::Argument, Site::Leaf(graph)) if varies(graph, nodes) => {
                quote_spanned!(at=> ::kin::emitted::Jet(#built).argument())
            }
            (Use::Field, Site::Leaf(graph)) if varies(graph, nodes) => {
                quote_spanned!(at=> ::kin::emitted::Jet(#built).field())
            }
            (Use::Argument | Use::Field, Site::Leaf(_)) => {
                quote_spanned!(at=> ::kin::emitted::constant_argument(#built))
            }
            (Use::Argument | Use::Field, _) => {
                quote_spanned!(at=> ::kin::emitted::plain_argument(#built))
            }
        }
    }

    fn call(&mut self, callee: &Template, all: &[Template], at: Span) -> TokenStream {
        let std = matches!(callee, Template::Path(path, _) if is_std_function(path) || is_kin_function(path));
        let using = match callee {
            _ if std => Use::Value,
            Template::Path(path, _) if is_type_name(path) => Use::Field,
            _ => Use::Argument,
        };
        let callee = match callee {
            // Of unknown type where the function as it was written does not compile: what is wrong
            // with the call is said once.
            Template::Path(path, _)
                if using == Use::Argument && !matches!(self.site, Site::Check) =>
            {
                quote_spanned!(Span::mixed_site().located_at(path.span())=> ::kin::emitted::callee::<__SOUND, _>(#path))
            }
            Template::Path(path, _) => path.to_token_stream(),
            other => {
                let place = self.write(other, Use::Place);
                quote!((#place))
            }
        };
        if using == Use::Argument
            && !matches!(self.site, Site::Check)
            && all.len() <= MOST_ARGUMENTS
            && all.iter().all(is_bindable)
        {
            let arguments = all.iter().map(|argument| self.probed(argument)).collect();
            return super::probe::call(&callee, arguments, at);
        }
        let all: Vec<_> = all.iter().map(|a| self.write(a, using)).collect();
        let mut arguments = Group::new(Delimiter::Parenthesis, quote!(#(#all),*));
        arguments.set_span(at);
        quote!(#callee #arguments)
    }

    /// `as` cannot be applied to `Real`.
    fn cast(&mut self, inner: &Template, ty: &TokenStream) -> TokenStream {
        let written = self.write(inner, Use::Value);
        match (calls(inner), ty.to_string().as_str(), self.site) {
            (true, "f64", Site::Leaf(_)) => quote!(::kin::emitted::cast::<__D, _>(#written)),
            (true, "f64", _) => quote!(::kin::emitted::cast::<f64, _>(#written)),
            (true, _, _) => quote!(::kin::emitted::whole::<#ty, _>(#written)),
            (false, _, _) => quote!((#written as #ty)),
        }
    }

    fn built(&mut self, nodes: &[Node], shape: &Shape) -> TokenStream {
        let numbers: Vec<TokenStream> = nodes.iter().map(|&n| (self.value)(n)).collect();
        build(shape, &mut numbers.into_iter())
    }
}

/// True if a method takes Kin's own numbers as they are; on a parameter itself it is the user's,
/// whatever its name.
fn takes_numbers(receiver: &Template, method: &TokenStream) -> bool {
    let name = method.clone().into_iter().next().map(|token| token.to_string()).unwrap_or_default();
    !matches!(receiver, Template::Parameter(_))
        && (is_number_method(&name) || is_reading_method(&name))
}

fn varies(graph: &Graph, nodes: &[Node]) -> bool {
    nodes.iter().any(|&node| graph.depends(node).varies())
}

/// A value of `shape` from its numbers.
pub fn build(shape: &Shape, numbers: &mut dyn Iterator<Item = TokenStream>) -> TokenStream {
    match shape {
        Shape::Scalar | Shape::Any => numbers.next().unwrap_or_default(),
        Shape::Vector(_) | Shape::Matrix(_) | Shape::Euler => {
            let name = type_name(shape);
            let all: Vec<TokenStream> = (0..shape.count()).map_while(|_| numbers.next()).collect();
            quote!(::kin::emitted::#name::new(#(#all),*))
        }
        Shape::Array(inner, n) => {
            let all: Vec<TokenStream> = (0..*n).map(|_| build(inner, numbers)).collect();
            quote!([#(#all),*])
        }
        Shape::Tuple(shapes) => {
            let all: Vec<TokenStream> = shapes.iter().map(|s| build(s, numbers)).collect();
            quote!((#(#all,)*))
        }
    }
}

/// The name of a type with components.
fn type_name(shape: &Shape) -> Ident {
    Ident::new(&shape.name(), Span::call_site())
}

/// The type of an opaque value, in plain numbers.
pub fn kind_type(kind: &OpaqueKind) -> TokenStream {
    match kind {
        OpaqueKind::Condition => quote!(bool),
        OpaqueKind::Numbers(shape) => shape_type(shape, &quote!(f64)),
    }
}

/// A shape as a type over the given scalar.
pub fn shape_type(shape: &Shape, scalar: &TokenStream) -> TokenStream {
    match shape {
        Shape::Scalar | Shape::Any => scalar.clone(),
        Shape::Vector(_) | Shape::Matrix(_) | Shape::Euler => {
            let name = type_name(shape);
            quote!(::kin::emitted::#name<#scalar>)
        }
        Shape::Array(inner, n) => {
            let inner = shape_type(inner, scalar);
            let n = Literal::usize_unsuffixed(*n);
            quote!([#inner; #n])
        }
        Shape::Tuple(all) => {
            let all: Vec<TokenStream> = all.iter().map(|s| shape_type(s, scalar)).collect();
            quote!((#(#all,)*))
        }
    }
}

/// One number of an evaluated value.
pub fn component(name: &Ident, kind: &OpaqueKind, component: usize) -> TokenStream {
    match kind {
        OpaqueKind::Condition => quote!(#name),
        OpaqueKind::Numbers(shape) => component_paths(&quote!(#name), shape).swap_remove(component),
    }
}

pub fn leaf_name(leaf: usize) -> Ident {
    format_ident!("__leaf{leaf}")
}

/// The user's call as a function of its arguments that carry derivatives, generic over the dual
/// number.
pub fn leaf_function(
    graph: &Graph,
    leaf: usize,
    value: &OpaqueValue,
    items: &[syn::Item],
) -> TokenStream {
    let name = leaf_name(leaf);
    let OpaqueKind::Numbers(shape) = &value.kind else { return quote!() };
    let n = Literal::usize_unsuffixed(graph.leaves[leaf].arguments.len());
    // A function of the user's may be called `x`.
    let x = Ident::new("x", Span::mixed_site());
    let mut next = 0;
    let mut value_of = |_| {
        let k = Literal::usize_unsuffixed(next);
        next += 1;
        quote!(#x[#k])
    };
    let body = Writer::new(&mut value_of, Site::Leaf(graph)).whole(&value.template);
    // A value without derivatives, such as an f64, is a constant of the dual copy.
    let body = quote!((&::kin::emitted::Foreign(#body)).lifted(::core::marker::PhantomData::<__D>));
    let output = shape_type(shape, &quote!(::kin::emitted::Real<__D>));
    let [input, output, body] = [quote!([::kin::emitted::Real<__D>; #n]), output, body].map(silent);
    quote! {
        fn #name<__D: ::kin::emitted::Dual>(&self, #x: #input) -> #output {
            #(#[allow(unused)] #items)*
            #body
        }
    }
}
