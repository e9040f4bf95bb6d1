//! Converts functions that are generic in their numbers to plain functions.
//!
//! A text has only one kind of number, so `Real<D>` becomes `f64` and `Vec2<D>` becomes `Vec2`.

use syn::visit_mut::{self, VisitMut};
use syn::{
    GenericArgument, GenericParam, Ident, ItemFn, Path, PathArguments, Type, TypeParamBound,
    WherePredicate,
};

/// Removes the generic number type from a function.
pub fn make(function: &mut ItemFn) {
    let generics = &mut function.sig.generics;
    let bounds = generics.where_clause.iter().flat_map(|clause| &clause.predicates);
    let bounded = bounds.filter_map(|predicate| match predicate {
        WherePredicate::Type(bound) if bound.bounds.iter().any(is_dual) => ident(&bound.bounded_ty),
        _ => None,
    });
    let own = generics.type_params().filter(|parameter| parameter.bounds.iter().any(is_dual));
    let names: Vec<String> =
        bounded.chain(own.map(|parameter| parameter.ident.to_string())).collect();
    let is_other = |parameter: &GenericParam| match parameter {
        GenericParam::Type(parameter) => !names.contains(&parameter.ident.to_string()),
        _ => true,
    };
    generics.params = std::mem::take(&mut generics.params).into_iter().filter(is_other).collect();
    if let Some(clause) = &mut generics.where_clause {
        let is_other = |predicate: &WherePredicate| match predicate {
            WherePredicate::Type(bound) => {
                !ident(&bound.bounded_ty).is_some_and(|name| names.contains(&name))
            }
            _ => true,
        };
        clause.predicates =
            std::mem::take(&mut clause.predicates).into_iter().filter(is_other).collect();
    }
    generics.where_clause.take_if(|clause| clause.predicates.is_empty());
    Plain(names).visit_item_fn_mut(function);
}

/// Removes the generic number type from every function that is declared inside this function.
pub fn make_inside(function: &mut ItemFn) {
    Inside.visit_block_mut(&mut function.block);
}

struct Inside;

impl VisitMut for Inside {
    fn visit_item_fn_mut(&mut self, function: &mut ItemFn) {
        make(function);
        visit_mut::visit_item_fn_mut(self, function);
    }
}

fn is_dual(bound: &TypeParamBound) -> bool {
    matches!(bound, TypeParamBound::Trait(bound)
        if bound.path.segments.last().is_some_and(|last| last.ident == "Dual"))
}

/// The name that a type is.
fn ident(ty: &Type) -> Option<String> {
    let Type::Path(path) = ty else { return None };
    path.path.get_ident().map(ToString::to_string)
}

/// The names of kinds of numbers.
struct Plain(Vec<String>);

impl Plain {
    fn is_kind(&self, argument: &GenericArgument) -> bool {
        matches!(argument, GenericArgument::Type(ty) if ident(ty).is_some_and(|name| self.0.contains(&name) || name == "f64"))
    }
}

impl VisitMut for Plain {
    fn visit_type_mut(&mut self, ty: &mut Type) {
        let is_real = |path: &Path| path.segments.last().is_some_and(|last| last.ident == "Real");
        match ty {
            Type::Path(path) if path.qself.is_none() && is_real(&path.path) => {
                let at = path
                    .path
                    .segments
                    .last()
                    .map_or_else(proc_macro2::Span::call_site, |last| last.ident.span());
                *ty = syn::parse_quote_spanned!(at=> f64);
            }
            other => visit_mut::visit_type_mut(self, other),
        }
    }

    fn visit_path_mut(&mut self, path: &mut Path) {
        // `Real::from(k)`
        let count = path.segments.len();
        if count == 2 && path.segments[0].ident == "Real" {
            path.segments[0] = Ident::new("f64", path.segments[0].ident.span()).into();
        }
        for segment in &mut path.segments {
            if let PathArguments::AngleBracketed(arguments) = &segment.arguments
                && !arguments.args.is_empty()
                && arguments.args.iter().all(|argument| self.is_kind(argument))
                && segment.ident != "Vec"
                && segment.ident != "Option"
            {
                segment.arguments = PathArguments::None;
            }
        }
        visit_mut::visit_path_mut(self, path);
    }
}
