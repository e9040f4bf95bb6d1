//! Replaces the constants of the standard library by numbers, since only rustc knows them by their
//! names.

use std::f64::consts;

use proc_macro2::{Literal, Span};
use quote::ToTokens;
use syn::spanned::Spanned;
use syn::visit_mut::{self, VisitMut};
use syn::{Expr, ExprPath, Item, ItemFn};

const KNOWN: [(&str, f64); 26] = [
    ("PI", consts::PI),
    ("TAU", consts::TAU),
    ("E", consts::E),
    ("SQRT_2", consts::SQRT_2),
    ("FRAC_1_SQRT_2", consts::FRAC_1_SQRT_2),
    ("LN_2", consts::LN_2),
    ("LN_10", consts::LN_10),
    ("LOG2_E", consts::LOG2_E),
    ("LOG10_E", consts::LOG10_E),
    ("LOG2_10", consts::LOG2_10),
    ("LOG10_2", consts::LOG10_2),
    ("FRAC_PI_2", consts::FRAC_PI_2),
    ("FRAC_PI_3", consts::FRAC_PI_3),
    ("FRAC_PI_4", consts::FRAC_PI_4),
    ("FRAC_PI_6", consts::FRAC_PI_6),
    ("FRAC_PI_8", consts::FRAC_PI_8),
    ("FRAC_1_PI", consts::FRAC_1_PI),
    ("FRAC_2_PI", consts::FRAC_2_PI),
    ("FRAC_2_SQRT_PI", consts::FRAC_2_SQRT_PI),
    ("EPSILON", f64::EPSILON),
    ("MAX", f64::MAX),
    ("MIN", f64::MIN),
    ("MIN_POSITIVE", f64::MIN_POSITIVE),
    ("INFINITY", f64::INFINITY),
    ("NEG_INFINITY", f64::NEG_INFINITY),
    ("NAN", f64::NAN),
];

/// Replaces constants in a function and its attributes. `own` are the items around the function:
/// their names have precedence.
pub fn put(function: &mut ItemFn, own: &[Item]) {
    let declared = own.iter().filter_map(|item| match item {
        Item::Const(constant) => Some(constant.ident.to_string()),
        _ => None,
    });
    let mut put = Put(declared.collect());
    put.visit_block_mut(&mut function.block);
}

/// Replaces constants in an expression of an attribute.
pub fn put_into(expression: &Expr) -> Expr {
    let mut expression = expression.clone();
    Put(vec![]).visit_expr_mut(&mut expression);
    expression
}

/// The visitor that replaces constants; the field holds the names that have another meaning here.
struct Put(Vec<String>);

impl VisitMut for Put {
    fn visit_expr_mut(&mut self, expression: &mut Expr) {
        match value(expression, &self.0) {
            Some(number) => *expression = literal(number, expression.span()),
            None => visit_mut::visit_expr_mut(self, expression),
        }
    }
}

/// Returns true if a text can use the path: `f64::consts::PI`, `f64::EPSILON`.
pub fn is_known(path: &ExprPath) -> bool {
    value(&Expr::Path(path.clone()), &[]).is_some()
}

/// Returns the number of `PI`, `f64::EPSILON` or `std::f64::consts::TAU`.
fn value(expression: &Expr, own: &[String]) -> Option<f64> {
    let Expr::Path(path) = expression else { return None };
    let text = path.to_token_stream().to_string().replace(' ', "");
    let (around, name) = text.rsplit_once("::").unwrap_or(("", &text));
    let around =
        around.trim_start_matches("::").trim_start_matches("std::").trim_start_matches("core::");
    let known = match around {
        "" => !own.iter().any(|own| own == name) && !matches!(name, "E" | "MAX" | "MIN" | "NAN"),
        "consts" | "f64::consts" | "f64" => true,
        _ => false,
    };
    KNOWN.iter().find(|(known_name, _)| known && *known_name == name).map(|(_, value)| *value)
}

fn literal(number: f64, at: Span) -> Expr {
    if !number.is_finite() {
        let top = if number.is_nan() { 0.0 } else { 1.0_f64.copysign(number) };
        let top = literal(top, at);
        return syn::parse_quote_spanned!(at=> (#top / 0.0));
    }
    let mut size = Literal::f64_unsuffixed(number.abs());
    size.set_span(at);
    match number < 0.0 {
        true => syn::parse_quote_spanned!(at=> (-#size)),
        false => syn::parse_quote_spanned!(at=> #size),
    }
}
