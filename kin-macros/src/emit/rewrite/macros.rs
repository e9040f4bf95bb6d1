//! The standard library's macros inside the body: their arguments are expressions like any other.

use quote::{ToTokens, quote};
use syn::parse::{ParseStream, Parser};
use syn::punctuated::Punctuated;
use syn::{Expr, Macro, Pat, Token};

use super::Rewriter;

/// The shape of a macro's arguments.
enum Arguments {
    /// `vec![x; n]`
    Repeat(Expr, Expr),
    List(Vec<Expr>),
    /// `matches!(value, pattern if guard)`
    Pattern(Expr, Box<Pat>, Option<Expr>),
}

fn arguments(call: &Macro) -> Option<Arguments> {
    let name = call.path.segments.last()?.ident.to_string();
    let list = |input: ParseStream| {
        Punctuated::<Expr, Token![,]>::parse_terminated(input)
            .map(|all| all.into_iter().collect::<Vec<_>>())
    };
    let tokens = call.tokens.clone();
    match name.as_str() {
        "matches" => pattern.parse2(tokens).ok(),
        "vec" => repeat
            .parse2(tokens.clone())
            .ok()
            .or_else(|| list.parse2(tokens).ok().map(Arguments::List)),
        "assert" | "assert_eq" | "assert_ne" | "debug_assert" | "debug_assert_eq"
        | "debug_assert_ne" | "dbg" => list.parse2(tokens).ok().map(Arguments::List),
        _ => None,
    }
}

fn repeat(input: ParseStream) -> syn::Result<Arguments> {
    let value = input.parse()?;
    input.parse::<Token![;]>()?;
    Ok(Arguments::Repeat(value, input.parse()?))
}

fn pattern(input: ParseStream) -> syn::Result<Arguments> {
    let value = input.parse()?;
    input.parse::<Token![,]>()?;
    let pattern = Pat::parse_multi_with_leading_vert(input)?;
    let guard = input.parse::<Option<Token![if]>>()?.map(|_| input.parse()).transpose()?;
    input.parse::<Option<Token![,]>>()?;
    Ok(Arguments::Pattern(value, Box::new(pattern), guard))
}

/// The elements of a `vec![…]`.
pub fn elements(call: &Macro) -> Option<Vec<Expr>> {
    let is_vec = call.path.segments.last().is_some_and(|last| last.ident == "vec");
    match arguments(call).filter(|_| is_vec)? {
        Arguments::Repeat(value, _) => Some(vec![value]),
        Arguments::List(all) => Some(all),
        Arguments::Pattern(..) => None,
    }
}

impl Rewriter {
    pub fn macro_call(&mut self, call: &mut Macro) {
        use syn::visit_mut::VisitMut;
        call.tokens = match arguments(call) {
            None => return,
            Some(Arguments::Repeat(mut value, mut length)) => {
                self.visit_expr_mut(&mut value);
                self.visit_expr_mut(&mut length);
                quote!(#value; #length)
            }
            Some(Arguments::List(mut all)) => {
                all.iter_mut().for_each(|part| self.visit_expr_mut(part));
                quote!(#(#all),*)
            }
            Some(Arguments::Pattern(mut value, pattern, guard)) => {
                let nature = self.nature(&value);
                self.visit_expr_mut(&mut value);
                self.scopes.push();
                self.declare(&pattern, nature);
                let guard = guard.map(|mut guard| {
                    self.visit_expr_mut(&mut guard);
                    quote!(if #guard)
                });
                self.scopes.pop();
                let value = value.to_token_stream();
                let pattern = pattern.to_token_stream();
                quote!(#value, #pattern #guard)
            }
        };
    }
}
