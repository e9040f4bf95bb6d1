//! Expressions of the user's that emitted code repeats, with values of the graph put in.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use crate::graph::{Graph, Node};
use crate::lower::value::Template;
use crate::lower::{OpaqueKind, OpaqueValue, component_paths};
use crate::parse::Shape;

/// The expression in plain numbers.
pub fn plain(template: &Template, value: &mut dyn FnMut(Node) -> TokenStream) -> TokenStream {
    write(template, Use::Value, Site::Copy, &mut |nodes, shape| {
        let numbers: Vec<TokenStream> = nodes.iter().map(|&n| value(n)).collect();
        let built = build(shape, &mut numbers.into_iter());
        quote!(::kin::rt::plain_argument(#built))
    })
}

/// A law as a place: parameters are not cloned.
pub fn place(template: &Template) -> TokenStream {
    match template {
        Template::Parameter(name) => quote!(self.#name),
        other => write(other, Use::Place, Site::Copy, &mut |_, _| quote!(())),
    }
}

/// An expression without values of the graph, for rustc to say what is wrong with it; the constraint is `__self`.
pub fn check(template: &Template) -> TokenStream {
    write(template, Use::Value, Site::Check, &mut |_, _| quote!(()))
}

/// Whether a parameter is handed over, or only looked at.
#[derive(Clone, Copy, PartialEq)]
enum Use {
    Value,
    Place,
}

/// Where it is written: in a copy that is silent where the written function does not compile, or in the check of constants.
#[derive(Clone, Copy, PartialEq)]
enum Site {
    Copy,
    Check,
}

fn write(template: &Template, using: Use, site: Site, numbers: &mut dyn FnMut(&[Node], &Shape) -> TokenStream) -> TokenStream {
    let mut write = |template: &Template, using: Use, numbers: &mut dyn FnMut(&[Node], &Shape) -> TokenStream| write(template, using, site, numbers);
    match template {
        Template::Tokens(tokens) => tokens.clone(),
        Template::Numbers(nodes, shape) => numbers(nodes, shape),
        Template::Parameter(name) => match (site, using) {
            (Site::Copy, Use::Place) => quote!((*__checked(&self.#name))),
            (Site::Copy, Use::Value) => quote!(__checked(self.#name.clone())),
            (Site::Check, Use::Place) => quote!(__self.#name),
            (Site::Check, Use::Value) => quote!(__self.#name.clone()),
        },
        Template::Call(callee, all) => {
            let all: Vec<_> = all.iter().map(|a| write(a, Use::Value, numbers)).collect();
            match site {
                Site::Copy => quote!(__checked(#callee)(#(#all),*)),
                Site::Check => quote!(#callee(#(#all),*)),
            }
        }
        Template::Method(receiver, method, all) => {
            let receiver = write(receiver, Use::Place, numbers);
            let all: Vec<_> = all.iter().map(|a| write(a, Use::Value, numbers)).collect();
            quote!(#receiver.#method(#(#all),*))
        }
        Template::Field(base, member) => {
            let base = write(base, Use::Place, numbers);
            quote!(#base.#member)
        }
        Template::Index(base, index) => {
            let base = match &**base {
                Template::Numbers(nodes, shape) => {
                    let built = numbers(nodes, shape);
                    quote!((#built))
                }
                base => write(base, Use::Place, numbers),
            };
            let index = write(index, Use::Value, numbers);
            quote!(#base[#index])
        }
        Template::Binary(a, op, b) => {
            let (a, b) = (write(a, Use::Value, numbers), write(b, Use::Value, numbers));
            quote!((#a #op #b))
        }
        Template::Unary(op, a) => {
            let a = write(a, Use::Value, numbers);
            quote!((#op #a))
        }
        Template::Cast(a, ty) => {
            let a = write(a, Use::Value, numbers);
            quote!((#a as #ty))
        }
        Template::Reference(a) => {
            let a = write(a, Use::Place, numbers);
            quote!((&#a))
        }
        Template::Matches(a, pattern) => {
            let a = write(a, Use::Place, numbers);
            quote!(::core::matches!(#a, #pattern))
        }
    }
}

/// A value of `shape` from its numbers.
pub fn build(shape: &Shape, numbers: &mut dyn Iterator<Item = TokenStream>) -> TokenStream {
    let mut several = |name: &str, n: usize| {
        let name = Ident::new(name, Span::call_site());
        let all: Vec<TokenStream> = (0..n).filter_map(|_| numbers.next()).collect();
        quote!(::kin::rt::#name::new(#(#all),*))
    };
    match shape {
        Shape::Scalar | Shape::Any => numbers.next().unwrap_or_default(),
        Shape::Vector(n) => several(if *n == 2 { "Vec2" } else { "Vec3" }, *n),
        Shape::Matrix(n) => several(if *n == 2 { "Mat2" } else { "Mat3" }, n * n),
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
        Shape::Vector(2) => quote!(::kin::rt::Vec2<#scalar>),
        Shape::Vector(_) => quote!(::kin::rt::Vec3<#scalar>),
        Shape::Matrix(2) => quote!(::kin::rt::Mat2<#scalar>),
        Shape::Matrix(_) => quote!(::kin::rt::Mat3<#scalar>),
        Shape::Array(inner, n) => {
            let (inner, n) = (shape_type(inner, scalar), Literal::usize_unsuffixed(*n));
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

/// The user's call as a function of its arguments that carry derivatives, generic over the dual number.
pub fn leaf_function(graph: &Graph, leaf: usize, value: &OpaqueValue, outer: &[TokenStream]) -> TokenStream {
    let name = leaf_name(leaf);
    let OpaqueKind::Numbers(shape) = &value.kind else { return quote!() };
    let output = shape_type(shape, &quote!(::kin::rt::Real<__D>));
    let n = Literal::usize_unsuffixed(graph.leaves[leaf].arguments.len());
    let mut next = 0;
    let body = write(&value.template, Use::Value, Site::Copy, &mut |nodes, shape| {
        let varies = nodes.iter().any(|&node| graph.depends(node).varies());
        let mut numbers = nodes.iter().map(|_| {
            let k = Literal::usize_unsuffixed(next);
            next += 1;
            quote!(x[#k])
        });
        let built = build(shape, &mut numbers);
        if varies { quote!(::kin::rt::jet_argument(#built)) } else { quote!(::kin::rt::constant_argument(#built)) }
    });
    super::written::silent(quote! {
        fn #name<__D>(&self, x: [::kin::rt::Real<__D>; #n]) -> #output {
            #(#outer)*
            #body
        }
    })
}
