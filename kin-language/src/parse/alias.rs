//! Aliases that the body declares for types, `type T = f64;`. All code except the copy of the
//! user's function uses the type itself.

use std::collections::HashMap;

use syn::visit_mut::{self, VisitMut};
use syn::{Block, ExprPath, Item, Stmt, Type};

/// Returns the body without aliases, or `None` if it declares none.
pub fn resolved(body: &Block) -> Option<Block> {
    let mut resolver = Resolver { scopes: vec![], found: false, replaced: 0, depth: 0 };
    let mut body = body.clone();
    resolver.visit_block_mut(&mut body);
    resolver.found.then_some(body)
}

/// Limits of the number of replaced names and of the depth of aliases in aliases. Rustc reports a
/// circle of aliases.
const MOST: usize = 2_000;
const DEEPEST: usize = 32;

struct Resolver {
    scopes: Vec<HashMap<String, Type>>,
    found: bool,
    replaced: usize,
    depth: usize,
}

impl Resolver {
    /// Returns the type of the first name of a path, and the number of the scope that declares it.
    fn get(&self, path: &syn::Path) -> Option<(usize, Type)> {
        let first = path
            .segments
            .first()
            .filter(|first| first.arguments.is_empty() && path.leading_colon.is_none())?;
        let name = first.ident.to_string();
        if self.replaced == MOST || self.depth == DEEPEST {
            return None;
        }
        self.scopes
            .iter()
            .enumerate()
            .rev()
            .find_map(|(k, scope)| scope.get(&name).map(|ty| (k, ty.clone())))
    }

    /// Returns the type of the first name of a path, after replacement of the aliases in it. These
    /// have their meaning in the scope of the declaration.
    fn meant(&mut self, path: &syn::Path) -> Option<Type> {
        let (scope, mut ty) = self.get(path)?;
        self.replaced += 1;
        self.depth += 1;
        let inner = self.scopes.split_off(scope + 1);
        self.visit_type_mut(&mut ty);
        self.scopes.extend(inner);
        self.depth -= 1;
        Some(ty)
    }
}

impl VisitMut for Resolver {
    fn visit_block_mut(&mut self, block: &mut Block) {
        let aliases = block.stmts.iter().filter_map(|statement| match statement {
            Stmt::Item(Item::Type(alias)) if alias.generics.params.is_empty() => {
                Some((alias.ident.to_string(), (*alias.ty).clone()))
            }
            _ => None,
        });
        let scope: HashMap<String, Type> = aliases.collect();
        self.found |= !scope.is_empty();
        self.scopes.push(scope);
        visit_mut::visit_block_mut(self, block);
        self.scopes.pop();
    }

    fn visit_item_type_mut(&mut self, _: &mut syn::ItemType) {}

    fn visit_type_mut(&mut self, ty: &mut Type) {
        if let Type::Path(path) = ty
            && path.qself.is_none()
            && path.path.segments.len() == 1
            && let Some(meant) = self.meant(&path.path)
        {
            *ty = meant;
            return;
        }
        visit_mut::visit_type_mut(self, ty);
    }

    /// Replaces the alias in `T::cos(x)`.
    fn visit_expr_path_mut(&mut self, path: &mut ExprPath) {
        if path.qself.is_none()
            && path.path.segments.len() > 1
            && let Some(Type::Path(meant)) = self.meant(&path.path)
            && meant.qself.is_none()
        {
            let mut whole = meant.path;
            whole.segments.extend(path.path.segments.iter().skip(1).cloned());
            path.path = whole;
        }
        visit_mut::visit_expr_path_mut(self, path);
    }
}

#[cfg(test)]
mod tests {
    use quote::ToTokens;
    use syn::parse_quote;

    use super::*;

    fn text(block: Block) -> Option<String> {
        resolved(&block).map(|block| {
            block
                .stmts
                .into_iter()
                .filter(|s| !matches!(s, Stmt::Item(_)))
                .map(|s| s.to_token_stream().to_string())
                .collect()
        })
    }

    #[test]
    fn names_are_replaced_where_they_are_seen() {
        assert_eq!(
            text(parse_quote!({
                let x: f64 = y;
            })),
            None
        );
        assert_eq!(
            text(parse_quote!({
                type T = f64;
                let x: [T; 2] = y;
            }))
            .unwrap(),
            "let x : [f64 ; 2] = y ;"
        );
        assert_eq!(
            text(parse_quote!({
                type U = [T; 2];
                type T = f64;
                let x: U = T::cos(y);
            }))
            .unwrap(),
            "let x : [f64 ; 2] = f64 :: cos (y) ;"
        );
        let shadowed = text(parse_quote!({
            type T = f64;
            type U = (T,);
            {
                type T = Vec2;
                let x: U = y;
            }
        }));
        assert_eq!(shadowed.unwrap(), "{ type T = Vec2 ; let x : (f64 ,) = y ; }");
        assert_eq!(
            text(parse_quote!({
                {
                    type T = f64;
                }
                let x: T = y;
            }))
            .unwrap(),
            "{ type T = f64 ; }let x : T = y ;"
        );
    }

    #[test]
    fn a_circle_of_names_ends() {
        assert!(
            text(parse_quote!({
                type T = [T; 2];
                let x: T = y;
            }))
            .is_some()
        );
        assert!(
            text(parse_quote!({
                type T = (U, U);
                type U = (T, T);
                type V = (U, T, V);
                let x: T = y;
            }))
            .is_some()
        );
    }
}
