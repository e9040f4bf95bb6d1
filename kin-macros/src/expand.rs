//! The driver: the stages as a chain, and what happens when one of them finds a mistake.

use proc_macro2::TokenStream;
use quote::quote;

use kin_language::lower::{Failure, Unreadable};
use kin_language::parse::{Choice, ConstraintFn, Role, SecondReader};
use kin_language::{limits, lower, parse};

use crate::emit;
use crate::emit::DualReason;

/// `#[constraint]`
pub fn constraint(attribute: TokenStream, item: TokenStream) -> TokenStream {
    compiled(attribute, item, Role::Equation)
}

/// A constraint, an energy or a force, which are compiled like one.
fn compiled(attribute: TokenStream, item: TokenStream, role: Role) -> TokenStream {
    let parsed = limits::check(&item).and_then(|()| parse::constraint(attribute, item.clone()));
    let parsed = parsed.and_then(|mut source| {
        source.role = role;
        parse::in_role(source, role)
    });
    let source = match parsed {
        Ok(source) => source,
        Err(mistakes) if role == Role::Force => {
            return with_stand_in(&mistakes, &emit::stand_in::force_item(item));
        }
        Err(mistakes) => return with_stand_in(&mistakes, &emit::stand_in::constraint_item(item)),
    };
    match (source.choice, lower::constraint(&source)) {
        (_, Err(Failure::Mistakes(mistakes))) => {
            with_stand_in(&mistakes, &emit::stand_in::constraint(&source))
        }
        (Choice::Dual(asked), _) => emit::constraint::dual(&source, &DualReason::Asked(asked)),
        (Choice::Best, Err(Failure::Unreadable(why))) => {
            emit::constraint::dual(&source, &DualReason::Unread(&why))
        }
        (Choice::Symbolic, Err(Failure::Unreadable(why))) => {
            with_stand_in(&refusal(&why, &source), &emit::stand_in::constraint(&source))
        }
        (_, Ok(lowered)) => emit::constraint::symbolic(&source, lowered),
    }
}

/// `#[helper]`
pub fn helper(attribute: TokenStream, item: TokenStream) -> TokenStream {
    let parsed = limits::check(&item)
        .and_then(|()| parse::helper(attribute))
        .and_then(|with| Ok((with, syn::parse2(item.clone())?)));
    match parsed {
        Ok((with, function)) => emit::alone::helper(&with, &function, &item),
        Err(mistakes) => with_stand_in(&mistakes, &item),
    }
}

/// `#[potential]`: a constraint whose row is an energy.
pub fn potential(attribute: TokenStream, item: TokenStream) -> TokenStream {
    let name = syn::parse2::<syn::ItemFn>(item.clone()).ok().map(|function| function.sig.ident);
    let marked = name.map(|name| quote!(impl ::kin::loads::Potential for #name {}));
    let emitted = compiled(attribute, item, Role::Energy);
    quote!(#emitted #marked)
}

/// `#[force]`: a function of a length or an angle, its rate and time, compiled like a constraint on
/// them.
pub fn force(attribute: TokenStream, item: TokenStream) -> TokenStream {
    compiled(attribute, item, Role::Force)
}

/// `#[law]`
pub fn law(attribute: &TokenStream, item: TokenStream) -> TokenStream {
    let parsed = limits::check(&item).and_then(|()| parse::law(attribute, item.clone()));
    let source = match parsed {
        Ok(source) => source,
        Err(mistakes) => return with_stand_in(&mistakes, &emit::stand_in::law_item(item)),
    };
    match lower::law(&source.variable, &source.parameters, &source.body, SecondReader::Rustc) {
        Err(Failure::Mistakes(mistakes)) => with_stand_in(&mistakes, &emit::stand_in::law(&source)),
        Err(Failure::Unreadable(_)) => emit::law::law(&source, None),
        Ok(lowered) => emit::law::law(&source, Some(lowered)),
    }
}

/// Something that type-checks, so that no further message follows from the first, and the messages:
/// behind it, for an editor that completes a word looks for the place of the word before in the
/// expansion with the word.
fn with_stand_in(mistakes: &syn::Error, stand_in: &TokenStream) -> TokenStream {
    let messages = mistakes.to_compile_error();
    quote!(#stand_in #messages)
}

/// `#[constraint(symbolic)]` on a body that cannot be read.
fn refusal(why: &Unreadable, source: &ConstraintFn) -> syn::Error {
    let name = &source.name;
    let what = &why.what;
    let text = format!(
        "`#[constraint(symbolic)]` needs a formula of `{name}`, but Kin cannot read {what}. Rewrite this expression, or remove `symbolic` to use dual numbers"
    );
    syn::Error::new(why.span, text)
}
