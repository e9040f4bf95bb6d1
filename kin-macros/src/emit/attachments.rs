//! The points and directions of its bodies that a constraint speaks of, for drawings and messages.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use syn::visit::Visit;

use super::kernel::Kernel;
use kin_graph::Node;
use kin_language::lower::Lowered;
use kin_language::parse::{Argument, ConstraintFn, Kind, Shape};

/// From the graph: everything that is fixed in a body, whatever it is computed from.
pub fn symbolic(arguments: &[Argument], lowered: &Lowered) -> TokenStream {
    let all = &lowered.attachments;
    let nodes: Vec<Node> = all.iter().flat_map(|a| a.local.iter().copied()).collect();
    let (code, values) = Kernel::plain(lowered, arguments).values(&nodes);
    let mut values = values.into_iter();
    let listed = all
        .iter()
        .map(|a| listed(a.slot, a.is_point, values.by_ref().take(a.local.len()).collect()));
    method(&code.tokens, listed.collect())
}

/// Of a body that nobody could read: the points and directions that are parameters, `i.point(u_i)`.
pub fn dual(source: &ConstraintFn) -> TokenStream {
    let mut search = Search { arguments: &source.arguments, found: Vec::new() };
    search.visit_block(&source.body);
    let listed = search.found.iter().map(|(slot, is_point, parameter, n)| {
        let parts = [quote!(x), quote!(y), quote!(z)];
        listed(
            *slot,
            *is_point,
            parts.iter().take(*n).map(|part| quote!(self.#parameter.#part)).collect(),
        )
    });
    method(&quote!(), listed.collect())
}

/// One of them: `point(0, [self.u_i.x, self.u_i.y, 0.0])`.
fn listed(slot: usize, is_point: bool, mut components: Vec<TokenStream>) -> TokenStream {
    let slot = Literal::usize_unsuffixed(slot);
    components.resize(3, quote!(0.0));
    let what = if is_point { quote!(point) } else { quote!(direction) };
    quote!(::kin::emitted::#what(#slot, [#(#components),*]))
}

/// `attachments`: nothing where there is none.
fn method(code: &TokenStream, all: Vec<TokenStream>) -> TokenStream {
    if all.is_empty() {
        return quote!();
    }
    quote! {
        fn attachments(&self) -> ::std::vec::Vec<::kin::emitted::Attachment> {
            #code
            ::kin::emitted::attachments(&[#(#all),*])
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
        let Some(argument) = call
            .args
            .first()
            .filter(|_| call.args.len() == 1 && (is_point || call.method == "direction"))
        else {
            return;
        };
        let (Some(body), Some(vector)) = (self.argument(&call.receiver), self.argument(argument))
        else {
            return;
        };
        let body_kind = &self.arguments[body].kind;
        let parameter = &self.arguments[vector];
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
