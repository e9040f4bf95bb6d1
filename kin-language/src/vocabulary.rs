//! Names that both readers of the body understand, the interpreter and the rewriter: the meaning of
//! a path or a method before any type is known.

use kin_graph::{Function, Function2};
use syn::{Expr, ExprPath};

/// Returns true for a function such as `f64::sin`, but not for `f64::EPSILON`, `f64::consts::PI`,
/// or a function without a derivative.
pub fn is_number_function(path: &ExprPath) -> bool {
    let names = names(path);
    matches!(&names[..], [ty, function] if ty == "f64" && function.starts_with(char::is_lowercase) && !is_underived(function))
}

/// Returns true for one of the words of a list.
pub fn is_among(words: &str, name: &str) -> bool {
    words.split_whitespace().any(|word| word == name)
}

/// Returns true for a function of f64 that returns no number or has no derivative. Emitted code
/// calls it unchanged for numbers that do not vary.
pub fn is_underived(name: &str) -> bool {
    is_among(UNDERIVED, name)
}

const UNDERIVED: &str = "\
    from_bits from_str from_le_bytes from_be_bytes from_ne_bytes try_from to_bits \
    to_le_bytes to_be_bytes to_ne_bytes next_up next_down midpoint";

/// Returns true for a function of Kin that takes numbers of any kind.
pub fn is_kin_function(path: &ExprPath) -> bool {
    let names = names(path);
    match names.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [.., "vec2" | "vec3"] => true,
        [
            ..,
            "Vec2" | "Vec3" | "Mat2" | "Mat3" | "EulerParameters" | "Vector2" | "Vector3",
            function,
        ] => function.starts_with(char::is_lowercase),
        _ => false,
    }
}

/// Returns true for a function of the standard library that takes values of any type.
pub fn is_std_function(path: &ExprPath) -> bool {
    let names = names(path);
    matches!(
        names.iter().map(String::as_str).collect::<Vec<_>>()[..],
        ["Some" | "Ok" | "Err" | "drop"]
            | ["std" | "core" | "alloc", ..]
            | [
                "Box"
                    | "Rc"
                    | "Arc"
                    | "Vec"
                    | "VecDeque"
                    | "Option"
                    | "Result"
                    | "Cell"
                    | "RefCell"
                    | "Default"
                    | "Iterator"
                    | "String",
                _
            ]
            | ["array" | "iter" | "mem" | "cmp", _]
    )
}

/// Returns true for a path that names a struct or a variant: by convention, its last name begins
/// with a capital letter.
pub fn is_type_name(path: &ExprPath) -> bool {
    names(path).last().is_some_and(|name| name.starts_with(char::is_uppercase))
}

/// Returns true for a type of Kin that is made of numbers.
pub fn is_kin_type(path: &syn::Path) -> bool {
    let name = last_name(path);
    matches!(
        name.as_str(),
        "Vec2"
            | "Vec3"
            | "Mat2"
            | "Mat3"
            | "EulerParameters"
            | "Axis"
            | "PlanarState"
            | "SpatialState"
    )
}

pub fn is_integer(name: &str) -> bool {
    is_among("usize isize u8 i8 u16 i16 u32 i32 u64 i64 u128 i128", name)
}

/// Returns the names of a path: `f64` and `sin` for `f64::sin`.
pub fn names(path: &ExprPath) -> Vec<String> {
    path.path.segments.iter().map(|segment| segment.ident.to_string()).collect()
}

/// Returns true for a method of numbers.
pub fn is_scalar_method(name: &str) -> bool {
    Function::from_method(name).is_some()
        || Function2::from_method(name).is_some()
        || is_among(SCALAR, name)
}

/// Returns true for a function of the list that is no method of f64.
pub fn is_beyond_std(name: &str) -> bool {
    Function::from_method(name).is_some_and(|f| !f.facts().in_std)
        || Function2::from_method(name).is_some_and(|f| !f.facts().in_std)
}

/// Returns true for a method of vectors whose first argument is a vector.
pub fn is_vector_method(name: &str) -> bool {
    matches!(name, "dot" | "cross" | "component_mul" | "component_div" | "lerp")
}

/// Returns true for a method of numbers, vectors, matrices or laws, which takes numbers of Kin
/// unchanged.
pub fn is_number_method(name: &str) -> bool {
    is_scalar_method(name) || is_among(COMPONENTS, name)
}

/// Methods of numbers that are not in the list of functions.
const SCALAR: &str = "\
    log powi sin_cos recip to_radians to_degrees copysign mul_add clamp is_nan is_finite \
    is_infinite is_sign_negative is_sign_positive total_cmp partial_cmp";

const COMPONENTS: &str = "\
    norm norm_squared normalize dot cross perp component_mul component_div lerp transpose \
    determinant trace row column to_array rotation product vector conjugate at slope";

/// Returns true for a method that only reads a container or iterates over it, so that a copy in
/// other numbers gives the right result.
pub fn is_reading_method(name: &str) -> bool {
    is_among(READING, name)
}

const READING: &str = "\
    iter into_iter len is_empty first last get contains windows chunks chunks_exact to_vec \
    concat map zip enumerate rev skip take step_by chain fold copied cloned clone to_owned \
    each_ref as_slice split_at unwrap unwrap_or unwrap_or_default unwrap_or_else expect \
    map_or map_or_else and_then is_some is_none is_some_and is_none_or as_ref filter \
    filter_map flat_map any all sum product collect";

/// Returns true for a method that changes a container or an iterator in place, or whose result
/// borrows from it.
pub fn is_changing_method(name: &str) -> bool {
    is_among(CHANGING, name)
}

const CHANGING: &str = "\
    push pop insert remove extend clear swap sort_by sort_by_key sort_unstable_by reverse \
    truncate resize fill rotate_left rotate_right retain drain append iter_mut get_mut \
    first_mut last_mut next next_back nth peek by_ref as_mut take_while map_while skip_while \
    for_each set borrow borrow_mut replace";

/// Returns the expression in parentheses.
pub fn strip(expression: &Expr) -> &Expr {
    match expression {
        Expr::Paren(inner) => strip(&inner.expr),
        Expr::Group(inner) => strip(&inner.expr),
        other => other,
    }
}

/// Returns T of `Option<T>`, `Vec<T>` and other types with a type as first argument.
pub fn type_argument(path: &syn::Path) -> Option<&syn::Type> {
    match &path.segments.last()?.arguments {
        syn::PathArguments::AngleBracketed(given) => match given.args.first()? {
            syn::GenericArgument::Type(ty) => Some(ty),
            _ => None,
        },
        _ => None,
    }
}

/// Returns the last name of a path: `sin` for `f64::sin`.
pub fn last_name(path: &syn::Path) -> String {
    path.segments.last().map(|last| last.ident.to_string()).unwrap_or_default()
}
