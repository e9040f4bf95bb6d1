//! First stage: makes a [`ConstraintFn`] from a Rust function, and reads the signature by name.
//! Only this stage sees `syn`'s items; `lower` sees its expressions.

mod alias;
mod attribute;
mod demand;
mod length;
mod measure;
mod role;
mod types;

use proc_macro2::{Ident, Span, TokenStream};
use syn::spanned::Spanned;
use syn::{Attribute, Block, FnArg, ItemFn, Pat, ReturnType, Type, Visibility};

use crate::error::Mistakes;
use crate::limits;
use attribute::Asked;
pub use demand::Demand;
pub use measure::Measure;
pub use role::in_role;
use types::has_rows;
pub use types::{Kind, Shape, kind, literal_length, shape};

/// A function under `#[constraint]` with its parsed signature.
pub struct ConstraintFn {
    pub attributes: Vec<Attribute>,
    pub visibility: Visibility,
    pub name: Ident,
    pub arguments: Vec<Argument>,
    pub output: Shape,
    pub output_type: Type,
    /// The body. Types replace the aliases that the body declares for them.
    pub body: Block,
    /// The body as the user wrote it, if it declares aliases; else `None`.
    named: Option<Block>,
    pub choice: Choice,
    /// True if the user wants a warning where the interpreter cannot read the body.
    pub warn_dual: bool,
    /// The lengths that the attribute gives for constants outside the function.
    pub lengths: Vec<(Ident, syn::LitInt)>,
    /// All lengths that the attribute gives, including those of const generics.
    pub given: Vec<(Ident, syn::LitInt)>,
    /// The conditions of `#[require]` on the parameters.
    pub requirements: Vec<Demand>,
    /// The conditions of `#[branch]`, which select the intended pose where the equations have
    /// several solutions.
    pub branches: Vec<Demand>,
    /// The measures of the constraint beside its equations.
    pub measures: Vec<Measure>,
    /// The meaning of the function's value: an equation, an energy or a force.
    pub role: Role,
    pub second_reader: SecondReader,
    /// The tokens of the function as the macro received them.
    pub item: TokenStream,
    /// Functions outside this one whose text goes with its text.
    pub with: Vec<syn::Path>,
}

/// The second reader of the body, which reports the mistakes that any program may have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SecondReader {
    /// Rustc: the body is a part of a program.
    #[default]
    Rustc,
    /// No second reader: the body is a text.
    Nobody,
}

/// The meaning of a function's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// An equation C(q, t) = 0.
    Equation,
    /// An energy, from which Kin derives generalised forces (`#[potential]`).
    Energy,
    /// A force along a length or an angle x, a function of x, ẋ and t (`#[force]`).
    Force,
}

/// The route that the attribute selects.
#[derive(Clone, Copy, Debug)]
pub enum Choice {
    /// The symbolic route if the interpreter can read the body, else the dual route.
    Best,
    /// The symbolic route, from `#[constraint(symbolic)]`.
    Symbolic,
    /// The dual route, from `#[constraint(dual)]`, with the span of the word.
    Dual(Span),
}

/// One argument of the signature.
pub struct Argument {
    pub name: Ident,
    pub mutable: bool,
    pub kind: Kind,
    pub ty: Type,
}

/// Returns the functions in `#[helper(with = other)]`.
pub fn helper(attribute: TokenStream) -> syn::Result<Vec<syn::Path>> {
    const WORDS: &str =
        "write `#[helper]`, or `#[helper(with = other)]` with the functions that the helper calls";
    let asked = attribute::asked(attribute.clone());
    asked
        .ok()
        .filter(|asked| attribute.is_empty() || !asked.with.is_empty() && asked.lengths.is_empty())
        .map(|asked| asked.with)
        .ok_or_else(|| syn::Error::new_spanned(&attribute, WORDS))
}

