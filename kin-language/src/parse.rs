//! First stage: from a Rust function to a [`ConstraintFn`], its signature read by name. `syn`'s items end here, its expressions in `lower`.

mod alias;
mod attribute;
mod demand;
mod measure;

use proc_macro2::{Ident, Span, TokenStream};
use syn::spanned::Spanned;
use syn::{Attribute, Block, Expr, ExprLit, FnArg, ItemFn, Lit, Pat, ReturnType, Type, Visibility};

use crate::error::Mistakes;
use crate::limits;
use attribute::Asked;
pub use demand::Demand;
pub use measure::Measure;

/// A function under `#[constraint]`, with its signature understood.
pub struct ConstraintFn {
    pub attributes: Vec<Attribute>,
    pub visibility: Visibility,
    pub name: Ident,
    pub arguments: Vec<Argument>,
    pub output: Shape,
    pub output_type: Type,
    /// The body, with types in the place of the names that it gives to them.
    pub body: Block,
    /// The body as it was written, if it gives names to types.
    named: Option<Block>,
    pub choice: Choice,
    /// Whether kernels over lanes are asked for.
    pub lanes: bool,
    /// Whether a warning is asked for where the body cannot be read.
    pub warn_dual: bool,
    /// What must hold of the parameters.
    pub requirements: Vec<Demand>,
    /// What holds of the pose that is meant, where the equations have others.
    pub branches: Vec<Demand>,
    /// What can be asked of it beside its equations.
    pub measures: Vec<Measure>,
}

/// What the attribute asks for.
#[derive(Clone, Copy, Debug)]
pub enum Choice {
    /// Symbolic where the body can be read, else dual.
    Best,
    /// `#[constraint(symbolic)]`
    Symbolic,
    /// `#[constraint(dual)]`, with the place of the word.
    Dual(Span),
}

/// One argument of the signature.
pub struct Argument {
    pub name: Ident,
    pub mutable: bool,
    pub kind: Kind,
    pub ty: Type,
}

/// What an argument is, by the name of its type.
#[derive(Clone, PartialEq, Debug)]
pub enum Kind {
    Planar,
    Spatial,
    Coord,
    Coords(usize),
    Time,
    Law,
    /// An axis: its direction and two others across it.
    Axis,
    /// A parameter made of numbers.
    Numbers(Shape),
    /// Any other parameter: `usize`, `bool`, a type of the user's.
    Other,
}

impl Kind {
    /// How many of the constraint's arguments it is (bodies and coordinates; not parameters, not time).
    pub fn slots(&self) -> usize {
        match self {
            Kind::Planar | Kind::Spatial | Kind::Coord => 1,
            Kind::Coords(n) => *n,
            _ => 0,
        }
    }

    /// Number of columns of C_q.
    pub fn columns(&self) -> usize {
        match self {
            Kind::Planar => 3,
            Kind::Spatial => 7,
            _ => self.slots(),
        }
    }

    /// Whether the constructor takes it and the struct holds it.
    pub fn is_field(&self) -> bool {
        *self != Kind::Time
    }
}

/// A type made of numbers.
#[derive(Clone, PartialEq, Debug, Default)]
pub enum Shape {
    #[default]
    Scalar,
    Vector(usize),
    Matrix(usize),
    /// `EulerParameters`
    Euler,
    Array(Box<Shape>, usize),
    Tuple(Vec<Shape>),
    /// `_`: whatever the value is.
    Any,
}

impl Shape {
    /// Whether no part of it is `_`.
    fn is_known(&self) -> bool {
        match self {
            Shape::Any => false,
            Shape::Array(inner, _) => inner.is_known(),
            Shape::Tuple(all) => all.iter().all(Shape::is_known),
            _ => true,
        }
    }
}

