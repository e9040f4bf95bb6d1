//! Attributes below `#[constraint]` and `#[law]` with conditions on the parameters and on the pose.

use quote::ToTokens;
use syn::parse::ParseStream;
use syn::{Attribute, Expr, LitStr, Token};

use crate::error::Mistakes;
use crate::error::tidy;

/// A condition from `#[require(condition)]`, `#[require(condition, "what to say")]`, or
/// `#[branch(…)]` of the same form.
pub struct Demand {
    pub condition: Expr,
    /// The message if the condition does not hold.
    pub text: String,
}

/// Removes the attributes with the name `word` from the list and returns them.
pub fn take(attributes: &mut Vec<Attribute>, word: &str, mistakes: &mut Mistakes) -> Vec<Demand> {
    let (own, others) = attributes.drain(..).partition(|attribute| attribute.path().is_ident(word));
    *attributes = others;
    let own: Vec<Attribute> = own;
    own.iter()
        .filter_map(|attribute| {
            mistakes.catch(attribute.parse_args_with(|input: ParseStream| demand(input, word)))
        })
        .collect()
}

fn demand(input: ParseStream, word: &str) -> syn::Result<Demand> {
    let form = |error: syn::Error| {
        syn::Error::new(
            error.span(),
            format!("write a condition, and a text if you want one: {}", form_of(word)),
        )
    };
    let condition: Expr = input.parse().map_err(form)?;
    let _: Option<Token![,]> = input.parse()?;
    let text = match input.is_empty() {
        true => format!("`{}` does not hold", tidy(&condition.to_token_stream().to_string())),
        false => input.parse::<LitStr>().map_err(form)?.value(),
    };
    Ok(Demand { condition, text })
}

fn form_of(word: &str) -> &'static str {
    match word {
        "branch" => "`#[branch(h_i.dot(h_j) > 0.0, \"its axes are opposite\")]`",
        _ => "`#[require(length > 0.0, \"a rod has a length\")]`",
    }
}
