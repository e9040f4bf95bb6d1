//! The text of an equation, which goes into mechanism files with what stands beside it.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use syn::visit::{self, Visit};
use syn::{
    Attribute, Expr, ExprLit, ExprPath, ItemConst, ItemFn, Lit, Meta, MetaNameValue as NameValue,
    Path,
};

use kin_language::error::tidy;
use kin_language::lower::Lowered;
use kin_language::lower::alone::Beside;
use kin_language::parse::{ConstraintFn, LawFn, Role};

/// The statements of `describe` that put the text of a function that was read.
pub fn describe_text(source: &ConstraintFn, lowered: &Lowered) -> TokenStream {
    let Beside { constants, functions, unknown } = Beside::of(source, lowered);
    let last = |path: &Path| path.segments.last().map(|last| last.ident.to_string());
    let is_with = |name: &String| {
        source.with.iter().any(|path| last(path).is_some_and(|last| name.ends_with(&last)))
    };
    let lacking = functions.into_iter().filter(|name| !is_with(name));
    let lacking = lacking
        .map(|name| format!("`{name}` (`#[helper]` before it and `#[constraint(with = {name})]`)"));
    let lacking = unknown.into_iter().chain(lacking);
    let lengths = source.given.iter().map(|(name, length)| format!("{name} = {length}"));
    let lengths: Vec<String> = lengths.collect();
    let word = if source.role == Role::Force { "force" } else { "constraint" };
    let mark = match (lengths.as_slice(), source.role) {
        ([], Role::Force) => "#[force]\n".to_string(),
        ([], _) => String::new(),
        (lengths, _) => format!("#[{word}({})]\n", lengths.join(", ")),
    };
    let text = mark + &text(&source.item);
    let constants = put_constants(&constants);
    let with = &source.with;
    quote! {
        to.put_text(::core::module_path!(), #text);
        #constants
        #(#with::put(to);)*
        #(to.lacks(#lacking);)*
    }
}

/// `text` of a law that speaks of nothing beside it but constants.
pub fn law_text(source: &LawFn, lowered: &Lowered) -> Option<TokenStream> {
    let Beside { constants, functions, unknown } = Beside::of_law(source, lowered);
    let text = (functions.is_empty() && unknown.is_empty()).then(|| text(&source.item))?;
    let constants = put_constants(&constants);
    Some(quote! {
        #[cold]
        fn text(&self) -> ::core::option::Option<&str> {
            use ::kin::emitted::{OutgoingConstant as _, RefusedConstant as _};
            static TEXT: ::std::sync::OnceLock<::core::option::Option<::std::string::String>> = ::std::sync::OnceLock::new();
            let made = || {
                let mut all = <::kin::emitted::Describer as ::core::default::Default>::default();
                let to = &mut all;
                to.put_equation(#text);
                #constants
                all.equation()
            };
            TEXT.get_or_init(made).as_deref()
        }
    })
}

/// The same of a function that only rustc has read.
pub fn unread() -> TokenStream {
    quote! {
        to.put_text(::core::module_path!(), "");
        to.lacks("a body on the dual route, which only rustc can read");
    }
}

fn put_constants(constants: &[Ident]) -> TokenStream {
    let names = constants.iter().map(Ident::to_string);
    quote! {
        #((&::kin::emitted::Outgoing(&#constants)).constant(#names, to);)*
    }
}

/// `#[helper]`: the function, and beside it what puts its text.
pub fn helper(with: &[Path], function: &ItemFn, item: &TokenStream) -> TokenStream {
    let name = &function.sig.ident;
    let visibility = &function.vis;
    let text = text(item);
    let mut found = Constants::default();
    found.visit_item_fn(function);
    found.used.retain(|name| !found.own.contains(name));
    let constants = put_constants(&found.used);
    let unlinted = super::unlinted();
    quote! {
        #item
        #[doc(hidden)]
        #[allow(non_camel_case_types)]
        #unlinted
        #visibility struct #name {}
        #unlinted
        impl #name {
            #[doc(hidden)]
            pub fn put(to: &mut ::kin::emitted::Describer) {
                use ::kin::emitted::{OutgoingConstant as _, RefusedConstant as _};
                #constants
                #(#with::put(to);)*
                to.put_beside(#text);
            }
        }
    }
}

/// Names in capitals that a function takes from beside it.
#[derive(Default)]
struct Constants {
    used: Vec<Ident>,
    own: Vec<Ident>,
}

impl<'a> Visit<'a> for Constants {
    fn visit_expr_path(&mut self, path: &'a ExprPath) {
        let capital = |c: char| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_';
        if let Some(name) =
            path.path.get_ident().filter(|name| name.to_string().chars().all(capital))
            && !self.used.contains(name)
        {
            self.used.push(name.clone());
        }
        visit::visit_expr_path(self, path);
    }

    fn visit_item_const(&mut self, item: &'a ItemConst) {
        self.own.push(item.ident.clone());
        visit::visit_item_const(self, item);
    }

    fn visit_const_param(&mut self, parameter: &'a syn::ConstParam) {
        self.own.push(parameter.ident.clone());
    }

    fn visit_expr(&mut self, expression: &'a Expr) {
        visit::visit_expr(self, expression);
    }
}

/// A function as text: its documentation in its own lines, its body as it was written where that is
/// known.
fn text(item: &TokenStream) -> String {
    let Ok(function) = syn::parse2::<ItemFn>(item.clone()) else { return item.to_string() };
    let attributes: String = function.attrs.iter().map(attribute).collect();
    let visibility = &function.vis;
    let signature = &function.sig;
    let head = tidy(&quote!(#visibility #signature).to_string().replace('\n', " "))
        .replace(" : ", ": ")
        .replace(" :[", ": [");
    let head = head.replace(" < ", "<").replace(" >", ">");
    format!("{attributes}{head} {}", body(item))
}

fn attribute(attribute: &Attribute) -> String {
    match &attribute.meta {
        Meta::NameValue(NameValue {
            value: Expr::Lit(ExprLit { lit: Lit::Str(line), .. }),
            path,
            ..
        }) if path.is_ident("doc") && !line.value().contains('\n') => {
            format!("///{}\n", line.value())
        }
        _ => format!("{}\n", attribute.to_token_stream()),
    }
}

fn body(item: &TokenStream) -> String {
    let Some(body) = item.clone().into_iter().last() else { return String::new() };
    let tokens = body.to_token_stream().to_string();
    let bare = |text: &str| text.chars().filter(|c| !c.is_whitespace()).collect::<String>();
    let same = |text: &String| {
        text.parse::<TokenStream>().is_ok_and(|read| bare(&read.to_string()) == bare(&tokens))
    };
    body.span().source_text().filter(same).unwrap_or(tokens)
}
