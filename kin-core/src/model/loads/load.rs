//! Defines loads: everything except weight that acts on a mechanism.

use std::sync::Arc;

use super::{Along, ByLaws, ForceAlong, HasTorque, IntoAlong, Line};
use crate::coordinates::Target;
use crate::dimensions::{Bindings, Dimension, IntoVector};
use crate::law::Law;
use crate::model::body::Body;
use crate::model::constraint::Constraint;

/// A load: an energy, a force along a length or an angle, or a force and a torque on a body.
#[derive(Clone)]
pub struct Load(pub(crate) Acting);

/// The kinds of loads.
#[derive(Clone)]
pub(crate) enum Acting {
    /// The generalised forces Q = −V_qᵀ of an energy V(q, t), which is the row of a constraint.
    Potential(Box<dyn Constraint>),
    /// The generalised forces Q = f(x, ẋ, t) x_qᵀ of a force along a length or an angle x(q, t).
    Along(Along, ForceAlong),
    /// A force and a torque on a body.
    OnBody(Box<OnBody>),
    /// Several loads under one name.
    Sum(Vec<Load>),
}

/// A force at a point of a body, and a torque, both by laws of time.
#[derive(Clone)]
pub(crate) struct OnBody {
    pub target: Target,
    /// ū of the point; z is 0 in a plane.
    pub point: [f64; 3],
    pub force: [Law; 3],
    pub torque: [Law; 3],
    /// True if the components are in the axes of the body.
    pub fixed: bool,
    /// The components of the point that depend on dimensions. Laws record their parameters
    /// separately.
    pub hung: Bindings,
}

impl OnBody {
    /// Creates a load of zero at a point of a body.
    pub(crate) fn new<B: Body>(body: B, u: [Dimension; 3], fixed: bool) -> OnBody {
        let mut on = OnBody::on(body.target(), fixed);
        on.at(u);
        on
    }

    /// Creates a load of zero at the origin of a body.
    pub(crate) fn on(target: Target, fixed: bool) -> OnBody {
        let none = || [(); 3].map(|()| Law::constant(0.0));
        OnBody {
            target,
            point: [0.0; 3],
            force: none(),
            torque: none(),
            fixed,
            hung: Bindings::default(),
        }
    }

    /// Moves the load to another point of the body.
    pub(crate) fn at(&mut self, u: [Dimension; 3]) {
        self.point = self.hung.vector("point", u);
    }

    /// Removes and returns the numbers that depend on dimensions, with their names.
    fn take_bindings(&mut self) -> Vec<(String, Dimension)> {
        let mut hung = std::mem::take(&mut self.hung);
        for (of, laws) in [("force", &self.force), ("torque", &self.torque)] {
            for (law, component) in laws.iter().zip(["x", "y", "z"]) {
                hung.law(&format!("{of}.{component}"), law);
            }
        }
        hung.take()
    }
}

impl Acting {
    /// Returns the energy, length or angle, or the force along that length or angle.
    pub(crate) fn constraint(&self, is_force: bool) -> Option<&dyn Constraint> {
        match self {
            Acting::Potential(scalar) | Acting::Along(Along(Line::Row(scalar)), _) if !is_force => {
                Some(scalar.as_ref())
            }
            Acting::Along(_, ForceAlong::Written(force)) if is_force => Some(force.as_ref()),
            _ => None,
        }
    }
}

/// A part of a load that holds numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holding {
    /// An energy, a length or an angle.
    Scalar,
    /// The force along the length or angle.
    Force,
    /// A force and torque on a body.
    OnBody,
}

/// A number of a load that depends on dimensions: the index of its part, the kind of place, its
/// name and its value.
pub(crate) type HungInLoad = (usize, Holding, String, Dimension);