/// Reads the attribute and the signature, and reports every mistake at its token.
pub fn constraint(attribute: TokenStream, item: TokenStream) -> syn::Result<ConstraintFn> {
    let Asked { choice, warn_dual, lengths: given, with } = attribute::asked(attribute)?;
    let mut function = item_fn(item.clone())?;
    let mut mistakes = Mistakes::default();
    let lengths = length::put(&mut function, &given, &mut mistakes);
    refuse_qualifiers(&function, &mut mistakes);
    let requirements = demand::take(&mut function.attrs, "require", &mut mistakes);
    let branches = demand::take(&mut function.attrs, "branch", &mut mistakes);
    let measures = measure::take(&mut function.attrs, &mut mistakes);
    let arguments: Vec<Argument> =
        function.sig.inputs.iter().filter_map(|input| mistakes.catch(argument(input))).collect();
    if mistakes.is_empty() && !arguments.iter().any(|a| a.kind.slots() > 0) {
        mistakes.add(&function.sig.ident, NO_COORDINATES);
    }
    mistakes.catch(limits::arguments(&arguments));
    let output = mistakes.catch(output(&function));
    let Some((output, output_type)) = output else { return Err(mistakes.into_error()) };
    mistakes.finish()?;
    let (body, named) = bodies(*function.block);
    Ok(ConstraintFn {
        attributes: function.attrs,
        visibility: function.vis,
        name: function.sig.ident,
        arguments,
        output,
        output_type,
        body,
        named,
        choice,
        warn_dual,
        lengths,
        given,
        requirements,
        branches,
        measures,
        role: Role::Equation,
        second_reader: SecondReader::Rustc,
        item,
        with,
    })
}

impl ConstraintFn {
    /// Returns the body as the user wrote it.
    pub fn written(&self) -> &Block {
        self.named.as_ref().unwrap_or(&self.body)
    }
}

impl LawFn {
    /// Returns the body as the user wrote it.
    pub fn written(&self) -> &Block {
        self.named.as_ref().unwrap_or(&self.body)
    }
}

/// Returns the body without aliases, and the written one if it differs.
fn bodies(written: Block) -> (Block, Option<Block>) {
    match alias::resolved(&written) {
        Some(body) => (body, Some(written)),
        None => (written, None),
    }
}

/// A function under `#[law]`.
pub struct LawFn {
    /// The tokens of the function as the user wrote it.
    pub item: TokenStream,
    pub attributes: Vec<Attribute>,
    pub visibility: Visibility,
    pub name: Ident,
    pub variable: Ident,
    pub parameters: Vec<Argument>,
    /// The body without aliases, as in a [`ConstraintFn`].
    pub body: Block,
    named: Option<Block>,
    /// The conditions of `#[require]` on the parameters.
    pub requirements: Vec<Demand>,
}

/// Reads a function of one variable, its first argument.
pub fn law(attribute: &TokenStream, item: TokenStream) -> syn::Result<LawFn> {
    if !attribute.is_empty() {
        return Err(syn::Error::new_spanned(attribute, "`#[law]` takes no argument"));
    }
    let mut function = item_fn(item.clone())?;
    let mut mistakes = Mistakes::default();
    refuse_qualifiers(&function, &mut mistakes);
    let requirements = demand::take(&mut function.attrs, "require", &mut mistakes);
    let mut arguments: Vec<Argument> =
        function.sig.inputs.iter().filter_map(|input| mistakes.catch(argument(input))).collect();
    for argument in &arguments {
        if argument.kind.slots() > 0 || argument.kind == Kind::Time {
            mistakes.add(
                &argument.ty,
                "a law is a function of numbers: the first argument must be the variable, an `f64`",
            );
        }
    }
    if !matches!(&function.sig.output, ReturnType::Type(_, ty) if shape(ty) == Some(Shape::Scalar))
    {
        mistakes.add(&function.sig.ident, "a law must return a number, an `f64`");
    }
    match arguments.first() {
        Some(first) if first.kind == Kind::Numbers(Shape::Scalar) => {}
        Some(first) if first.kind.slots() > 0 || first.kind == Kind::Time => {}
        Some(first) => {
            mistakes.add(&first.ty, "the first argument of a law must be the variable, an `f64`")
        }
        None if mistakes.is_empty() => mistakes
            .add(&function.sig.ident, "a law needs the variable, an `f64`, as the first argument"),
        None => {}
    }
    mistakes.catch(limits::arguments(&arguments));
    mistakes.finish()?;
    let variable = arguments.remove(0).name;
    let (body, named) = bodies(*function.block);
    Ok(LawFn {
        item,
        attributes: function.attrs,
        visibility: function.vis,
        name: function.sig.ident,
        variable,
        parameters: arguments,
        body,
        named,
        requirements,
    })
}

