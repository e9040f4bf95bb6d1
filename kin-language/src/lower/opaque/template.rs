//! Expressions that only rustc understands. Emitted code repeats them as the user wrote them, with
//! values of the graph inserted.

use std::rc::Rc;

use proc_macro2::{Ident, Span, TokenStream};
use quote::ToTokens;

use crate::parse::Shape;
use kin_graph::Node;

/// An expression that emitted code repeats.
#[derive(Clone)]
pub enum Template {
    /// Tokens that emitted code repeats unchanged.
    Tokens(TokenStream),
    /// A path that is no variable: a constant, or the name of a function. For a name in small
    /// letters, which may be a typing error, the variables in scope come with it: rustc then gives
    /// the same message in every copy of the body, and shows it once.
    Path(syn::ExprPath, Rc<[Ident]>),
    /// Values of the graph, with the span of their source.
    Numbers(Vec<Node>, Shape, Span),
    /// A field of the constraint: a parameter whose type only rustc knows.
    Parameter(Ident),
    /// A call, with the span of its parentheses.
    Call(Box<Template>, Vec<Template>, Span),
    Method(Box<Template>, TokenStream, Vec<Template>),
    Field(Box<Template>, syn::Member),
    Index(Box<Template>, Box<Template>),
    Binary(Box<Template>, syn::BinOp, Box<Template>),
    Unary(syn::UnOp, Box<Template>),
    Cast(Box<Template>, TokenStream),
    Reference(Box<Template>),
    Tuple(Vec<Template>),
    Array(Vec<Template>),
    /// A value of a struct or a variant: its path, its fields, and true if the fields are in
    /// braces.
    Struct(syn::Path, Vec<(String, Template)>, bool),
    /// The state of a body, with its numbers: R, θ, sin θ, cos θ of a planar body; R, p, A of a
    /// spatial one.
    State(Vec<Node>, usize, Span),
    /// The part of the value to which a pattern gives this name, if the pattern matches.
    Part(Box<Template>, Box<syn::Pat>, Ident),
    /// The condition that the value matches the pattern.
    Matches(Box<Template>, TokenStream),
    /// One of two values, by a condition; their place decides their type.
    Choice(Node, Box<Template>, Box<Template>),
    /// The value where a condition holds; elsewhere emitted code does not compute it.
    When(Node, Box<Template>),
}

impl Template {
    /// Makes a path without variables in scope.
    pub fn path(path: &syn::ExprPath) -> Self {
        Template::Path(path.clone(), Rc::from([]))
    }

    /// Returns the values of the graph in the template, in order.
    pub fn nodes(&self) -> Vec<Node> {
        let mut nodes = Vec::new();
        self.visit(&mut |template| match template {
            Template::Numbers(numbers, ..) | Template::State(numbers, ..) => nodes.extend(numbers),
            Template::When(condition, _) | Template::Choice(condition, ..) => {
                nodes.push(*condition)
            }
            _ => {}
        });
        nodes
    }

    /// Returns the span at which the template begins, if it is known.
    pub fn place(&self) -> Option<Span> {
        match self {
            Template::Tokens(tokens) => tokens.clone().into_iter().next().map(|token| token.span()),
            Template::Path(path, _) => {
                path.to_token_stream().into_iter().next().map(|token| token.span())
            }
            Template::Numbers(_, _, at) | Template::State(_, _, at) => Some(*at),
            Template::Parameter(name) => Some(name.span()),
            other => other.parts().into_iter().find_map(Template::place),
        }
    }

    /// Returns the functions that the template calls, as the user wrote them, with their spans.
    pub fn called(&self) -> Vec<(String, Span)> {
        let mut found = Vec::new();
        self.visit(&mut |template| {
            let tokens = match template {
                Template::Call(callee, ..) => match &**callee {
                    Template::Path(path, _) => path.to_token_stream(),
                    _ => return,
                },
                Template::Method(_, name, _) => name.clone(),
                _ => return,
            };
            let span = tokens.clone().into_iter().next().map(|token| token.span());
            found.extend(span.map(|span| (crate::error::tidy(&tokens.to_string()), span)));
        });
        found
    }

    /// Returns the constants of the program and the functions by path that the template uses
    /// without a call, as the user wrote them, with their spans.
    pub fn named(&self) -> Vec<(String, Span)> {
        let mut found = Vec::new();
        let mut callee = None;
        self.visit(&mut |template| {
            // The visitor reaches a callee directly after its call.
            let is_callee = callee.take() == Some(std::ptr::from_ref(template));
            match template {
                Template::Call(called, ..) => callee = Some(std::ptr::from_ref(&**called)),
                Template::Path(path, _) if is_own(path, is_callee) => {
                    let span = path.to_token_stream().into_iter().next().map(|token| token.span());
                    let name = crate::error::tidy_text(path);
                    found.extend(span.map(|span| (name, span)));
                }
                _ => {}
            }
        });
        found
    }

    /// Returns the number of templates in the template.
    pub fn size(&self) -> usize {
        1 + self.parts().into_iter().map(Template::size).sum::<usize>()
    }

    /// Returns true if the computation may panic: an index out of range, a division of integers, a
    /// function of the user's program.
    pub fn may_panic(&self) -> bool {
        let mut found = false;
        self.visit(&mut |template| {
            found |= matches!(
                template,
                Template::Call(..)
                    | Template::Method(..)
                    | Template::Index(..)
                    | Template::Binary(..)
                    | Template::Unary(..)
            );
        });
        found
    }

    /// Returns the parts that have a value only where a pattern matches; inner ones come before
    /// outer ones.
    pub fn matched_parts(&self) -> Vec<&Template> {
        let mut found: Vec<&Template> =
            self.parts().into_iter().flat_map(Template::matched_parts).collect();
        if let Template::Part(..) = self {
            found.push(self);
        }
        found
    }

