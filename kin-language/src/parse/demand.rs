//! Attributes below `#[constraint]` and `#[law]`: what is demanded of the parameters, and of the pose.

use quote::ToTokens;
use syn::parse::ParseStream;
use syn::{Attribute, Expr, LitStr, Token};

use crate::error::Mistakes;
use crate::lower::tidy;

/// `#[require(condition)]`, `#[require(condition, "what to say")]`, and `#[branch(…)]` of the same form.
pub struct Demand {
    pub condition: Expr,
    /// What to say where it does not hold.
    pub text: String,
}

/// Takes the attributes called `word` out of the list.
pub fn take(attributes: &mut Vec<Attribute>, word: &str, mistakes: &mut Mistakes) -> Vec<Demand> {
    let (own, others) = attributes.drain(..).partition(|attribute| attribute.path().is_ident(word));
    *attributes = others;
    let own: Vec<Attribute> = own;
    own.iter().filter_map(|attribute| mistakes.catch(attribute.parse_args_with(demand))).collect()
}

fn demand(input: ParseStream) -> syn::Result<Demand> {
    let condition: Expr = input.parse()?;
    let _: Option<Token![,]> = input.parse()?;
    let text = match input.is_empty() {
        true => format!("`{}` does not hold", tidy(&condition.to_token_stream().to_string())),
        false => input.parse::<LitStr>()?.value(),
    };
    Ok(Demand { condition, text })
}