const NO_COORDINATES: &str = "a constraint needs an argument of type `Planar`, `Spatial`, `Coord` or `[Coord; N]`. Write the name of the type, not an alias";

pub fn item_fn(item: TokenStream) -> syn::Result<ItemFn> {
    let span = item.clone().into_iter().next().map_or_else(Span::call_site, |token| token.span());
    syn::parse2(item).map_err(|error| match error.to_string().contains("expected `fn`") {
        true => syn::Error::new(span, "write this attribute above a function"),
        false => error,
    })
}

/// Returns the text of a function's doc comment.
pub fn description(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter(|attribute| attribute.path().is_ident("doc"));
    let lines = lines.filter_map(|attribute| match &attribute.meta {
        syn::Meta::NameValue(syn::MetaNameValue {
            value: syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }),
            ..
        }) => Some(text.value().trim().to_owned()),
        _ => None,
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Refuses functions under `#[constraint]` or `#[law]` with qualifiers or generics.
pub fn refuse_qualifiers(function: &ItemFn, mistakes: &mut Mistakes) {
    let sig = &function.sig;
    if let Some(word) = &sig.asyncness {
        mistakes.add(word, "an equation cannot be `async`: remove `async`");
    }
    if let Some(word) = &sig.unsafety {
        mistakes.add(word, "remove `unsafe`: the function only computes a value");
    }
    if let Some(word) = &sig.constness {
        mistakes.add(word, "remove `const`: the macro makes a constructor of the function");
    }
    if let Some(word) = &sig.abi {
        mistakes.add(word, "remove `extern`: the macro makes a constructor of the function");
    }
    if !sig.generics.params.is_empty() {
        mistakes.add(
            &sig.generics,
            "remove the generics and write the types: the macro makes the function generic",
        );
    }
    if let Some(clause) = &sig.generics.where_clause {
        mistakes.add(clause, "remove `where`: the macro makes the function generic");
    }
    if let Some(dots) = &sig.variadic {
        mistakes.add(dots, "write an array instead of variadic arguments");
    }
}

fn argument(input: &FnArg) -> syn::Result<Argument> {
    let typed = match input {
        FnArg::Receiver(receiver) => {
            return Err(syn::Error::new_spanned(
                receiver,
                "remove `self`: a constraint is a free function of bodies and parameters",
            ));
        }
        FnArg::Typed(typed) => typed,
    };
    let Pat::Ident(pattern) = &*typed.pat else {
        return Err(syn::Error::new_spanned(
            &typed.pat,
            "give the argument a plain name: the argument becomes a field of the constraint",
        ));
    };
    if let Some(word) = &pattern.by_ref {
        return Err(syn::Error::new_spanned(word, "remove `ref`: arguments are values"));
    }
    if pattern.ident.to_string().starts_with("__") {
        return Err(syn::Error::new_spanned(
            &pattern.ident,
            "names that begin with `__` are reserved for generated code",
        ));
    }
    let kind = kind(&typed.ty)?;
    Ok(Argument {
        name: pattern.ident.clone(),
        mutable: pattern.mutability.is_some(),
        kind,
        ty: (*typed.ty).clone(),
    })
}

fn output(function: &ItemFn) -> syn::Result<(Shape, Type)> {
    const WHAT: &str =
        "the value of the equation: `f64`, `Vec2`, `Vec3`, `[f64; N]` or a tuple of these";
    let ty = match &function.sig.output {
        ReturnType::Default => {
            return Err(syn::Error::new(
                function.sig.ident.span(),
                format!("`{}` returns no value: return {WHAT}", function.sig.ident),
            ));
        }
        ReturnType::Type(_, ty) => ty,
    };
    match shape(ty) {
        Some(shape) if has_rows(&shape) => {
            limits::rows(&shape, ty).map(|()| (shape, (**ty).clone()))
        }
        Some(Shape::Array(..)) => {
            Err(syn::Error::new(ty.span(), "an array of length zero has no rows"))
        }
        _ => Err(syn::Error::new_spanned(
            ty,
            format!("a constraint returns {WHAT}. Write lengths as numbers"),
        )),
    }
}
