//! The words of `#[constraint(…)]`.

use proc_macro2::TokenStream;
use syn::Ident;
use syn::parse::Parser;
use syn::punctuated::Punctuated;

use super::Choice;

/// What the attribute asks for.
pub struct Asked {
    pub choice: Choice,
    /// Kernels over lanes, which are symbolic.
    pub lanes: bool,
    /// A warning at the token that cannot be read.
    pub warn_dual: bool,
}

/// Reads the words; each at most once, and none that contradict each other.
pub fn asked(attribute: TokenStream) -> syn::Result<Asked> {
    const WORDS: &str = "`#[constraint]` takes nothing, `symbolic`, `dual`, `lanes` or `warn_dual`";
    let mistake = |text: &str| syn::Error::new_spanned(&attribute, text);
    let words = Punctuated::<Ident, syn::Token![,]>::parse_terminated.parse2(attribute.clone()).map_err(|_| mistake(WORDS))?;
    let find = |text: &str| words.iter().find(|word| *word == text);
    let (symbolic, dual, lanes, warn_dual) = (find("symbolic"), find("dual"), find("lanes"), find("warn_dual"));
    if [symbolic, dual, lanes, warn_dual].iter().flatten().count() != words.len() {
        return Err(mistake(WORDS));
    }
    let choice = match (dual, symbolic.or(lanes)) {
        (Some(_), Some(_)) if lanes.is_some() => {
            return Err(mistake("kernels over lanes are made of the symbolic derivatives: leave `dual` or `lanes` out"));
        }
        (Some(_), Some(_)) => return Err(mistake("`symbolic` and `dual` are the two routes: leave one of them out")),
        (Some(word), None) => Choice::Dual(word.span()),
        (None, Some(_)) => Choice::Symbolic,
        (None, None) => Choice::Best,
    };
    match (warn_dual, choice) {
        (Some(_), Choice::Dual(_)) => Err(mistake("`warn_dual` warns of what `dual` asks for: leave one of them out")),
        (Some(_), Choice::Symbolic) => Err(mistake("where `symbolic` or `lanes` stands the dual route is an error: leave `warn_dual` out")),
        _ => Ok(Asked { choice, lanes: lanes.is_some(), warn_dual: warn_dual.is_some() }),
    }
}