/// Reads the attribute and the signature; every mistake at its own token.
pub fn constraint(attribute: TokenStream, item: TokenStream) -> syn::Result<ConstraintFn> {
    let Asked { choice, lanes, warn_dual } = attribute::asked(attribute)?;
    let mut function = item_fn(item)?;
    let mut mistakes = Mistakes::default();
    refuse_qualifiers(&function, &mut mistakes);
    let requirements = demand::take(&mut function.attrs, "require", &mut mistakes);
    let branches = demand::take(&mut function.attrs, "branch", &mut mistakes);
    let measures = measure::take(&mut function.attrs, &mut mistakes);
    let arguments: Vec<Argument> = function.sig.inputs.iter().filter_map(|input| mistakes.catch(argument(input))).collect();
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
        lanes,
        warn_dual,
        requirements,
        branches,
        measures,
    })
}

impl ConstraintFn {
    /// The body as it was written.
    pub fn written(&self) -> &Block {
        self.named.as_ref().unwrap_or(&self.body)
    }
}

impl LawFn {
    /// The body as it was written.
    pub fn written(&self) -> &Block {
        self.named.as_ref().unwrap_or(&self.body)
    }
}

/// The body that the compiler reads, and the written one where they differ.
fn bodies(written: Block) -> (Block, Option<Block>) {
    match alias::resolved(&written) {
        Some(body) => (body, Some(written)),
        None => (written, None),
    }
}

/// A function under `#[law]`.
pub struct LawFn {
    pub attributes: Vec<Attribute>,
    pub visibility: Visibility,
    pub name: Ident,
    pub variable: Ident,
    pub parameters: Vec<Argument>,
    /// As in a [`ConstraintFn`].
    pub body: Block,
    named: Option<Block>,
    /// What must hold of the parameters.
    pub requirements: Vec<Demand>,
}

