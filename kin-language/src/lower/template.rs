//! Expressions that only rustc understands: emitted code repeats them as the user wrote them, with
//! values of the graph put in.

use std::rc::Rc;

use proc_macro2::{Ident, Span, TokenStream};
use quote::ToTokens;

use crate::parse::Shape;
use kin_graph::Node;

/// An expression that emitted code repeats.
#[derive(Clone)]
pub enum Template {
    /// As written.
    Tokens(TokenStream),
    /// A path that is no variable: a constant, or the name of a function. Of a word in small
    /// letters, which may be a slip of the pen, the variables around it too: rustc then says the
    /// same of it in every copy of the body, and once.
    Path(syn::ExprPath, Rc<[Ident]>),
    /// Values of the graph, with the place they come from.
    Numbers(Vec<Node>, Shape, Span),
    /// A field of the constraint: a parameter whose type only rustc knows.
    Parameter(Ident),
    /// With the place of its parentheses.
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
    /// A value of a struct or a variant: its path, its fields, and whether they stand in braces.
    Struct(syn::Path, Vec<(String, Template)>, bool),
    /// The state of a body, with its numbers: of a planar one R, θ, sin θ, cos θ, of a spatial one
    /// R, p, A.
    State(Vec<Node>, usize, Span),
    /// The part that a pattern calls by a name in the value, where that matches.
    Part(Box<Template>, Box<syn::Pat>, Ident),
    /// Does the value match the pattern?
    Matches(Box<Template>, TokenStream),
    /// One of two, by a condition; what they are is decided by their place.
    Choice(Node, Box<Template>, Box<Template>),
    /// The value, where a condition holds; elsewhere it is not computed.
    When(Node, Box<Template>),
}

impl Template {
    /// A path by itself.
    pub fn path(path: &syn::ExprPath) -> Self {
        Template::Path(path.clone(), Rc::from([]))
    }

    /// The values of the graph in it, in order.
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

    /// Where it begins, if that is known.
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

    /// The functions that it calls, as they are written, with their places.
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

    /// The constants and the functions by path that it reads of the program's own, as they are
    /// written, with their places.
    pub fn named(&self) -> Vec<(String, Span)> {
        let mut found = Vec::new();
        let mut callee = None;
        self.visit(&mut |template| {
            // A callee is visited right behind its call.
            let is_callee = callee.take() == Some(std::ptr::from_ref(template));
            match template {
                Template::Call(called, ..) => callee = Some(std::ptr::from_ref(&**called)),
                Template::Path(path, _) if is_own(path, is_callee) => {
                    let span = path.to_token_stream().into_iter().next().map(|token| token.span());
                    let name = crate::error::tidy(&path.to_token_stream().to_string());
                    found.extend(span.map(|span| (name, span)));
                }
                _ => {}
            }
        });
        found
    }

    /// Of how many templates it is made.
    pub fn size(&self) -> usize {
        1 + self.parts().into_iter().map(Template::size).sum::<usize>()
    }

    /// True if computing it may panic: an index out of range, a division of integers, the user's
    /// own functions.
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

    /// The parts in it that are values only where a pattern matches, those inside of others first.
    pub fn matched_parts(&self) -> Vec<&Template> {
        let mut found: Vec<&Template> =
            self.parts().into_iter().flat_map(Template::matched_parts).collect();
        if let Template::Part(..) = self {
            found.push(self);
        }
        found
    }

    /// True if it holds a choice that its place has not yet decided on.
    pub fn has_choice(&self) -> bool {
        let mut found = false;
        self.visit(&mut |template| found |= matches!(template, Template::Choice(..)));
        found
    }

    /// `f` of the template, or of either side of a choice.
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

    /// Text that is equal for equal templates.
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

/// True for a constant or, as what is called, a function that is neither of the standard library
/// nor of a number's type.
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
