//! Defines lengths and angles along which forces act, and forces that depend on a length or an
//! angle.

use std::sync::Arc;

use crate::model::constraint::Constraint;
use crate::model::mechanism::IntoConstraint;
use crate::model::terms::Local;

/// A length or an angle x along which a force acts. [`IntoAlong`] creates this value.
#[derive(Clone)]
pub struct Along(pub(crate) Line);

/// The kinds of lengths and angles.
#[derive(Clone)]
pub(crate) enum Line {
    /// The value of x(q, t) is the row of a constraint.
    Row(Box<dyn Constraint>),
    /// A measure of a joint, or a coordinate, by its name.
    Named(String),
}

/// A length or an angle x along which a force can act.
///
/// The length or angle is either a constraint of one row, whose value is x, or the name of a
/// measure of a joint or of a coordinate (`"guide.slide"`, `"crank.theta"`).
/// [`crate::System::measures`] lists the names.
///
/// ```
/// # use kin::prelude::*;
/// # use kin::loads;
/// # fn main() -> kin::Result<()> {
/// # let mut m = Mechanism::new("closer");
/// # let block = m.planar("block", pose(0.3, 0.0, 0.0))?;
/// # let (o, across) = (vec2(0.0, 0.0), vec2(0.0, 1.0));
/// m.add("guide", prismatic(block, m.ground(), o, o, across, 0.0))?;
/// // Stiffness, free length, damping.
/// m.load("buffer", loads::spring_damper("guide.slide", 800.0, 0.1, 25.0))?;
/// # Ok(())
/// # }
/// ```
#[diagnostic::on_unimplemented(
    message = "a force cannot act along `{Self}`",
    label = "give a constraint of one row, or the name of a measure of a joint",
    note = "`kin::loads` has lengths and angles (`length`, `turn`, `slide`); write a measure as `\"guide.slide\"`"
)]
pub trait IntoAlong {
    /// Returns the length or angle.
    #[doc(hidden)]
    fn into_along(self) -> Along;
}

impl<T: IntoConstraint> IntoAlong for T {
    fn into_along(self) -> Along {
        Along(Line::Row(self.into_constraint()))
    }
}

impl IntoAlong for &str {
    fn into_along(self) -> Along {
        Along(Line::Named(self.to_string()))
    }
}

impl IntoAlong for String {
    fn into_along(self) -> Along {
        Along(Line::Named(self))
    }
}

impl IntoAlong for &String {
    fn into_along(self) -> Along {
        Along(Line::Named(self.clone()))
    }
}

impl IntoAlong for Along {
    fn into_along(self) -> Along {
        self
    }
}

impl std::fmt::Debug for Along {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.0 {
            Line::Row(x) => f.write_str(x.facts().kind),
            Line::Named(name) => write!(f, "`{name}`"),
        }
    }
}

/// A force f(x, ẋ, t) along a length or an angle x.
#[derive(Clone)]
pub(crate) enum ForceAlong {
    /// A closure of the program, whose formula Kin does not know.
    Closure(Arc<dyn Fn(f64, f64, f64) -> f64 + Send + Sync>),
    /// A function with `#[force]`: the row of a constraint on x and ẋ.
    Written(Box<dyn Constraint>),
}

impl ForceAlong {
    /// Returns the value of the force.
    pub(crate) fn at(&self, x: f64, rate: f64, t: f64) -> f64 {
        match self {
            ForceAlong::Closure(force) => force(x, rate, t),
            ForceAlong::Written(force) => {
                let mut value = [f64::NAN];
                force.residual(&Local::new(&force.arguments(), &[x, rate], &[]).at(t), &mut value);
                value[0]
            }
        }
    }
}