/// An energy V(q, t), which you write as a function with `#[potential]`.
///
/// The generalised forces of the energy are −V_qᵀ.
///
/// Kin stores a potential like a constraint of one row, but a potential is not an equation of the
/// mechanism.
///
/// ```
/// # use kin::prelude::*;
/// /// Energy of a spring, ½ k (l − l0)².      [J]
/// #[potential]
/// fn spring(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, k: f64, free: f64) -> f64 {
///     let stretch = (i.point(u_i) - j.point(u_j)).norm() - free;
///     0.5 * k * stretch * stretch
/// }
///
/// # fn main() -> kin::Result<()> {
/// # let mut m = Mechanism::new("door");
/// # let door = m.link("door", 1.0)?;
/// m.load("closer", spring(m.ground(), door, vec2(0.0, 0.3), door.end(), 80.0, 0.4))?;
/// # Ok(())
/// # }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a load",
    label = "give a function with `#[potential]` (an energy) or a `Load`",
    note = "add a constraint by `m.add(…)`"
)]
pub trait Potential: Constraint + 'static {}

/// A value that acts on a mechanism: a [`Load`] or an energy.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a load",
    label = "give a function with `#[potential]` (an energy) or a `Load`",
    note = "add a constraint by `m.add(…)`"
)]
pub trait IntoLoad {
    /// Returns the load.
    #[doc(hidden)]
    fn into_load(self) -> Load;
}

impl IntoLoad for Load {
    fn into_load(self) -> Load {
        self
    }
}

impl<T: Potential> IntoLoad for T {
    fn into_load(self) -> Load {
        Load(Acting::Potential(Box::new(self)))
    }
}

impl Load {
    /// Creates a force or torque f(x, ẋ, t) along a length or an angle x(q, t): Q = f x_qᵀ. \[N, N
    /// m\]
    ///
    /// `x` is a constraint of one row, or the name of a measure of a joint or of a coordinate. A
    /// positive f increases x. The load f is a force if x is a length, and a torque if x is an
    /// angle.
    ///
    /// The angle of a joint counts revolutions along the motion, as in [`crate::System::measure`].
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # use kin::Load;
    /// /// Stretch of a strut.      [m]
    /// #[constraint]
    /// fn stretch(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> f64 {
    ///     (i.point(u_i) - j.point(u_j)).norm()
    /// }
    ///
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("door");
    /// let door = m.link("door", 1.0)?;
    /// let closer = stretch(m.ground(), door, vec2(0.0, 0.3), door.end());
    /// m.load("closer", Load::along(closer, |x, rate, _| {
    ///     -80.0 * (x - 0.4) - 12.0 * rate.abs() * rate
    /// }))?;
    /// # Ok(())
    /// # }
    /// ```
    pub fn along(
        x: impl IntoAlong,
        force: impl Fn(f64, f64, f64) -> f64 + Send + Sync + 'static,
    ) -> Load {
        Load(Acting::Along(x.into_along(), ForceAlong::Closure(Arc::new(force))))
    }

    /// Creates a force along `x` from a function with `#[force]`.
    ///
    /// The macro `#[force]` calls this constructor.
    #[doc(hidden)]
    pub fn written(x: impl IntoAlong, force: impl Constraint + 'static) -> Load {
        Load(Acting::Along(x.into_along(), ForceAlong::Written(Box::new(force))))
    }

    /// Creates a force at the point ū of a body, in global components. \[N, m\]
    ///
    /// The force is a constant vector, or one law of time for each component.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # use kin::Load;
    /// # fn main() -> kin::Result<()> {
    /// # let mut m = Mechanism::new("boom");
    /// let boom = m.link("boom", 2.0)?;
    /// m.load("bucket", Load::force(boom, boom.end(), vec2(0.0, -300.0)))?;
    /// let wind = [Law::sine(20.0, 3.0, 0.0), Law::constant(0.0)];
    /// m.load("wind", Load::force(boom, vec2(0.0, 0.1), wind))?;
    /// m.load("tool", Load::force_in_body(boom, boom.end(), vec2(-50.0, 0.0)))?; // along the boom
    /// m.load("brake", Load::torque(boom, -2.0))?;
    /// # Ok(())
    /// # }
    /// ```
    pub fn force<B: Body>(
        body: B,
        u: impl IntoVector<B::Vector>,
        force: impl ByLaws<B::Vector>,
    ) -> Load {
        let on = OnBody::new(body, u.numbers(), false);
        Load(Acting::OnBody(Box::new(OnBody { force: force.laws(), ..on })))
    }

