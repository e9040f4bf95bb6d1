//! Reads equations from text and creates constraints from them.

use std::str::FromStr;
use std::sync::Arc;

use kin::dimension::IntoNumber;
use kin::emitted::{Bindings, parameter};
use kin::error::{Error, Result};
use kin::extend::dual_route::ArgumentKind;
use kin::{
    Axis, Coordinate, Dimension, EulerParameters, Ground, Law, Link, Mat2, Mat3, PlanarBody,
    SpatialBody, SpatialLink, Vec2, Vec3,
};

use crate::constraint::{Body, ReadConstraint, count};
use crate::mistake::Mistakes;
use crate::read::{Read, read};
use crate::signature::ParameterKind;

/// An equation C(q, t) = 0 that Kin has read from text, with all derivatives.
///
/// The text contains a function in the form of a function under `#[constraint]`. The same text
/// contains the functions and constants that the function uses. The attributes `#[require]`,
/// `#[branch]` and `#[measure]` can precede the function.
///
/// ```
/// use kin_text::Equation;
/// # use kin::joints::drivers::drive;
/// # use kin::{Law, Mechanism, linspace, pose};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let slot = Equation::read(
///     "fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
///          let s = j.local(i.point(u_i));
///          s.y - k * s.x * s.x
///      }",
/// )?;
/// let mut m = Mechanism::new("slider in a slot");
/// let slider = m.planar("slider", pose(0.2, 0.1, 0.0))?;
/// let slot = slot.on(slider).on(m.ground()).with("u_i", [0.0, 0.0]).with("k", 2.0);
/// m.add("slot", slot.constraint()?)?;
/// m.add("upright", drive(slider.theta(), Law::constant(0.0)))?;
/// m.add("motor", drive(slider.x(), Law::sine(0.3, 1.0, 0.0)))?;
/// let motion = m.build()?.run(linspace(0.0, 6.0, 61))?;
/// # let q = motion.q(60);
/// # assert!((q[1] - 2.0 * q[0] * q[0]).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
#[derive(Clone)]
pub struct Equation(Arc<Read>);

impl Equation {
    /// Reads an equation from a text.
    ///
    /// Errors: the text contains mistakes; the text uses a type or function that it does not
    /// define; the text is too long, too deep or too large. Each mistake has a line, a column and a
    /// suggestion.
    pub fn read(text: &str) -> std::result::Result<Equation, Mistakes> {
        read(text).map(|read| Equation(Arc::new(read)))
    }

    /// Returns the name of the function.
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// Returns the text of the equation.
    pub fn text(&self) -> &str {
        &self.0.text
    }

    /// Returns the kinds of the bodies and coordinates, in the order of the signature.
    pub fn arguments(&self) -> Vec<ArgumentKind> {
        self.0.signature.slots.iter().map(|(_, kind)| *kind).collect()
    }

    /// Begins a constraint with this body or coordinate as the first argument of the signature.
    pub fn on(&self, first: impl Into<On>) -> Making {
        Making { read: self.0.clone(), bodies: vec![], given: vec![] }.on(first)
    }

    pub(crate) fn inner(&self) -> &Arc<Read> {
        &self.0
    }
}

impl FromStr for Equation {
    type Err = Mistakes;

    fn from_str(text: &str) -> std::result::Result<Self, Mistakes> {
        Equation::read(text)
    }
}

/// Collects the arguments of a constraint: bodies in the order of the signature, parameters by
/// name.
#[derive(Clone)]
#[must_use]
pub struct Making {
    read: Arc<Read>,
    bodies: Vec<On>,
    given: Vec<(String, Parameter)>,
}

impl Making {
    /// Adds the next body or coordinate of the signature.
    pub fn on(mut self, next: impl Into<On>) -> Self {
        self.bodies.push(next.into());
        self
    }

    /// Sets the value of a parameter, in the unit that the equation requires.
    ///
    /// The numbers of the parameter, and the numbers of a law, may be [`Dimension`]s.
    pub fn with(mut self, name: &str, value: impl Into<Parameter>) -> Self {
        self.given.push((name.to_owned(), value.into()));
        self
    }

