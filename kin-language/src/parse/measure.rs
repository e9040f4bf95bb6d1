//! The attribute `#[measure(…)]`: a quantity of a joint that a user can read in addition to its
//! equations.

use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Attribute, Expr, Ident, LitStr, Token};

use crate::error::Mistakes;

/// A measure from `#[measure(name = value, "unit")]`, with the optional words `turns` (an angle
/// known up to whole turns) and `ends = (from, to)`.
pub struct Measure {
    pub name: Ident,
    pub value: Expr,
    pub unit: String,
    /// True if Kin counts whole turns from one time to the next.
    pub turns: bool,
    /// The ends of the range as functions of the parameters alone, or `None` if the range has no
    /// ends.
    pub ends: Option<(Expr, Expr)>,
}

/// Removes the measures from the list of attributes and returns them.
pub fn take(attributes: &mut Vec<Attribute>, mistakes: &mut Mistakes) -> Vec<Measure> {
    let (own, others): (Vec<Attribute>, _) =
        attributes.drain(..).partition(|attribute| attribute.path().is_ident("measure"));
    *attributes = others;
    let mut all: Vec<Measure> = Vec::new();
    for attribute in &own {
        let Some(measure) = mistakes.catch(attribute.parse_args_with(measure)) else { continue };
        if all.iter().any(|known| known.name == measure.name) {
            mistakes.add(
                &measure.name,
                format!(
                    "two measures have the name `{}`. Rename one of these measures",
                    measure.name
                ),
            );
        }
        all.push(measure);
    }
    all
}

fn measure(input: ParseStream) -> syn::Result<Measure> {
    const FORM: &str = "write the name, the value and the unit of the measure: `#[measure(slide = h_j.dot(s), \"m\")]`, then `turns` or `ends = (from, to)`";
    let form = |error: syn::Error| syn::Error::new(error.span(), FORM);
    let name = Ident::parse_any(input).map_err(form)?;
    input.parse::<Token![=]>().map_err(form)?;
    let value = input.parse()?;
    input.parse::<Token![,]>().map_err(form)?;
    let unit = input.parse::<LitStr>().map_err(form)?.value();
    let mut measure = Measure { name, value, unit, turns: false, ends: None };
    while !input.is_empty() {
        input.parse::<Token![,]>().map_err(form)?;
        if input.is_empty() {
            break;
        }
        let word: Ident = input.parse().map_err(form)?;
        if word == "turns" {
            measure.turns = true;
        } else if word == "ends" {
            input.parse::<Token![=]>().map_err(form)?;
            measure.ends = Some(ends(input).map_err(form)?);
        } else {
            return Err(syn::Error::new(word.span(), FORM));
        }
    }
    Ok(measure)
}

/// Reads `(from, to)`.
fn ends(input: ParseStream) -> syn::Result<(Expr, Expr)> {
    let pair;
    syn::parenthesized!(pair in input);
    let from = pair.parse()?;
    pair.parse::<Token![,]>()?;
    Ok((from, pair.parse()?))
}