/// Reads a function of one variable: its first argument.
pub fn law(attribute: &TokenStream, item: TokenStream) -> syn::Result<LawFn> {
    if !attribute.is_empty() {
        return Err(syn::Error::new_spanned(attribute, "`#[law]` takes nothing"));
    }
    let mut function = item_fn(item)?;
    let mut mistakes = Mistakes::default();
    refuse_qualifiers(&function, &mut mistakes);
    let requirements = demand::take(&mut function.attrs, "require", &mut mistakes);
    let mut arguments: Vec<Argument> = function.sig.inputs.iter().filter_map(|input| mistakes.catch(argument(input))).collect();
    for argument in &arguments {
        if argument.kind.slots() > 0 || argument.kind == Kind::Time {
            mistakes.add(&argument.ty, "a law is a function of numbers: its first argument is the variable, an `f64`");
        }
    }
    if !matches!(&function.sig.output, ReturnType::Type(_, ty) if shape(ty) == Some(Shape::Scalar)) {
        mistakes.add(&function.sig.ident, "a law returns its value, an `f64`");
    }
    match arguments.first() {
        Some(first) if first.kind == Kind::Numbers(Shape::Scalar) => {}
        Some(first) if first.kind.slots() > 0 || first.kind == Kind::Time => {}
        Some(first) => mistakes.add(&first.ty, "the first argument of a law is its variable, an `f64`"),
        None if mistakes.is_empty() => mistakes.add(&function.sig.ident, "a law needs its variable as first argument, an `f64`"),
        None => {}
    }
    mistakes.catch(limits::arguments(&arguments));
    mistakes.finish()?;
    let variable = arguments.remove(0).name;
    let (body, named) = bodies(*function.block);
    Ok(LawFn {
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

const NO_COORDINATES: &str = "a constraint needs something to constrain: give it an argument of type `Planar`, `Spatial`, `Coord` or \
     `[Coord; N]` (types are read by name: write the name itself, not an alias of it)";

pub fn item_fn(item: TokenStream) -> syn::Result<ItemFn> {
    let span = item.clone().into_iter().next().map_or_else(Span::call_site, |token| token.span());
    syn::parse2(item).map_err(|error| match error.to_string().contains("expected `fn`") {
        true => syn::Error::new(span, "this attribute goes on a function"),
        false => error,
    })
}

/// What a function under `#[constraint]` or `#[law]` cannot be.
pub fn refuse_qualifiers(function: &ItemFn, mistakes: &mut Mistakes) {
    let sig = &function.sig;
    if let Some(word) = &sig.asyncness {
        mistakes.add(word, "an equation has nothing to wait for: remove `async`");
    }
    if let Some(word) = &sig.unsafety {
        mistakes.add(word, "remove `unsafe`: the function only computes a value");
    }
    if let Some(word) = &sig.constness {
        mistakes.add(word, "remove `const`: the function becomes a constructor of its own");
    }
    if let Some(word) = &sig.abi {
        mistakes.add(word, "remove `extern`: the function becomes a constructor of its own");
    }
    if !sig.generics.params.is_empty() {
        mistakes.add(&sig.generics, "no generics here: the macro makes the function generic itself; write the types out");
    }
    if let Some(clause) = &sig.generics.where_clause {
        mistakes.add(clause, "no `where` here: the macro makes the function generic itself");
    }
    if let Some(dots) = &sig.variadic {
        mistakes.add(dots, "no variadic arguments: use an array");
    }
}

fn argument(input: &FnArg) -> syn::Result<Argument> {
    let typed = match input {
        FnArg::Receiver(receiver) => {
            return Err(syn::Error::new_spanned(receiver, "no `self` here: a constraint is a free function of its bodies and parameters"));
        }
        FnArg::Typed(typed) => typed,
    };
    let Pat::Ident(pattern) = &*typed.pat else {
        return Err(syn::Error::new_spanned(&typed.pat, "give the argument a plain name: it becomes a field of the constraint"));
    };
    if let Some(word) = &pattern.by_ref {
        return Err(syn::Error::new_spanned(word, "arguments are values: remove `ref`"));
    }
    if pattern.ident.to_string().starts_with("__") {
        return Err(syn::Error::new_spanned(&pattern.ident, "names that begin with `__` are kept for the emitted code"));
    }
    let kind = kind(&typed.ty)?;
    Ok(Argument { name: pattern.ident.clone(), mutable: pattern.mutability.is_some(), kind, ty: (*typed.ty).clone() })
}

/// What a type in the signature means, by its name.
pub fn kind(ty: &Type) -> syn::Result<Kind> {
    match shape(ty) {
        Some(shape) if shape.is_known() => return Ok(Kind::Numbers(shape)),
        Some(_) => return Err(syn::Error::new_spanned(ty, "write the type: it says what the argument is")),
        None => {}
    }
    match ty {
        Type::Path(path) => named_kind(path),
        Type::Array(array) if last_name(&array.elem).as_deref() == Some("Coord") => match literal_length(&array.len) {
            Some(0) => Err(syn::Error::new_spanned(&array.len, "an array of no coordinates constrains nothing")),
            Some(n) => Ok(Kind::Coords(n)),
            None => Err(syn::Error::new_spanned(
                &array.len,
                "write the number of coordinates as a literal: the columns of C_q are counted here",
            )),
        },
        Type::Array(array) if is_marker(&array.elem) => Err(syn::Error::new_spanned(ty, "only `Coord` comes in arrays: name each body")),
        Type::Reference(reference) => Err(reference_mistake(reference)),
        Type::ImplTrait(_) => Err(syn::Error::new_spanned(ty, "write the type itself: a parameter is a field of the constraint")),
        _ => Ok(Kind::Other),
    }
}

fn named_kind(path: &syn::TypePath) -> syn::Result<Kind> {
    let Some(last) = path.path.segments.last() else { return Ok(Kind::Other) };
    let kind = match last.ident.to_string().as_str() {
        "Planar" => Kind::Planar,
        "Spatial" => Kind::Spatial,
        "Coord" => Kind::Coord,
        "Time" => Kind::Time,
        "Law" => return Ok(Kind::Law),
        "Axis" => return Ok(Kind::Axis),
        "f32" => return Err(syn::Error::new_spanned(path, "numbers are `f64`")),
        "PlanarBody" | "Link" => {
            return Err(syn::Error::new_spanned(path, "inside the function a planar body is its state: write `Planar`"));
        }
        "SpatialBody" => return Err(syn::Error::new_spanned(path, "inside the function a spatial body is its state: write `Spatial`")),
        "Coordinate" => return Err(syn::Error::new_spanned(path, "inside the function a coordinate is its value: write `Coord`")),
        "Real" => return Err(syn::Error::new_spanned(path, "write `f64`: the macro makes the function generic over dual numbers itself")),
        "Self" => return Err(syn::Error::new_spanned(path, "there is no `Self` here: write the type itself")),
        _ => return Ok(Kind::Other),
    };
    match last.arguments.is_empty() {
        true => Ok(kind),
        false => Err(syn::Error::new_spanned(&last.arguments, format!("`{}` takes no type arguments here", last.ident))),
    }
}

fn reference_mistake(reference: &syn::TypeReference) -> syn::Error {
    let text = match is_marker(&reference.elem) {
        true => format!("write `{}`: the state is a value, there is nothing to borrow", last_name(&reference.elem).unwrap_or_default()),
        false => {
            "a parameter is a field of the constraint, so it is owned: write the type without `&` (`[f64; N]`, `Vec<f64>`, `String`)".into()
        }
    };
    syn::Error::new_spanned(reference, text)
}

fn is_marker(ty: &Type) -> bool {
    matches!(last_name(ty).as_deref(), Some("Planar" | "Spatial" | "Coord" | "Time"))
}

fn last_name(ty: &Type) -> Option<String> {
    match ty {
        Type::Path(path) => path.path.segments.last().map(|s| s.ident.to_string()),
        _ => None,
    }
}

/// A type made of numbers; `None` if it is anything else.
pub fn shape(ty: &Type) -> Option<Shape> {
    match ty {
        Type::Path(path) if path.qself.is_none() => {
            let last = path.path.segments.last()?;
            let plain = last.arguments.is_empty() || matches!(&last.arguments, syn::PathArguments::AngleBracketed(a) if a.args.len() == 1);
            match last.ident.to_string().as_str() {
                "f64" => Some(Shape::Scalar),
                "Vec2" if plain => Some(Shape::Vector(2)),
                "Vec3" if plain => Some(Shape::Vector(3)),
                "Mat2" if plain => Some(Shape::Matrix(2)),
                "Mat3" if plain => Some(Shape::Matrix(3)),
                "EulerParameters" if plain => Some(Shape::Euler),
                _ => None,
            }
        }
        Type::Array(array) => Some(Shape::Array(Box::new(shape(&array.elem)?), literal_length(&array.len)?)),
        Type::Tuple(tuple) if !tuple.elems.is_empty() => Some(Shape::Tuple(tuple.elems.iter().map(shape).collect::<Option<_>>()?)),
        Type::Infer(_) => Some(Shape::Any),
        Type::Paren(inner) => shape(&inner.elem),
        Type::Group(inner) => shape(&inner.elem),
        _ => None,
    }
}

pub fn literal_length(length: &Expr) -> Option<usize> {
    match length {
        Expr::Lit(ExprLit { lit: Lit::Int(n), .. }) => n.base10_parse().ok(),
        _ => None,
    }
}

fn output(function: &ItemFn) -> syn::Result<(Shape, Type)> {
    const WHAT: &str = "the value of the equation: `f64`, `Vec2`, `Vec3`, `[f64; N]` or a tuple of these";
    let ty = match &function.sig.output {
        ReturnType::Default => {
            return Err(syn::Error::new(
                function.sig.ident.span(),
                format!("`{}` returns nothing; it must return {WHAT}", function.sig.ident),
            ));
        }
        ReturnType::Type(_, ty) => ty,
    };
    match shape(ty) {
        Some(shape) if has_rows(&shape) => limits::rows(&shape, ty).map(|()| (shape, (**ty).clone())),
        Some(Shape::Array(..)) => Err(syn::Error::new(ty.span(), "this has no rows")),
        _ => Err(syn::Error::new_spanned(ty, format!("a constraint returns {WHAT}; lengths are written as numbers"))),
    }
}

fn has_rows(shape: &Shape) -> bool {
    match shape {
        Shape::Scalar | Shape::Vector(_) => true,
        Shape::Matrix(_) | Shape::Euler | Shape::Any => false,
        Shape::Array(inner, n) => *n > 0 && (**inner == Shape::Any || has_rows(inner)),
        Shape::Tuple(all) => all.iter().all(|s| *s == Shape::Any || has_rows(s)),
    }
}
