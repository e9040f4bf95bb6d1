//! From f64 to `Real` in the dual copy: literals, casts, types, and patterns with numbers in them.

use proc_macro2::{Ident, Span};
use quote::ToTokens;
use syn::spanned::Spanned;
use syn::visit_mut::{self, VisitMut};
use syn::{Arm, Expr, Lit, Pat, Type, parse_quote, parse_quote_spanned};

use super::{Copy, Rewriter};
use kin_language::vocabulary::is_integer;

/// f64 → `Real<D>` in types.
pub struct Lifter<'a>(pub &'a Ident);

impl VisitMut for Lifter<'_> {
    fn visit_type_mut(&mut self, ty: &mut Type) {
        let dual = self.0;
        if let Type::Path(path) = ty
            && let Some(last) = path.path.segments.last()
            && last.arguments.is_empty()
        {
            match last.ident.to_string().as_str() {
                "f64" => return *ty = parse_quote!(::kin::emitted::Real<#dual>),
                name @ ("Vec2" | "Vec3" | "Mat2" | "Mat3" | "EulerParameters" | "Axis"
                | "PlanarState" | "SpatialState") => {
                    let name = Ident::new(name, Span::call_site());
                    return *ty = parse_quote!(::kin::emitted::#name<::kin::emitted::Real<#dual>>);
                }
                _ => {}
            }
        }
        visit_mut::visit_type_mut(self, ty);
    }

    fn visit_expr_mut(&mut self, _: &mut Expr) {}
}

/// True if numbers are in a type: lifting would change it.
pub fn holds_numbers(ty: &Type) -> bool {
    let mut lifted = ty.clone();
    Lifter(&Ident::new("__D", Span::call_site())).visit_type_mut(&mut lifted);
    lifted.to_token_stream().to_string() != ty.to_token_stream().to_string()
}

/// A name that may stand for any type.
pub fn is_unknown(ty: &Type) -> bool {
    match ty {
        Type::Path(path) => path.path.segments.last().is_some_and(|last| {
            let name = last.ident.to_string();
            last.arguments.is_empty()
                && !matches!(name.as_str(), "f64" | "bool" | "char" | "str" | "String")
                && !is_integer(&name)
        }),
        _ => false,
    }
}

/// A type that is lifted as a whole, since only numbers and types of the standard library are in
/// it.
pub fn is_liftable(ty: &Type) -> bool {
    match ty {
        Type::Array(array) => is_liftable(&array.elem),
        Type::Tuple(tuple) => tuple.elems.iter().all(is_liftable),
        Type::Paren(inner) => is_liftable(&inner.elem),
        Type::Group(inner) => is_liftable(&inner.elem),
        Type::Path(path) => path.path.segments.last().is_some_and(|last| {
            match (last.ident.to_string().as_str(), &last.arguments) {
                (
                    "f64" | "bool" | "char" | "String" | "Vec2" | "Vec3" | "Mat2" | "Mat3"
                    | "EulerParameters",
                    syn::PathArguments::None,
                ) => true,
                (name, syn::PathArguments::None) => is_integer(name),
                ("Vec" | "Option", syn::PathArguments::AngleBracketed(given)) => given
                    .args
                    .iter()
                    .all(|argument| matches!(argument, syn::GenericArgument::Type(ty) if is_liftable(ty))),
                _ => false,
            }
        }),
        _ => false,
    }
}

impl Rewriter {
    pub fn literal(&mut self, expression: &mut Expr) {
        let Expr::Lit(literal) = expression else { return };
        let is_float = match &literal.lit {
            Lit::Float(_) => true,
            Lit::Int(k) => k.suffix() == "f64",
            _ => false,
        };
        if is_float && self.copy == Copy::Dual {
            let at = Span::mixed_site().located_at(literal.span());
            let dual = &self.dual;
            *expression = parse_quote_spanned!(at=> ::kin::emitted::Real::<#dual>::from(#literal));
        }
    }

    /// `as`, which takes no `Real`. An enumeration of the user's is cast as it is.
    pub fn cast(&mut self, expression: &mut Expr) {
        let Expr::Cast(cast) = expression else { return };
        let name = cast.ty.to_token_stream().to_string();
        let foreign = self.is_foreign(&cast.expr);
        let dual = self.dual.clone();
        let ty = cast.ty.clone();
        let at = Span::mixed_site().located_at(cast.expr.span());
        match (name.as_str(), self.copy) {
            ("f64", Copy::Dual) => {
                self.visit_expr_mut(&mut cast.expr);
                let inner = &cast.expr;
                *expression = parse_quote_spanned!(at=> ::kin::emitted::cast::<#dual, _>(#inner));
            }
            (name, Copy::Dual) if is_integer(name) && !foreign => {
                self.visit_expr_mut(&mut cast.expr);
                let inner = &cast.expr;
                *expression = parse_quote_spanned!(at=> ::kin::emitted::whole::<#ty, _>(#inner));
            }
            _ if foreign => self.place(&mut cast.expr),
            _ => self.visit_expr_mut(&mut cast.expr),
        }
    }

    pub fn lift_type(&mut self, ty: &mut Type) {
        if self.copy == Copy::Dual {
            Lifter(&self.dual).visit_type_mut(ty);
        }
    }

    /// The types that are written in a pattern.
    pub fn lift_pattern(&mut self, pattern: &mut Pat) {
        if let (Pat::Type(typed), Copy::Dual) = (pattern, self.copy) {
            Lifter(&self.dual).visit_type_mut(&mut typed.ty);
        }
    }

    /// Arms whose patterns hold numbers, which `Real` does not match: a variable each, and a guard.
    pub fn lift_arms(&mut self, arms: &mut Vec<Arm>) {
        if self.copy == Copy::Plain || !arms.iter().any(|arm| holds_float(&arm.pat)) {
            return;
        }
        let apart = arms.drain(..).flat_map(|arm| match &arm.pat {
            Pat::Or(or) if holds_float(&arm.pat) => {
                or.cases.iter().map(|case| Arm { pat: case.clone(), ..arm.clone() }).collect()
            }
            _ => vec![arm],
        });
        let apart: Vec<Arm> = apart.collect();
        arms.extend(apart.into_iter().map(|mut arm| {
            let mut conditions: Vec<Expr> = Vec::new();
            take_floats(&mut arm.pat, &mut conditions);
            if let Some((_, guard)) = arm.guard.take() {
                conditions.push(*guard);
            }
            let all = conditions.into_iter().reduce(|all, one| parse_quote!(#all && (#one)));
            arm.guard = all.map(|all| (Default::default(), Box::new(all)));
            arm.comma = Some(Default::default());
            arm
        }));
    }
}

fn is_float(expression: &Expr) -> bool {
    match expression {
        Expr::Lit(literal) => matches!(literal.lit, Lit::Float(_)),
        Expr::Unary(unary) => is_float(&unary.expr),
        _ => false,
    }
}

fn holds_float(pattern: &Pat) -> bool {
    match pattern {
        Pat::Lit(literal) => matches!(literal.lit, Lit::Float(_)),
        Pat::Range(range) => {
            [&range.start, &range.end].into_iter().flatten().any(|bound| is_float(bound))
        }
        Pat::Or(or) => or.cases.iter().any(holds_float),
        Pat::Paren(inner) => holds_float(&inner.pat),
        Pat::Reference(inner) => holds_float(&inner.pat),
        Pat::Tuple(tuple) => tuple.elems.iter().any(holds_float),
        Pat::Slice(slice) => slice.elems.iter().any(holds_float),
        _ => false,
    }
}

/// Puts a variable in the place of every number, and gives what it must fulfil.
fn take_floats(pattern: &mut Pat, conditions: &mut Vec<Expr>) {
    let name = Ident::new(&format!("number{}", conditions.len()), Span::mixed_site());
    match pattern {
        Pat::Lit(literal) if matches!(literal.lit, Lit::Float(_)) => {
            conditions.push(parse_quote!(#name.value() == #literal));
            *pattern = parse_quote!(#name);
        }
        Pat::Range(range) if holds_float(&Pat::Range(range.clone())) => {
            let upper: syn::BinOp = match range.limits {
                syn::RangeLimits::Closed(_) => parse_quote!(<=),
                syn::RangeLimits::HalfOpen(_) => parse_quote!(<),
            };
            let lower = range.start.iter().map(|low| parse_quote!(#name.value() >= #low));
            let upper = range.end.iter().map(|high| parse_quote!(#name.value() #upper #high));
            let both = lower.chain(upper).reduce(|all: Expr, one: Expr| parse_quote!(#all && #one));
            conditions.push(both.unwrap_or_else(|| parse_quote!(true)));
            *pattern = parse_quote!(#name);
        }
        Pat::Paren(inner) => take_floats(&mut inner.pat, conditions),
        Pat::Reference(inner) => take_floats(&mut inner.pat, conditions),
        Pat::Tuple(tuple) => tuple.elems.iter_mut().for_each(|part| take_floats(part, conditions)),
        Pat::Slice(slice) => slice.elems.iter_mut().for_each(|part| take_floats(part, conditions)),
        _ => {}
    }
}
