//! Signatures by the role of the function: an equation C(q, t), or under `#[force]` a force f(x, ẋ,
//! t) along a length or an angle x.

use super::{ConstraintFn, Kind, Role, Shape};

const FIRST: &str = "the first argument of a force must be the length or angle along which the force acts: `x: Coord`";
const SECOND: &str = "after `x` only the velocity of `x` may follow, `rate: Rate`. Move other coordinates into `x`, which may be any constraint of one row";
const BODY: &str = "a force depends only on `x`, the velocity of `x` and `t`. Move the bodies into `x`, which the constructor takes";
const VALUE: &str = "a force along `x` is one number: return an `f64`";

const RATE: &str = "an equation C(q, t) = 0 has no velocities: write `Coord` for a coordinate, and `#[force]` for a force that depends on a velocity";

/// Checks a signature for the role of its function. An argument that the role does not permit is an
/// error at its type.
pub fn in_role(source: ConstraintFn, role: Role) -> syn::Result<ConstraintFn> {
    if role == Role::Force {
        return force(source);
    }
    match source.arguments.iter().find(|argument| super::types::is_rate(&argument.ty)) {
        Some(argument) => Err(syn::Error::new_spanned(&argument.ty, RATE)),
        None => Ok(source),
    }
}

/// Checks the signature of a force, parsed as that of a constraint. Arguments other than x, its
/// rate, t and parameters are errors at their types.
fn force(source: ConstraintFn) -> syn::Result<ConstraintFn> {
    for (k, argument) in source.arguments.iter().enumerate() {
        let text = match (&argument.kind, k) {
            (Kind::Coord, 0) if !super::types::is_rate(&argument.ty) => continue,
            (Kind::Coord, 1) if super::types::is_rate(&argument.ty) => continue,
            (_, 0) => FIRST,
            (Kind::Coord, _) => SECOND,
            (kind, _) if kind.slots() > 0 => BODY,
            _ => continue,
        };
        return Err(syn::Error::new_spanned(&argument.ty, text));
    }
    match source.output {
        Shape::Scalar => Ok(source),
        _ => Err(syn::Error::new_spanned(&source.output_type, VALUE)),
    }
}
