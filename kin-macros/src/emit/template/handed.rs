//! Structs, states and references, and what is handed to a function that may take it as it is.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, quote, quote_spanned};
use syn::spanned::Spanned;

use super::{Site, Use, Writer, varies};
use crate::emit::probe::{How, Probed};
use kin_graph::Node;
use kin_language::lower::Template;

impl Writer<'_> {
    /// A struct or a variant: of what is put into it only constants may have to be converted.
    pub(super) fn structure(
        &mut self,
        path: &syn::Path,
        fields: &[(String, Template)],
        braces: bool,
        using: Use,
    ) -> TokenStream {
        let std = path.segments.last().is_some_and(|last| {
            matches!(last.ident.to_string().as_str(), "Some" | "None" | "Ok" | "Err")
        });
        let mut all = Vec::new();
        for (_, field) in fields {
            all.push(match (field, self.site) {
                (Template::Numbers(nodes, shape, _), Site::Leaf(graph))
                    if !std && !varies(graph, nodes) =>
                {
                    let built = self.built(nodes, shape);
                    quote!(::kin::emitted::constant_argument(#built))
                }
                (Template::Numbers(nodes, shape, _), _) if !std => self.built(nodes, shape),
                (field, _) if std => self.write(field, using),
                (field, _) => self.write(field, Use::Value),
            });
        }
        let at = path.span();
        let path = lifted_path(path, self.site);
        if !braces {
            return if all.is_empty() { quote!(#path) } else { quote!(#path(#(#all),*)) };
        }
        let names = fields.iter().map(|(name, _)| Ident::new(name, at));
        quote!((#path { #(#names: #all),* }))
    }

    /// The state of a body, for the user's function.
    pub(super) fn state(
        &mut self,
        nodes: &[Node],
        dimension: usize,
        at: Span,
        using: Use,
    ) -> TokenStream {
        let all: Vec<TokenStream> = nodes.iter().map(|&n| (self.value)(n)).collect();
        let built = match dimension {
            2 => {
                let [x, y, theta, sin, cos] = &all[..] else { return quote!(()) };
                quote!(::kin::emitted::PlanarState { r: ::kin::emitted::Vec2::new(#x, #y), theta: #theta, sin: #sin, cos: #cos })
            }
            _ => {
                let r = &all[..3];
                let p = &all[3..7];
                let a = &all[7..];
                let r = quote!(::kin::emitted::Vec3::new(#(#r),*));
                let p = quote!(::kin::emitted::EulerParameters::new(#(#p),*));
                quote!(::kin::emitted::SpatialState { r: #r, p: #p, a: ::kin::emitted::Mat3::new(#(#a),*) })
            }
        };
        match (using, self.site) {
            (Use::Value | Use::Place, _) => quote!((#built)),
            (_, Site::Leaf(_)) => quote_spanned!(at=> ::kin::emitted::Jet(#built).argument()),
            _ => quote_spanned!(at=> ::kin::emitted::plain_argument(#built)),
        }
    }

    pub(super) fn reference(&mut self, inner: &Template, using: Use) -> TokenStream {
        if let (Template::State(nodes, dimension, at), Use::Argument | Use::Field) = (inner, using)
        {
            let built = self.state(nodes, *dimension, *at, Use::Value);
            let at = Span::mixed_site().located_at(*at);
            return match self.site {
                Site::Leaf(_) => quote_spanned!(at=> ::kin::emitted::Jet(&#built).argument()),
                _ => {
                    quote_spanned!(at=> ::kin::emitted::reference_argument(&#built, &::kin::emitted::Lift::<f64>::lift(#built)))
                }
            };
        }
        let (Template::Numbers(nodes, shape, at), Use::Argument | Use::Field) = (inner, using)
        else {
            let place = self.write(inner, Use::Place);
            return quote!((&#place));
        };
        let built = self.built(nodes, shape);
        let at = Span::mixed_site().located_at(*at);
        match self.site {
            Site::Leaf(graph) if varies(graph, nodes) => {
                quote_spanned!(at=> ::kin::emitted::Jet(&#built).argument())
            }
            Site::Leaf(_) => {
                quote_spanned!(at=> ::kin::emitted::reference_argument(&::kin::emitted::constants(&#built), &#built))
            }
            _ => {
                quote_spanned!(at=> ::kin::emitted::reference_argument(&#built, &::kin::emitted::Lift::<f64>::lift(#built)))
            }
        }
    }

    /// An argument of a function that may take it as it is.
    pub(super) fn probed(&mut self, argument: &Template) -> Probed {
        let leaf = if let Site::Leaf(graph) = self.site { Some(graph) } else { None };
        let mixed = |at: &Span| Span::mixed_site().located_at(*at);
        let how = |varying: bool| match (leaf, varying) {
            (None, _) => How::Plain,
            (Some(_), true) => How::Jet,
            (Some(_), false) => How::Constant,
        };
        match argument {
            Template::Numbers(nodes, shape, at) => {
                let varying = leaf.is_some_and(|graph| varies(graph, nodes));
                Probed { value: self.built(nodes, shape), how: how(varying), at: mixed(at) }
            }
            Template::State(nodes, dimension, at) => Probed {
                value: self.state(nodes, *dimension, *at, Use::Value),
                how: how(true),
                at: mixed(at),
            },
            Template::Reference(inner)
                if matches!(**inner, Template::Numbers(..) | Template::State(..)) =>
            {
                let (built, varying, at) = match &**inner {
                    Template::Numbers(nodes, shape, at) => (
                        self.built(nodes, shape),
                        leaf.is_some_and(|graph| varies(graph, nodes)),
                        *at,
                    ),
                    other => (self.write(other, Use::Value), true, argument_span(other)),
                };
                let how = match (leaf, varying) {
                    (None, _) => How::Reference(built.clone()),
                    (Some(_), true) => {
                        return Probed { value: quote!(&#built), how: How::Jet, at: mixed(&at) };
                    }
                    (Some(_), false) => How::ConstantReference(built.clone()),
                };
                Probed { value: built, how, at: mixed(&at) }
            }
            Template::Reference(_) | Template::Struct(..) => Probed {
                value: self.write(argument, Use::Value),
                how: How::AsIs,
                at: Span::mixed_site(),
            },
            other => Probed {
                value: self.write(other, Use::Value),
                how: how(false),
                at: Span::mixed_site(),
            },
        }
    }
}

/// The path of a struct, over the numbers of the place where it is written.
fn lifted_path(path: &syn::Path, site: Site) -> TokenStream {
    match site {
        Site::Leaf(_) => {
            let ty = syn::Type::Path(syn::TypePath { qself: None, path: path.clone() });
            crate::emit::rewrite::lifted_type(&ty).to_token_stream()
        }
        _ => path.to_token_stream(),
    }
}

/// A pattern in which a variable has another name; what is matched by reference needs no `ref`.
pub(super) fn renamed(pattern: &syn::Pat, name: &Ident, own: &Ident, borrows: bool) -> TokenStream {
    struct Rename<'a>(&'a Ident, &'a Ident, bool);
    impl syn::visit_mut::VisitMut for Rename<'_> {
        fn visit_pat_ident_mut(&mut self, pattern: &mut syn::PatIdent) {
            if self.2 {
                (pattern.by_ref, pattern.mutability) = (None, None);
            }
            if pattern.ident == *self.0 {
                pattern.ident = self.1.clone();
            }
            syn::visit_mut::visit_pat_ident_mut(self, pattern);
        }
        fn visit_field_pat_mut(&mut self, field: &mut syn::FieldPat) {
            if matches!(&*field.pat, syn::Pat::Ident(pattern) if pattern.ident == *self.0) {
                field.colon_token.get_or_insert_with(Default::default);
            }
            syn::visit_mut::visit_field_pat_mut(self, field);
        }
    }
    let mut pattern = pattern.clone();
    syn::visit_mut::VisitMut::visit_pat_mut(&mut Rename(name, own, borrows), &mut pattern);
    pattern.to_token_stream()
}

/// More are handed over one by one.
pub(super) const MOST_ARGUMENTS: usize = 6;

/// True if a value has a type of its own, whatever the function asks for: a whole number has not.
pub(super) fn is_bindable(template: &Template) -> bool {
    match template {
        Template::Tokens(_)
        | Template::Tuple(_)
        | Template::Array(_)
        | Template::Choice(..)
        | Template::When(..) => false,
        Template::Reference(inner) => is_bindable(inner),
        _ => true,
    }
}

fn argument_span(template: &Template) -> Span {
    match template {
        Template::State(_, _, at) | Template::Numbers(_, _, at) => *at,
        _ => Span::call_site(),
    }
}