    /// Creates the constraint from the equation and the collected arguments.
    ///
    /// Errors: a body or parameter is missing, superfluous or of another kind.
    pub fn constraint(self) -> Result<ReadConstraint> {
        let name = self.read.name.clone();
        self.made().map_err(|reason| Error::Data { place: format!("`{name}`"), reason })
    }

    fn made(self) -> std::result::Result<ReadConstraint, String> {
        let signature = &self.read.signature;
        let wanted = signature.slots.len();
        let given = self.bodies.len();
        if wanted != given {
            return Err(format!(
                "the constraint takes {wanted} bodies and coordinates, not {given}"
            ));
        }
        let bodies = signature.slots.iter().zip(&self.bodies);
        let targets =
            bodies.map(|((name, kind), on)| on.as_kind(*kind).ok_or_else(|| wrong(name, *kind)));
        let targets = targets.collect::<std::result::Result<_, _>>()?;
        let mut numbers = vec![Dimension::from(f64::NAN); signature.numbers.len()];
        let mut laws = Vec::new();
        let mut bindings = Bindings::NONE;
        for asked in &signature.parameters {
            let name = &asked.name;
            let value =
                self.given.iter().rev().find(|(known, _)| known == name).map(|(_, value)| value);
            let value = value.ok_or_else(|| {
                format!("the parameter `{name}` is missing. Give it by `.with(\"{name}\", …)`")
            })?;
            match (&asked.kind, value) {
                (ParameterKind::Law(_), Parameter::Law(law)) => {
                    laws.push(parameter(law.clone(), name, &mut bindings));
                }
                (ParameterKind::Law(_), Parameter::Numbers(all)) if all.len() == 1 => {
                    laws.push(parameter(Law::constant(all[0]), name, &mut bindings));
                }
                (ParameterKind::Axis { first }, Parameter::Numbers(all))
                    if all.len() == 3 || all.len() == 9 && all.iter().any(hangs) =>
                {
                    // The third of its vectors follows from the others.
                    let made = bindings.axis(name, &all[..all.len().min(6)]);
                    put(&mut numbers, *first, &numbers_of(&made).map(Dimension::from));
                }
                (ParameterKind::Axis { first }, Parameter::Numbers(all)) if all.len() == 9 => {
                    put(&mut numbers, *first, all);
                }
                (ParameterKind::Numbers { shape, first }, Parameter::Numbers(all))
                    if all.len() == count(shape) =>
                {
                    put(&mut numbers, *first, all);
                }
                (ParameterKind::Numbers { shape, .. }, Parameter::Numbers(all)) => {
                    return Err(format!(
                        "the parameter `{name}` takes {} numbers, not {}",
                        count(shape),
                        all.len()
                    ));
                }
                (ParameterKind::Law(_), _) => {
                    return Err(format!("the parameter `{name}` takes a law"));
                }
                (ParameterKind::Axis { .. }, _) => {
                    return Err(format!("the parameter `{name}` takes an axis"));
                }
                (_, Parameter::Law(_)) => {
                    return Err(format!("the parameter `{name}` takes no law"));
                }
            }
        }
        let known =
            |name: &String| signature.parameters.iter().any(|parameter| parameter.name == *name);
        if let Some((name, _)) = self.given.iter().find(|(name, _)| !known(name)) {
            return Err(format!("the constraint has no parameter `{name}`"));
        }
        let named = signature.numbers.iter().zip(numbers);
        let numbers = named.map(|(name, number)| bindings.number(name, number)).collect();
        Ok(ReadConstraint { targets, numbers, laws, bindings, read: self.read.clone() })
    }
}

/// True of a number that hangs on dimensions.
fn hangs(number: &Dimension) -> bool {
    let mut bindings = Bindings::NONE;
    bindings.number("", *number);
    !bindings.take().is_empty()
}

fn put(numbers: &mut [Dimension], first: usize, values: &[Dimension]) {
    numbers.iter_mut().skip(first).zip(values).for_each(|(place, value)| *place = *value);
}

fn wrong(name: &str, kind: ArgumentKind) -> String {
    let wanted = match kind {
        ArgumentKind::Planar => "a planar body",
        ArgumentKind::Spatial => "a spatial body",
        ArgumentKind::Coord => "a coordinate",
    };
    format!("the argument `{name}` must be {wanted}")
}

