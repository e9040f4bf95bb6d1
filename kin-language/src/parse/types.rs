//! The types of a signature, by name: the name decides the kind of the argument.

use quote::ToTokens;
use syn::{Expr, ExprLit, Lit, Type};

/// The kind of an argument, from the name of its type.
#[derive(Clone, PartialEq, Debug)]
pub enum Kind {
    Planar,
    Spatial,
    Coord,
    Coords(usize),
    /// Several planar bodies: `[Planar; N]`; and several spatial ones: `[Spatial; N]`.
    Planars(usize),
    Spatials(usize),
    Time,
    Law,
    /// An axis: its direction and two directions across it.
    Axis,
    /// A parameter made of numbers.
    Numbers(Shape),
    /// Any other parameter: `usize`, `bool`, or a type of the user's program.
    Other,
}

impl Kind {
    /// Returns the number of bodies and coordinates in the argument; parameters and the time have
    /// none.
    pub fn slots(&self) -> usize {
        match self {
            Kind::Planar | Kind::Spatial | Kind::Coord => 1,
            Kind::Coords(n) | Kind::Planars(n) | Kind::Spatials(n) => *n,
            _ => 0,
        }
    }

    /// Returns the number of columns of C_q.
    pub fn columns(&self) -> usize {
        match self {
            Kind::Planar => 3,
            Kind::Spatial => 7,
            Kind::Planars(n) => n.saturating_mul(3),
            Kind::Spatials(n) => n.saturating_mul(7),
            _ => self.slots(),
        }
    }

    /// Returns true if the constructor takes the argument and the struct stores it.
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
    /// Euler parameters, `EulerParameters`.
    Euler,
    Array(Box<Shape>, usize),
    Tuple(Vec<Shape>),
    /// Any type, `_`.
    Any,
}

impl Shape {
    /// Returns true if no part of the shape is `_`.
    fn is_known(&self) -> bool {
        match self {
            Shape::Any => false,
            Shape::Array(inner, _) => inner.is_known(),
            Shape::Tuple(all) => all.iter().all(Shape::is_known),
            _ => true,
        }
    }
}

/// Returns the kind of argument of a type in the signature, by its name.
pub fn kind(ty: &Type) -> syn::Result<Kind> {
    match shape(ty) {
        Some(shape) if shape.is_known() => return Ok(Kind::Numbers(shape)),
        Some(_) => {
            return Err(syn::Error::new_spanned(ty, "write the type of the argument"));
        }
        None => {}
    }
    match ty {
        Type::Group(inner) => kind(&inner.elem),
        Type::Paren(inner) => kind(&inner.elem),
        Type::Path(path) => named_kind(path),
        Type::Array(array) if last_name(&array.elem).as_deref() == Some("Time") => {
            Err(syn::Error::new_spanned(ty, "a constraint has only one time: write `Time`"))
        }
        Type::Array(array) if is_marker(&array.elem) => kinds(array),
        Type::Reference(reference) if is_static(reference) => Ok(Kind::Other),
        Type::Reference(reference) => Err(reference_mistake(reference)),
        Type::ImplTrait(_) => Err(syn::Error::new_spanned(
            ty,
            "write the name of a type: a parameter is a field of the constraint",
        )),
        _ => Ok(Kind::Other),
    }
}

/// Returns the kind of an array: `[Coord; N]`, `[Planar; N]`.
fn kinds(array: &syn::TypeArray) -> syn::Result<Kind> {
    let name = last_name(&array.elem).unwrap_or_default();
    let (all, each) =
        if name == "Coord" { ("coordinates", "columns") } else { ("bodies", "coordinates") };
    match (literal_length(&array.len), name.as_str()) {
        (Some(0), _) => Err(syn::Error::new_spanned(
            &array.len,
            format!("an array of length 0 holds no {all}. Give the array a length above 0"),
        )),
        (Some(n), "Planar") => Ok(Kind::Planars(n)),
        (Some(n), "Spatial") => Ok(Kind::Spatials(n)),
        (Some(n), _) => Ok(Kind::Coords(n)),
        (None, _) => {
            let length = array.len.to_token_stream().to_string();
            let cure = match syn::parse_str::<syn::Ident>(&length) {
                Ok(name) => {
                    format!(", or state the value of `{name}`, `#[constraint({name} = 6)]`")
                }
                Err(_) => String::new(),
            };
            let text = format!(
                "write the number of {all} as a literal{cure}: the macro must count {each}"
            );
            Err(syn::Error::new_spanned(
                &array.len,
                text.replace("count columns", "count the columns of C_q"),
            ))
        }
    }
}

