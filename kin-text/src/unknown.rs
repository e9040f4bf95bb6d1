//! Finds names that a program can define but a text does not define.

use kin_graph::{Function, Function2};
use kin_language::error::Mistakes;
use kin_language::lower::Template;
use kin_language::lower::{Failure, Lowered};
use proc_macro2::{Ident, Span};
use quote::ToTokens;
use syn::{Error, Item};

const BESIDE: &str =
    "write the function or constant that the equation uses into the text, beside the equation";

/// Returns the lowered function if the text defines all names in it.
///
/// Errors: each name that only a program can define, at its place.
pub fn understood(read: Result<Lowered, Failure>) -> syn::Result<Lowered> {
    let lowered = read.map_err(|failure| match failure {
        Failure::Mistakes(mistakes) => mistakes,
        Failure::Unreadable(why) => {
            Error::new(why.span, format!("Kin cannot read {} in a text", why.what))
        }
    })?;
    let mut mistakes = Mistakes::default();
    for value in lowered.opaques.iter().chain(&lowered.leaves) {
        mistakes.push(unknown(&value.template, &lowered.items));
    }
    mistakes.finish().map(|()| lowered)
}

/// The mistake that an expression is of which nothing is known.
fn unknown(template: &Template, items: &[Item]) -> Error {
    let at = template.place().unwrap_or_else(Span::call_site);
    let message = match path(template) {
        Some((name, around)) => match items.iter().find_map(|item| type_of(item, &name)) {
            Some(ty) => {
                format!(
                    "`{name}` is a constant of type `{ty}`: write a number in place of `{name}`"
                )
            }
            None => match method(template, &name) {
                Some(call) => format!("`{name}` is a method of a number here: write `{call}`"),
                None => {
                    format!("Kin does not know `{name}` in this text: {}", meant(&name, around))
                }
            },
        },
        None => format!("Kin does not know this expression: {BESIDE}"),
    };
    Error::new(at, message)
}

/// The name that an expression is or calls, and the variables around it.
fn path(template: &Template) -> Option<(String, &[Ident])> {
    match template {
        Template::Path(path, around) => {
            Some((kin_language::error::tidy(&path.to_token_stream().to_string()), around))
        }
        Template::Call(callee, ..) => path(callee),
        Template::Field(inner, ..) => path(inner),
        _ => None,
    }
}

/// The call of a method that a call of a function such as `sin(x)` means.
fn method(template: &Template, name: &str) -> Option<String> {
    let (callee, count, within) = called(template)?;
    let is_power = name == "pow";
    let is_known =
        is_power || Function::from_method(name).is_some() || Function2::from_method(name).is_some();
    let texts = arguments(&within.source_text().unwrap_or_default());
    // Names in the place of arguments whose text is not at hand.
    let texts = match texts.len() == count {
        true => texts,
        false => ["x", "y"].iter().take(count).map(|name| name.to_string()).collect(),
    };
    let is_function = is_known && matches!(callee, Template::Path(..));
    let (first, rest) = texts.split_first().filter(|_| is_function)?;
    let is_whole = rest.first().is_some_and(|text| text.parse::<i32>().is_ok());
    let name = match (is_power, is_whole) {
        (true, true) => "powi",
        (true, false) => "powf",
        _ => name,
    };
    let is_one = first.chars().all(|c| c.is_alphanumeric() || "_.".contains(c));
    let first = if is_one { first.clone() } else { format!("({first})") };
    Some(format!("{first}.{name}({})", rest.join(", ")))
}

/// The function of the innermost call, the number of its arguments, and their parentheses.
fn called(template: &Template) -> Option<(&Template, usize, Span)> {
    match template {
        Template::Call(callee, arguments, within) => Some((callee, arguments.len(), *within)),
        Template::Field(inner, ..) | Template::Method(inner, ..) => called(inner),
        _ => None,
    }
}

/// The arguments in the text of parentheses, such as "(x, 2.0)".
fn arguments(text: &str) -> Vec<String> {
    let Some(inside) = text.strip_prefix('(').and_then(|text| text.strip_suffix(')')) else {
        return Vec::new();
    };
    let mut depth = 0;
    let mut all = vec![String::new()];
    for c in inside.chars() {
        depth += i32::from("([{".contains(c)) - i32::from(")]}".contains(c));
        match all.last_mut() {
            Some(last) if c != ',' || depth > 0 => last.push(c),
            _ => all.push(String::new()),
        }
    }
    all.iter().map(|one| one.trim().to_string()).filter(|one| !one.is_empty()).collect()
}

/// The type of the constant of that name.
fn type_of(item: &Item, name: &str) -> Option<String> {
    match item {
        Item::Const(constant) if constant.ident == name => {
            Some(kin_language::error::tidy(&constant.ty.to_token_stream().to_string()))
        }
        _ => None,
    }
}

/// The cure of a name that is not known: a variable that is called nearly so, or the name's own
/// text.
fn meant(name: &str, around: &[Ident]) -> String {
    let apart = |other: &Ident| strsim::damerau_levenshtein(name, &other.to_string());
    match around
        .iter()
        .min_by_key(|other| apart(other))
        .filter(|other| apart(other) <= name.len() / 3)
    {
        Some(other) => format!("write `{other}` if you mean this name"),
        None => BESIDE.to_string(),
    }
}