/// A body or coordinate as an argument of a constraint; the ground is a planar and a spatial body.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum On {
    /// A planar body.
    Planar(PlanarBody),
    /// A spatial body.
    Spatial(SpatialBody),
    /// A coordinate.
    Coord(Coordinate),
    /// The ground.
    Ground,
}

impl On {
    fn as_kind(self, kind: ArgumentKind) -> Option<Body> {
        Some(match (kind, self) {
            (ArgumentKind::Planar, On::Planar(body)) => Body::Planar(body),
            (ArgumentKind::Planar, On::Ground) => Body::Planar(Ground.into()),
            (ArgumentKind::Spatial, On::Spatial(body)) => Body::Spatial(body),
            (ArgumentKind::Spatial, On::Ground) => Body::Spatial(Ground.into()),
            (ArgumentKind::Coord, On::Coord(coordinate)) => Body::Coord(coordinate),
            _ => return None,
        })
    }
}

macro_rules! on {
    ($($ty:ty => $variant:ident;)*) => {$(
        impl From<$ty> for On {
            fn from(value: $ty) -> Self {
                On::$variant(value.into())
            }
        }
    )*};
}

on! {
    PlanarBody => Planar;
    Link => Planar;
    SpatialBody => Spatial;
    SpatialLink => Spatial;
    Coordinate => Coord;
}

impl From<Ground> for On {
    fn from(_: Ground) -> Self {
        On::Ground
    }
}

/// The value of a parameter: its numbers in order, or a law.
#[derive(Clone)]
#[non_exhaustive]
pub enum Parameter {
    /// The numbers of a scalar, vector, matrix, array or tuple, or the direction of an axis.
    Numbers(Vec<Dimension>),
    /// A law.
    Law(Law),
}

fn all<N: IntoNumber>(numbers: impl IntoIterator<Item = N>) -> Parameter {
    Parameter::Numbers(numbers.into_iter().map(IntoNumber::into_number).collect())
}

macro_rules! parameters {
    ($($ty:ty, |$x:ident| $numbers:expr;)*) => {$(
        impl From<$ty> for Parameter {
            fn from($x: $ty) -> Self {
                all($numbers)
            }
        }
    )*};
}

parameters! {
    f64, |x| [x];
    Dimension, |x| [x];
    Vec<f64>, |x| x;
    Vec<Dimension>, |x| x;
    &[f64], |x| x.iter().copied();
    EulerParameters, |p| [p.e0, p.e1, p.e2, p.e3];
    Mat2, |a| [a.m11, a.m12, a.m21, a.m22];
    Mat3, |a| [a.m11, a.m12, a.m13, a.m21, a.m22, a.m23, a.m31, a.m32, a.m33];
    Axis, |a| numbers_of(&a);
    Axis<Dimension>, |a| [a.h, a.f, a.g].into_iter().flat_map(Vec3::to_array);
}

impl<N: IntoNumber, const LENGTH: usize> From<[N; LENGTH]> for Parameter {
    fn from(x: [N; LENGTH]) -> Self {
        all(x)
    }
}

impl<X: IntoNumber, Y: IntoNumber> From<(X, Y)> for Parameter {
    fn from((x, y): (X, Y)) -> Self {
        all([x.into_number(), y.into_number()])
    }
}

impl<X: IntoNumber, Y: IntoNumber, Z: IntoNumber> From<(X, Y, Z)> for Parameter {
    fn from((x, y, z): (X, Y, Z)) -> Self {
        all([x.into_number(), y.into_number(), z.into_number()])
    }
}

impl<N: IntoNumber> From<Vec2<N>> for Parameter {
    fn from(v: Vec2<N>) -> Self {
        all([v.x, v.y])
    }
}

impl<N: IntoNumber> From<Vec3<N>> for Parameter {
    fn from(v: Vec3<N>) -> Self {
        all([v.x, v.y, v.z])
    }
}

impl From<Law> for Parameter {
    fn from(law: Law) -> Self {
        Parameter::Law(law)
    }
}

/// The nine numbers of an axis.
pub(crate) fn numbers_of(axis: &Axis) -> [f64; 9] {
    let h = axis.h;
    let f = axis.f;
    let g = axis.g;
    [h.x, h.y, h.z, f.x, f.y, f.z, g.x, g.y, g.z]
}