fn named_kind(path: &syn::TypePath) -> syn::Result<Kind> {
    let Some(last) = path.path.segments.last() else { return Ok(Kind::Other) };
    let kind = match last.ident.to_string().as_str() {
        "Planar" => Kind::Planar,
        "Spatial" => Kind::Spatial,
        "Coord" | "Rate" => Kind::Coord,
        "Time" => Kind::Time,
        "Law" => return Ok(Kind::Law),
        "Axis" => return Ok(Kind::Axis),
        "f32" => {
            return Err(syn::Error::new_spanned(path, "write `f64`: Kin computes with `f64` only"));
        }
        "PlanarBody" => {
            return Err(syn::Error::new_spanned(
                path,
                "write `Planar`: inside the function the argument is the state of a planar body",
            ));
        }
        // Without the path, the name may mean a type of the user's program.
        "Link" if path.path.segments.first().is_some_and(|first| first.ident == "kin") => {
            return Err(syn::Error::new_spanned(
                path,
                "write `Planar`: inside the function the argument is the state of a planar body",
            ));
        }
        "SpatialBody" => {
            return Err(syn::Error::new_spanned(
                path,
                "write `Spatial`: inside the function the argument is the state of a spatial body",
            ));
        }
        "Coordinate" => {
            return Err(syn::Error::new_spanned(
                path,
                "write `Coord`: inside the function the argument is the value of a coordinate",
            ));
        }
        "Real" => {
            return Err(syn::Error::new_spanned(
                path,
                "write `f64`: the macro makes the function generic over dual numbers",
            ));
        }
        "Self" => {
            return Err(syn::Error::new_spanned(
                path,
                "write the name of the type instead of `Self`",
            ));
        }
        _ => return Ok(Kind::Other),
    };
    match last.arguments.is_empty() {
        true => Ok(kind),
        false => Err(syn::Error::new_spanned(
            &last.arguments,
            format!("remove the type arguments of `{}`", last.ident),
        )),
    }
}

fn reference_mistake(reference: &syn::TypeReference) -> syn::Error {
    let text = match is_marker(&reference.elem) {
        true => format!("write `{}` without `&`: the state is a value", last_name(&reference.elem).unwrap_or_default()),
        false => {
            "the constraint owns its parameters: write the type without `&` (`[f64; N]`, `Vec<f64>`, `String`), or `&'static` \
             for static data"
                .into()
        }
    };
    syn::Error::new_spanned(reference, text)
}

/// Returns true for `&'static T`.
fn is_static(reference: &syn::TypeReference) -> bool {
    let lives = reference.lifetime.as_ref().is_some_and(|lifetime| lifetime.ident == "static");
    lives && reference.mutability.is_none() && !is_marker(&reference.elem)
}

fn is_marker(ty: &Type) -> bool {
    matches!(last_name(ty).as_deref(), Some("Planar" | "Spatial" | "Coord" | "Rate" | "Time"))
}

/// Returns true for the type of the rate of a force's length or angle.
pub(super) fn is_rate(ty: &Type) -> bool {
    last_name(ty).as_deref() == Some("Rate")
}

fn last_name(ty: &Type) -> Option<String> {
    match ty {
        Type::Path(path) => path.path.segments.last().map(|s| s.ident.to_string()),
        Type::Group(inner) => last_name(&inner.elem),
        Type::Paren(inner) => last_name(&inner.elem),
        _ => None,
    }
}

/// Returns the shape of a type made of numbers, or `None` for any other type.
pub fn shape(ty: &Type) -> Option<Shape> {
    match ty {
        Type::Path(path) if path.qself.is_none() => {
            let last = path.path.segments.last()?;
            let plain = last.arguments.is_empty()
                || matches!(&last.arguments, syn::PathArguments::AngleBracketed(a) if a.args.len() == 1);
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
        Type::Array(array) => {
            Some(Shape::Array(Box::new(shape(&array.elem)?), literal_length(&array.len)?))
        }
        Type::Tuple(tuple) if !tuple.elems.is_empty() => {
            Some(Shape::Tuple(tuple.elems.iter().map(shape).collect::<Option<_>>()?))
        }
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

/// Returns true if a value of this shape is one row or more.
pub(super) fn has_rows(shape: &Shape) -> bool {
    match shape {
        Shape::Scalar | Shape::Vector(_) => true,
        Shape::Matrix(_) | Shape::Euler | Shape::Any => false,
        Shape::Array(inner, n) => *n > 0 && (**inner == Shape::Any || has_rows(inner)),
        Shape::Tuple(all) => all.iter().all(|s| *s == Shape::Any || has_rows(s)),
    }
}
