//! Evaluates the formulas of the list of functions with any numbers: f64, dual numbers, series, the
//! nodes of a graph.

use crate::{Comparison, Condition, Function, Function2, Number};

macro_rules! of_one {
    ($(
        $(#[$doc:meta])* $variant:ident $method:ident $written:literal
        { value: $value:expr; $(definition: |$x:ident| $definition:expr;)? slope: |$u:tt, $y:tt| $slope:expr;
          facts: $facts:expr; }
    )*) => {
        /// Returns dy/du of y = f(u).
        ///
        /// At a kink the derivative is that of the documented side: `abs` at 0 has the slope +1.
        /// The steps (`floor`, `signum`, …) have the derivative 0 everywhere.
        pub fn slope<N: Number>(f: Function, u: N, y: N) -> N {
            match f { $(Function::$variant => { let ($u, $y) = (u, y); $slope })* }
        }

        /// Returns f(x) from other functions of the list, or `None` if every library has f.
        pub fn definition<N: Number>(f: Function, x: N) -> Option<N> {
            match f {
                $($(Function::$variant => { let $x = x; Some($definition) })?)*
                _ => None,
            }
        }
    };
}

macro_rules! of_two {
    ($(
        $(#[$doc:meta])* $variant:ident $method:ident $written:literal
        { value: $value:expr; $(definition: |$x:ident, $y:ident| $definition:expr;)?
          slopes: |$u:tt, $v:tt, $z:tt| $slopes:expr; facts: $facts:expr; }
    )*) => {
        /// Returns (∂z/∂u, ∂z/∂v) of z = f(u, v).
        pub fn slopes<N: Number>(f: Function2, u: N, v: N, z: N) -> (N, N) {
            match f { $(Function2::$variant => { let ($u, $v, $z) = (u, v, z); $slopes })* }
        }

        /// Returns f(x, y) from other functions of the list, or `None` if every type of number has
        /// f.
        pub fn definition_of_two<N: Number>(f: Function2, x: N, y: N) -> Option<N> {
            match f {
                $($(Function2::$variant => { let ($x, $y) = (x, y); Some($definition) })?)*
                _ => None,
            }
        }
    };
}

crate::functions_of_one!(of_one);
crate::functions_of_two!(of_two);

fn number<N: Number>(x: f64) -> N {
    N::constant(x)
}

/// ln x of a constant.
fn logarithm<N: Number>(x: f64) -> N {
    N::logarithm_of(x)
}

fn inverse<N: Number>(u: N) -> N {
    number::<N>(1.0) / u
}

fn one_minus<N: Number>(u: N) -> N {
    number::<N>(1.0) - u
}

fn root<N: Number>(u: N) -> N {
    u.call(Function::Sqrt)
}

/// 1 if u ≥ 0, else −1.
fn side<N: Number>(u: N) -> N {
    let is_positive = N::compare(Comparison::GreaterEqual, &u, &number(0.0));
    N::select(&is_positive, number(1.0), number(-1.0))
}

/// v u^(v − 1)
fn lower_power<N: Number>(u: &N, v: &N) -> N {
    let lower = v.clone() - number(1.0);
    v.clone() * u.clone().call2(Function2::Powf, lower)
}

/// z ln u, which goes to 0 with z = u^v.
fn logarithm_times<N: Number>(u: N, z: N) -> N {
    let logarithm = u.call(Function::Ln);
    let is_some = N::compare(Comparison::NotEqual, &z, &number(0.0));
    N::select(&is_some, z * logarithm, number(0.0))
}

/// The condition under which `max` or `min` takes the first of two: it is not beyond the other, or
/// that is not a number.
fn first_of<N: Number>(wins: Comparison, u: N, v: N) -> N::Condition {
    N::compare(wins, &u, &v).or(N::compare(Comparison::NotEqual, &v, &v))
}

/// (1, 0) if the first is taken, else (0, 1).
fn choice<N: Number>(first: N::Condition) -> (N, N) {
    (N::select(&first, number(1.0), number(0.0)), N::select(&first, number(0.0), number(1.0)))
}
