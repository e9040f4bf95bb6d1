//! Calls in the plain copy of functions that may take their arguments as they are, and of methods
//! of states by their paths.

use quote::{ToTokens, quote};
use syn::spanned::Spanned;
use syn::visit_mut::VisitMut;
use syn::{Expr, Lit, parse_quote_spanned};

use super::Rewriter;
use super::foreign::{is_function_name, mixed};
use crate::emit::probe::{How, Probed};

impl Rewriter {
    /// `Planar::point` of the state, which the marker stands for in the signature.
    pub fn state_type(&self, path: &mut syn::ExprPath) {
        let first = path
            .path
            .segments
            .first()
            .filter(|_| path.path.segments.len() > 1 && path.qself.is_none());
        let (rest, state) = match first.map(|first| first.ident.to_string()).as_deref() {
            Some("Planar") => (path.path.segments.iter().skip(1), quote!(PlanarState)),
            Some("Spatial") => (path.path.segments.iter().skip(1), quote!(SpatialState)),
            _ => return,
        };
        let at = path.span();
        *path = parse_quote_spanned!(at=> ::kin::emitted::#state::#(#rest)::*);
    }

    /// True if all arguments of a call have types of their own, whatever the function asks for.
    pub fn probes(&self, call: &syn::ExprCall) -> bool {
        let bindable = |argument: &Expr| match argument {
            Expr::Closure(_)
            | Expr::Tuple(_)
            | Expr::Array(_)
            | Expr::Repeat(_)
            | Expr::Macro(_)
            | Expr::Struct(_) => false,
            Expr::Lit(literal) => matches!(literal.lit, Lit::Float(_)),
            Expr::Path(path) => {
                self.variable(path)
                    .is_some_and(|variable| variable.inputs.is_none() && !variable.own)
                    || !is_function_name(path)
            }
            Expr::Reference(reference) => {
                reference.mutability.is_none()
                    && !self.nature(argument).foreign
                    && !matches!(*reference.expr, Expr::Closure(_))
            }
            Expr::Unary(unary) => {
                !matches!(*unary.expr, Expr::Lit(_))
                    || matches!(&*unary.expr, Expr::Lit(l) if matches!(l.lit, Lit::Float(_)))
            }
            _ => true,
        };
        (1..=6).contains(&call.args.len()) && call.args.iter().all(bindable)
    }

    /// A call in the plain copy of a function that may take its arguments as they are.
    pub fn probed_call(&mut self, expression: &mut Expr) {
        let Expr::Call(call) = expression else { return };
        let mut arguments = Vec::new();
        for argument in &mut call.args {
            let at = mixed(argument);
            let how = match argument {
                Expr::Reference(reference) => {
                    self.visit_expr_mut(&mut reference.expr);
                    let inner = &reference.expr;
                    arguments.push(Probed { value: quote!(&#inner), how: How::Borrowed, at });
                    continue;
                }
                _ => How::Plain,
            };
            let foreign = self.is_foreign(argument);
            match argument {
                Expr::Path(_) | Expr::Field(_) | Expr::Index(_) if foreign => self.place(argument),
                _ => self.visit_expr_mut(argument),
            }
            arguments.push(Probed { value: argument.to_token_stream(), how, at });
        }
        let parentheses = call.paren_token.span.join();
        let tokens = crate::emit::probe::call(&call.func.to_token_stream(), arguments, parentheses);
        *expression = Expr::Verbatim(tokens);
    }
}