    /// Returns true if the template holds a choice whose type its place has not decided yet.
    pub fn has_choice(&self) -> bool {
        let mut found = false;
        self.visit(&mut |template| found |= matches!(template, Template::Choice(..)));
        found
    }

    /// Applies `f` to the template, or to both sides of a choice.
    pub fn each(self, f: &dyn Fn(Template) -> Template) -> Template {
        match self {
            Template::Choice(condition, a, b) => {
                Template::Choice(condition, Box::new(a.each(f)), Box::new(b.each(f)))
            }
            other => f(other),
        }
    }

    fn visit(&self, f: &mut dyn FnMut(&Template)) {
        f(self);
        self.parts().into_iter().for_each(|part| part.visit(f));
    }

    pub fn parts(&self) -> Vec<&Template> {
        match self {
            Template::Tokens(_)
            | Template::Path(..)
            | Template::Numbers(..)
            | Template::State(..)
            | Template::Parameter(_) => vec![],
            Template::Struct(_, fields, _) => fields.iter().map(|(_, value)| value).collect(),
            Template::Call(callee, all, _) => std::iter::once(&**callee).chain(all).collect(),
            Template::Method(receiver, _, all) => std::iter::once(&**receiver).chain(all).collect(),
            Template::Tuple(all) | Template::Array(all) => all.iter().collect(),
            Template::Index(a, b) | Template::Binary(a, _, b) | Template::Choice(_, a, b) => {
                vec![a, b]
            }
            Template::Field(a, _)
            | Template::Unary(_, a)
            | Template::Cast(a, _)
            | Template::Reference(a)
            | Template::Matches(a, _)
            | Template::Part(a, ..)
            | Template::When(_, a) => vec![a],
        }
    }

    /// Returns a text that is equal for equal templates.
    pub fn key(&self) -> String {
        let list = |all: &[Template]| all.iter().map(Template::key).collect::<Vec<_>>().join(", ");
        match self {
            Template::Tokens(tokens) => tokens.to_string(),
            Template::Path(path, _) => path.to_token_stream().to_string(),
            Template::Numbers(nodes, shape, _) => format!("{nodes:?}: {shape:?}"),
            Template::State(nodes, dimension, _) => format!("state {nodes:?} {dimension}"),
            Template::Struct(path, fields, _) => {
                let fields: Vec<String> =
                    fields.iter().map(|(name, value)| format!("{name}: {}", value.key())).collect();
                format!("{} {{ {} }}", path.to_token_stream(), fields.join(", "))
            }
            Template::Part(value, pattern, name) => {
                format!("{name} of {} in ({})", pattern.to_token_stream(), value.key())
            }
            Template::Parameter(name) => format!("self.{name}"),
            Template::Call(callee, all, _) => format!("({})({})", callee.key(), list(all)),
            Template::Method(receiver, name, all) => {
                format!("({}).{name}({})", receiver.key(), list(all))
            }
            Template::Field(base, member) => {
                format!("({}).{}", base.key(), member.to_token_stream())
            }
            Template::Index(base, index) => format!("({})[{}]", base.key(), index.key()),
            Template::Binary(a, op, b) => {
                format!("({}) {} ({})", a.key(), op.to_token_stream(), b.key())
            }
            Template::Unary(op, a) => format!("{}({})", op.to_token_stream(), a.key()),
            Template::Cast(a, ty) => format!("({}) as {ty}", a.key()),
            Template::Reference(a) => format!("&({})", a.key()),
            Template::Tuple(all) => format!("({},)", list(all)),
            Template::Array(all) => format!("[{}]", list(all)),
            Template::Matches(a, pattern) => format!("({}) matches {pattern}", a.key()),
            Template::Choice(condition, a, b) => {
                format!("({}) if {condition:?} else ({})", a.key(), b.key())
            }
            Template::When(condition, a) => format!("({}) when {condition:?}", a.key()),
        }
    }
}

/// Returns true for a constant, or for a called function if `is_callee`, that belongs neither to
/// the standard library nor to a type of numbers.
fn is_own(path: &syn::ExprPath, is_callee: bool) -> bool {
    let names = crate::vocabulary::names(path);
    let (Some(first), Some(last)) = (names.first(), names.last()) else { return false };
    let of_all = matches!(first.as_str(), "std" | "core" | "alloc" | "kin")
        || matches!(
            first.as_str(),
            "f64" | "f32" | "u64" | "u32" | "u8" | "i64" | "i32" | "usize" | "isize"
        );
    let is_constant = last.len() > 1 && !last.contains(char::is_lowercase);
    let is_function = is_callee && last.starts_with(char::is_lowercase);
    !of_all && !crate::constants::is_known(path) && (is_constant || is_function)
}

#[cfg(test)]
mod tests {
    use super::Template;
    use quote::quote;

    #[test]
    fn equal_templates_have_one_key() {
        let tokens = Template::Tokens(quote!(2));
        let path = |name: syn::ExprPath| Template::path(&name);
        let call = |name: syn::ExprPath| {
            let all = vec![tokens.clone()];
            Template::Call(Box::new(path(name)), all, proc_macro2::Span::call_site())
        };
        let [f, same, g] =
            [call(syn::parse_quote!(f)), call(syn::parse_quote!(f)), call(syn::parse_quote!(g))];
        assert_eq!(f.key(), same.key());
        assert_ne!(f.key(), g.key());
        assert!(f.may_panic() && !tokens.may_panic());
        assert_eq!(f.size(), 3);
        assert_eq!(f.called()[0].0, "f");
    }
}
