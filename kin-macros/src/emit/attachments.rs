//! The points and directions of its bodies that a constraint speaks of, for drawings and messages.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;
use syn::visit::Visit;

use super::kernel::Kernel;
use crate::lower::Lowered;
use crate::parse::{Argument, ConstraintFn, Kind, Shape};

/// From the graph: everything that is fixed in a body, whatever it is computed from.
pub fn symbolic(arguments: &[Argument], lowered: &Lowered) -> TokenStream {
    let all = &lowered.attachments;
    let place = |k: usize, axis: usize| {
        let (u, k, axis) = (Ident::new("u", Span::mixed_site()), Literal::usize_unsuffixed(k), Literal::usize_unsuffixed(axis));
        quote!(#u[#k][#axis])
    };
    let outputs: Vec<_> =
        all.iter().enumerate().flat_map(|(k, a)| a.local.iter().enumerate().map(move |(axis, node)| (place(k, axis), *node))).collect();
    let code = Kernel::emit(lowered, arguments, &outputs).tokens;
    method(all.iter().map(|a| (a.slot, a.is_point)).collect(), &code)
}

/// Of a body that nobody could read: the points and directions that are parameters, `i.point(u_i)`.
pub fn dual(source: &ConstraintFn) -> TokenStream {
    let mut search = Search { arguments: &source.arguments, found: Vec::new() };
    search.visit_block(&source.body);
    let u = Ident::new("u", Span::mixed_site());
    let writes = search.found.iter().enumerate().map(|(k, (_, _, parameter, n))| {
        let (k, parts) = (Literal::usize_unsuffixed(k), [quote!(x), quote!(y), quote!(z)]);
        let writes = parts.iter().take(*n).enumerate().map(|(axis, part)| {
            let axis = Literal::usize_unsuffixed(axis);
            quote!(#u[#k][#axis] = self.#parameter.#part;)
        });
        quote!(#(#writes)*)
    });
    let code = quote!(#(#writes)*);
    method(search.found.iter().map(|(slot, is_point, ..)| (*slot, *is_point)).collect(), &code)
}

/// `attachments`, where `code` writes the components of each into `u`.
fn method(all: Vec<(usize, bool)>, code: &TokenStream) -> TokenStream {
    if all.is_empty() {
        return quote!();
    }
    let (u, n) = (Ident::new("u", Span::mixed_site()), Literal::usize_unsuffixed(all.len()));
    let made = all.iter().map(|(slot, is_point)| {
        let slot = Literal::usize_unsuffixed(*slot);
        quote!((#slot, #is_point))
    });
    quote! {
        fn attachments(&self) -> ::std::vec::Vec<::kin::rt::Attachment> {
            let mut #u = [[0.0_f64; 3]; #n];
            #code
            ::kin::rt::attachments(&[#(#made),*], &#u)
        }
    }
}

/// Looks for `b.point(u)` and `b.direction(h)` of a body and a vector of the signature.
struct Search<'a> {
    arguments: &'a [Argument],
    /// Slot, whether it is a point, the parameter, its dimension.
    found: Vec<(usize, bool, Ident, usize)>,
}

impl Search<'_> {
    /// The argument that an expression names.
    fn argument(&self, expression: &syn::Expr) -> Option<usize> {
        let syn::Expr::Path(path) = expression else { return None };
        let name = path.path.get_ident()?;
        self.arguments.iter().position(|argument| argument.name == *name)
    }
}

impl<'ast> Visit<'ast> for Search<'_> {
    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        syn::visit::visit_expr_method_call(self, call);
        let is_point = call.method == "point";
        let Some(argument) = call.args.first().filter(|_| call.args.len() == 1 && (is_point || call.method == "direction")) else { return };
        let (Some(body), Some(vector)) = (self.argument(&call.receiver), self.argument(argument)) else { return };
        let (body_kind, parameter) = (&self.arguments[body].kind, &self.arguments[vector]);
        let dimension = match (body_kind, &parameter.kind) {
            (Kind::Planar, Kind::Numbers(Shape::Vector(2))) => 2,
            (Kind::Spatial, Kind::Numbers(Shape::Vector(3))) => 3,
            _ => return,
        };
        let slot = self.arguments[..body].iter().map(|argument| argument.kind.slots()).sum();
        let one = (slot, is_point, parameter.name.clone(), dimension);
        if !self.found.contains(&one) {
            self.found.push(one);
        }
    }
}
