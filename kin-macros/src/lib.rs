//! The constraint compiler of Kin: `#[constraint]` turns one Rust function C(q, t) into residual,
//! Jacobian and right sides; `#[law]` turns a function of one variable into a law with its
//! derivatives.
//!
//! The stages, in the order data moves: `parse` → `lower` (over `graph`) → `differentiate` →
//! `emit`.
#![forbid(unsafe_code)]

mod emit;
mod expand;
#[cfg(test)]
mod tests;

use proc_macro::TokenStream;

/// Keeps the text of a function, so that the constraints that call it can be written into files
/// that stand alone: `#[constraint(with = parabola)]` takes the text of `parabola` along with its
/// own. `#[helper(with = other)]` is for a function that calls another one.
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
/// The function becomes a constructor, `parabolic_slot(crank, table, vec2(0.1, 0.0), 2.0)`, of a
/// struct of the same name that implements `Constraint`: C, C_q at a fixed pattern, C_t, and r(q̇,
/// ṫ) = −\[(C_q q̇)_q q̇ + 2 ṫ C_qt q̇ + ṫ² C_tt\].
///
/// # Arguments
///
/// Types are read by name; an alias is an error that says so.
///
/// | type | in the function | the constructor takes |
/// |---|---|---|
/// | `Planar` | state of a planar body: `r`, `theta`, `a()`, `point(u)`, `direction(h)`, `local(p)` | anything `Into<PlanarBody>` |
/// | `Spatial` | state of a spatial body: `r`, `p`, `a()`, `point(u)`, `direction(h)`, `local(p)` | anything `Into<SpatialBody>` |
/// | `Coord`, `[Coord; N]` | bare coordinates, as numbers | anything `Into<Coordinate>`, `[Coordinate; N]` |
/// | `[Planar; N]`, `[Spatial; N]` | states of several bodies | arrays of the same |
/// | `Time` | t   \[s\] | nothing |
/// | `Law` | a function of one variable: `law.at(x)`, its derivative `law.slope(x)` | a `Law` |
/// | `Axis` | unit vectors `h` along an axis of a spatial body, `f` and `g` across it | anything `Into<Axis>`: a `Vec3` |
/// | any other `Clone + Send + Sync` type | a parameter | the value |
///
/// # Result
///
/// `f64`, `Vec2`, `Vec3`, `[f64; N]` or a tuple of these: one row each, named after the identifiers
/// in a returned tuple or array, else x, y, z of a vector, else 1, 2, ….
///
/// # Routes
///
/// The body is read by the compiler and differentiated symbolically. Calls of functions
/// `fn f<D: Dual>(x: Real<D>) -> Real<D>` are evaluated with num-dual's numbers inside the symbolic
/// code. A body that cannot be read (a loop whose bound is a parameter) runs on dual numbers as a
/// whole; `Facts::route` tells which. `#[constraint(symbolic)]` makes such a body a compile error
/// at the token that cannot be read, `#[constraint(dual)]` asks for dual numbers.
///
/// `#[constraint(with = helper)]` puts the text of a function under [`macro@helper`] into mechanism
/// files, with that of the constraint that calls it. Constants that are an f64 go there by
/// themselves.
///
/// `#[constraint(LEGS = 6)]` says what a length with a name is, of a constant or of a const
/// generic: columns are counted here. Of a constant it is compared with what it is.
///
/// A path or field that the macro cannot know (`MAX_LIFT`, `gains.k`) is an f64 at run time, unless
/// a `let v: Vec2 = …` or its place says otherwise.
///
/// # What is demanded
///
/// `#[require(length > 0.0)]` below `#[constraint]` or `#[law]` says what must hold of the
/// parameters, with a text of one's own if one likes:
/// `#[require(length > 0.0, "a rod needs a length above zero")]`. Constructors give values, not
/// results: the requirement is looked at where the constraint is added to a mechanism, which
/// refuses it by name.
///
/// `#[branch(condition, "what is wrong")]` says of the pose what the equation cannot, where it has
/// solutions that are not meant (an axis turned by 180°): it is looked at when a position has been
/// found.
///
/// # Kinks
///
/// Derivatives are taken from one side: `abs` at 0 as for x ≥ 0; `a.max(b)` and `a.min(b)` of equal
/// values as for a; an `if` as the branch it takes; the steps (`floor`, `signum`, …) have
/// derivative 0.
#[proc_macro_attribute]
pub fn constraint(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::constraint(attribute.into(), item.into()).into()
}

/// Turns a function V(q, t) into an energy, which acts: its generalised forces are −V_qᵀ.
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
/// All that is said of `#[constraint]` holds for it, and the body is read by the same compiler; but
/// it has one row, and is given to a mechanism by `m.load("closer", spring(…))`.
#[proc_macro_attribute]
pub fn potential(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::potential(attribute.into(), item.into()).into()
}

/// Turns a function f(x, ẋ, t) into a force along a length or an angle x: its generalised forces
/// are f x_qᵀ.
///
/// ```text
/// /// A strut with a spring and a damper in it.      [N]
/// #[force]
/// fn strut(x: Coord, rate: Rate, k: f64, free: f64, c: f64) -> f64 {
///     -k * (x - free) - c * rate * rate.abs()
/// }
/// ```
///
/// The first argument is x, the second its rate, if the force depends on it; `t: Time` may follow,
/// and parameters. The constructor takes x, any constraint of one row whose value it is, and the
/// parameters: `m.load("strut", strut(loads::length(i, j, u_i, u_j), 80.0, 0.4,
/// 12.0))`. The body is read as under `#[constraint]`.
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
/// The first argument is the variable; the others are parameters of the constructor,
/// `rise(0.02, 1.2)`, which gives a `Law`. The body is read as under `#[constraint]`.
#[proc_macro_attribute]
pub fn law(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::law(&attribute.into(), item.into()).into()
}