    /// Creates a force at the point ū of a body, in the axes of the body. \[N, m\]
    ///
    /// The direction of the force rotates with the body.
    pub fn force_in_body<B: Body>(
        body: B,
        u: impl IntoVector<B::Vector>,
        force: impl ByLaws<B::Vector>,
    ) -> Load {
        let on = OnBody::new(body, u.numbers(), true);
        Load(Acting::OnBody(Box::new(OnBody { force: force.laws(), ..on })))
    }

    /// Creates a torque on a body, in global components. \[N m\]
    ///
    /// In the plane the torque is a number or a law, and positive counter-clockwise. In space the
    /// torque is a vector or three laws of time.
    pub fn torque<B: Body>(body: B, torque: impl ByLaws<<B::Vector as HasTorque>::Torque>) -> Load
    where
        B::Vector: HasTorque,
    {
        let on = OnBody::new(body, [(); 3].map(|()| 0.0.into()), false);
        Load(Acting::OnBody(Box::new(OnBody { torque: torque.laws(), ..on })))
    }

    /// Creates a torque on a body, in the axes of the body. \[N m\]
    pub fn torque_in_body<B: Body>(
        body: B,
        torque: impl ByLaws<<B::Vector as HasTorque>::Torque>,
    ) -> Load
    where
        B::Vector: HasTorque,
    {
        let on = OnBody::new(body, [(); 3].map(|()| 0.0.into()), true);
        Load(Acting::OnBody(Box::new(OnBody { torque: torque.laws(), ..on })))
    }

    /// Combines two loads under one name, such as a spring and its damper.
    #[must_use]
    pub fn and(self, other: impl IntoLoad) -> Load {
        let mut all = match self.0 {
            Acting::Sum(all) => all,
            one => vec![Load(one)],
        };
        all.push(other.into_load());
        Load(Acting::Sum(all))
    }

    /// Returns part `part`, counted over the parts that are not sums.
    pub(crate) fn part(&self, part: usize) -> Option<&Acting> {
        let mut number = 0;
        let mut found = None;
        self.parts(&mut |own| {
            found = if number == part { Some(own) } else { found };
            number += 1;
        });
        found
    }

    /// Returns part `part`, mutable.
    pub(super) fn part_mut(&mut self, part: usize) -> Option<&mut Acting> {
        self.parts_mut().into_iter().nth(part)
    }

    fn parts_mut(&mut self) -> Vec<&mut Acting> {
        match &mut self.0 {
            Acting::Sum(all) => all.iter_mut().flat_map(Load::parts_mut).collect(),
            one => vec![one],
        }
    }

    /// Removes and returns the numbers of all parts that depend on dimensions.
    pub(crate) fn take_bindings(&mut self) -> Vec<HungInLoad> {
        let mut all = Vec::new();
        for (part, acting) in self.parts_mut().into_iter().enumerate() {
            let mut note = |holding: Holding, own: Vec<(String, Dimension)>| {
                all.extend(own.into_iter().map(|(name, number)| (part, holding, name, number)));
            };
            match acting {
                Acting::Potential(scalar) => note(Holding::Scalar, scalar.take_bindings().take()),
                Acting::Along(along, force) => {
                    if let Line::Row(scalar) = &mut along.0 {
                        note(Holding::Scalar, scalar.take_bindings().take());
                    }
                    if let ForceAlong::Written(force) = force {
                        note(Holding::Force, force.take_bindings().take());
                    }
                }
                Acting::OnBody(on) => note(Holding::OnBody, on.take_bindings()),
                Acting::Sum(_) => {}
            }
        }
        all
    }

    /// Visits the parts that are not sums.
    pub(crate) fn parts<'a>(&'a self, visit: &mut dyn FnMut(&'a Acting)) {
        match &self.0 {
            Acting::Sum(all) => all.iter().for_each(|part| part.parts(visit)),
            one => visit(one),
        }
    }
}

impl std::fmt::Debug for Load {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.0 {
            Acting::Potential(energy) => write!(f, "Load({})", energy.facts().kind),
            Acting::Along(x, _) => write!(f, "Load(along {x:?})"),
            Acting::OnBody(on) => write!(f, "Load(on {:?})", on.target),
            Acting::Sum(all) => f.debug_tuple("Load").field(all).finish(),
        }
    }
}
