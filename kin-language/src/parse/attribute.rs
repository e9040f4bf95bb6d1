//! The words of `#[constraint(…)]`.

use proc_macro2::TokenStream;
use syn::Ident;
use syn::parse::Parser;
use syn::punctuated::Punctuated;

use super::Choice;

/// The parsed words of the attribute.
pub struct Asked {
    pub choice: Choice,
    /// True if the user wants a warning at the token that the interpreter cannot read.
    pub warn_dual: bool,
    /// The lengths by name, as in `LEGS = 6`.
    pub lengths: Vec<(Ident, syn::LitInt)>,
    /// Functions whose text goes with the text of the constraint, as in `with = helper`.
    pub with: Vec<syn::Path>,
}

/// Reads the words. A word that occurs twice, or contradicts another one, is an error.
pub fn asked(attribute: TokenStream) -> syn::Result<Asked> {
    const WORDS: &str = "`#[constraint]` takes no argument, or `symbolic`, `dual`, `warn_dual`, or a length: `LEGS = 6`";
    let mistake = |text: &str| syn::Error::new_spanned(&attribute, text);
    let given = Punctuated::<Word, syn::Token![,]>::parse_terminated
        .parse2(attribute.clone())
        .map_err(|_| mistake(WORDS))?;
    let lengths: Vec<(Ident, syn::LitInt)> =
        given.iter().filter_map(|word| Some((word.name.clone(), word.length.clone()?))).collect();
    let with: Vec<syn::Path> = given.iter().filter_map(|word| word.with.clone()).collect();
    let is_flag = |word: &Word| word.length.is_none() && word.with.is_none();
    let words: Vec<Ident> = given.into_iter().filter(is_flag).map(|word| word.name).collect();
    let find = |text: &str| words.iter().find(|word| *word == text);
    let symbolic = find("symbolic");
    let dual = find("dual");
    let warn_dual = find("warn_dual");
    if find("lanes").is_some() {
        return Err(mistake("remove `lanes`: sweeps already compute several cases at once"));
    }
    if [symbolic, dual, warn_dual].iter().flatten().count() != words.len() {
        return Err(mistake(WORDS));
    }
    let choice = match (dual, symbolic) {
        (Some(_), Some(_)) => {
            return Err(mistake(
                "`symbolic` and `dual` exclude each other: remove `symbolic` or `dual`",
            ));
        }
        (Some(word), None) => Choice::Dual(word.span()),
        (None, Some(_)) => Choice::Symbolic,
        (None, None) => Choice::Best,
    };
    match (warn_dual, choice) {
        (Some(_), Choice::Dual(_)) => Err(mistake(
            "`warn_dual` warns of the dual numbers that `dual` requests: remove `warn_dual` or `dual`",
        )),
        (Some(_), Choice::Symbolic) => Err(mistake(
            "with `symbolic` dual numbers are an error, not a warning: remove `warn_dual`",
        )),
        _ => Ok(Asked { choice, warn_dual: warn_dual.is_some(), lengths, with }),
    }
}

/// One word of the attribute: `symbolic`, `LEGS = 6`, or `with = helper`.
struct Word {
    name: Ident,
    length: Option<syn::LitInt>,
    with: Option<syn::Path>,
}

impl syn::parse::Parse for Word {
    fn parse(input: syn::parse::ParseStream) -> syn::Result<Self> {
        let name: Ident = input.parse()?;
        let given = input.parse::<Option<syn::Token![=]>>()?.is_some();
        let mut length = None;
        let mut with = None;
        match (given, name == "with") {
            (true, true) => with = Some(input.parse()?),
            (true, false) => length = Some(input.parse()?),
            (false, _) => {}
        }
        Ok(Word { name, length, with })
    }
}
