//! The constraint compiler of Kin: `#[constraint]` turns one Rust function C(q, t) into residual,
//! Jacobian and right sides; `#[law]` turns a function of one variable into a law with its
//! derivatives.
//!
//! The stages in the order of the data: `parse` → `lower` (over `graph`) → `differentiate` →
//! `emit`.
#![forbid(unsafe_code)]

mod emit;
mod expand;
#[cfg(test)]
mod tests;

use proc_macro::TokenStream;

/// Keeps the text of a function, so that Kin can write the constraints that call it into mechanism
/// files that need no program.
///
/// `#[constraint(with = parabola)]` writes the text of `parabola` together with the text of the
/// constraint. `#[helper(with = other)]` marks a function that calls another helper.
///
/// ```text
/// #[helper]
/// fn parabola<D: Dual>(x: Real<D>, k: f64) -> Real<D> {
///     k * x * x
/// }
///
/// #[constraint(with = parabola)]
/// fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
///     let s = j.local(i.point(u_i));
///     s.y - parabola(s.x, k)
/// }
/// ```
#[proc_macro_attribute]
pub fn helper(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::helper(attribute.into(), item.into()).into()
}

/// Turns a function C(q, t) into a constraint with all its derivatives.
///
/// ```text
/// /// Pin in a parabolic slot: P of body i stays on y = k x², the slot being fixed in body j.  [m]
/// #[constraint]
/// pub fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
///     let s = j.local(i.point(u_i));
///     s.y - k * s.x * s.x
/// }
/// ```
///
/// The function becomes a constructor, `parabolic_slot(crank, table, vec2(0.1, 0.0), 2.0)`. The
/// constructor returns a struct of the same name that implements `Constraint`: it computes C, C_q
/// at a fixed pattern, C_t, and r(q̇, ṫ) = −\[(C_q q̇)_q q̇ + 2 ṫ C_qt q̇ + ṫ² C_tt\].
///
/// # Arguments
///
/// The macro reads types by name. An alias of a type is an error.
///
/// | type | in the function | the constructor takes |
/// |---|---|---|
/// | `Planar` | state of a planar body: `r`, `theta`, `a()`, `point(u)`, `direction(h)`, `local(p)` | anything `Into<PlanarBody>` |
/// | `Spatial` | state of a spatial body: `r`, `p`, `a()`, `point(u)`, `direction(h)`, `local(p)` | anything `Into<SpatialBody>` |
/// | `Coord`, `[Coord; N]` | bare coordinates, as numbers | anything `Into<Coordinate>`, `[Coordinate; N]` |
/// | `[Planar; N]`, `[Spatial; N]` | states of several bodies | arrays of bodies |
/// | `Time` | t   \[s\] | nothing |
/// | `Law` | a function of one variable: `law.at(x)`, its derivative `law.slope(x)` | a `Law` |
/// | `Axis` | unit vectors `h` along an axis of a spatial body, `f` and `g` across it | anything `Into<Axis>`: a `Vec3` |
/// | any other `Clone + Send + Sync` type | a parameter | the value |
///
/// # Result
///
/// The function returns `f64`, `Vec2`, `Vec3`, `[f64; N]` or a tuple of these. Each number is a
/// row. The identifiers in a returned tuple or array give the names of the rows. The rows of a
/// vector have the names x, y, z, and all other rows have numbers from 1.
///
/// # Routes
///
/// The macro reads the body and differentiates it symbolically. The symbolic code calls functions
/// of the form `fn f<D: Dual>(x: Real<D>) -> Real<D>` with the numbers of num-dual. A body that the
/// macro cannot read (for example, a loop whose bound is a parameter) runs on dual numbers as a
/// whole. `Facts::route` returns the route. `#[constraint(symbolic)]` makes an unreadable body a
/// compile error at the unreadable token; `#[constraint(dual)]` selects dual numbers.
///
/// `#[constraint(with = helper)]` puts the text of a function under [`macro@helper`] into mechanism
/// files, together with the text of the constraint that calls it. The files also contain the f64
/// constants that the constraint uses.
///
/// `#[constraint(LEGS = 6)]` gives the value of a named length, which is a constant or a const
/// generic. The macro needs the value, because it counts columns. The compiler compares the value
/// with that of the constant.
///
/// A path or field that the macro cannot know (`MAX_LIFT`, `gains.k`) is an f64 at run time, unless
/// a `let v: Vec2 = …` or its place gives it another type.
///
/// # Requirements
///
/// `#[require(length > 0.0)]` below `#[constraint]` or `#[law]` states a condition on the
/// parameters. A message is optional: `#[require(length > 0.0, "a rod needs a positive length")]`.
/// The constructor does not test the condition, because it returns a value and no `Result`. The
/// mechanism tests the condition when a program adds the constraint, and returns an error with the
/// name of the constraint.
///
/// `#[branch(condition, "what is wrong")]` states a condition on the pose, for an equation with
/// unwanted solutions (for example, an axis turned by 180°). Kin tests the condition after it has
/// found a position.
///
/// # Kinks
///
/// At a kink the derivative is that of one side: `abs` at 0 takes the side x ≥ 0; `a.max(b)` and
/// `a.min(b)` of equal values take the side of a; an `if` takes its present branch. The derivative
/// of a step (`floor`, `signum`, …) is 0.
#[proc_macro_attribute]
pub fn constraint(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::constraint(attribute.into(), item.into()).into()
}

/// Turns a function V(q, t) into a load with the generalised forces −V_qᵀ: V is its energy.
///
/// ```text
/// /// Energy of a spring, ½ k (l − l0)².      [J]
/// #[potential]
/// fn spring(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, k: f64, free: f64) -> f64 {
///     let stretch = (i.point(u_i) - j.point(u_j)).norm() - free;
///     0.5 * k * stretch * stretch
/// }
/// ```
///
/// The rules of `#[constraint]` for arguments, routes and requirements apply. An energy has one
/// row. A program adds it to a mechanism by `m.load("closer", spring(…))`.
#[proc_macro_attribute]
pub fn potential(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::potential(attribute.into(), item.into()).into()
}

/// Turns a function f(x, ẋ, t) into a force along a length or an angle x, with the generalised
/// forces f x_qᵀ.
///
/// ```text
/// /// A strut with a spring and a damper in it.      [N]
/// #[force]
/// fn strut(x: Coord, rate: Rate, k: f64, free: f64, c: f64) -> f64 {
///     -k * (x - free) - c * rate * rate.abs()
/// }
/// ```
///
/// The first argument is x. The second argument is the rate ẋ, if the force depends on it.
/// `t: Time` and parameters may follow. The constructor takes a constraint of one row, whose value
/// is x, and the parameters:
/// `m.load("strut", strut(loads::length(i, j, u_i, u_j), 80.0, 0.4, 12.0))`. The rules of
/// `#[constraint]` for the body apply.
#[proc_macro_attribute]
pub fn force(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::force(attribute.into(), item.into()).into()
}

/// Turns a function f(x) into a `Law` with its derivatives to third order.
///
/// ```text
/// /// Harmonic rise of height h over an angle β.      [m]
/// #[law]
/// fn rise(x: f64, h: f64, beta: f64) -> f64 {
///     0.5 * h * (1.0 - (PI * x / beta).cos())
/// }
/// ```
///
/// The first argument is the variable. The other arguments are parameters of the constructor,
/// `rise(0.02, 1.2)`, which returns a `Law`. The rules of `#[constraint]` for the body apply.
#[proc_macro_attribute]
pub fn law(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::law(&attribute.into(), item.into()).into()
}
