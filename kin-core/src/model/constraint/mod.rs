//! Defines the trait of all constraints C(q, t) = 0.
//!
//! Each method computes one formula. [`Facts`] contains the fixed facts of a constraint.
//! [`Parameters`] and [`Written`] are separate traits for parameters and for the equation as text.

mod facts;
mod parameters;
mod route;
mod written;

use crate::coordinates::Argument;
use crate::model::state::{At, Rates};

pub use facts::{Dependence, Entry, Facts};
pub use parameters::Parameters;
pub use route::{Route, RouteReason, Routed};
pub use written::{Attached, Attachment, Written};

/// A measure of a joint besides its equations, such as an angle or a slide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measured {
    /// The name, such as `slide`.
    pub name: &'static str,
    /// The unit, such as `m`.
    pub unit: &'static str,
    /// True for an angle that is known only up to full revolutions. Kin counts the revolutions from
    /// one time of a motion to the next.
    pub turns: bool,
}

/// Copies a constraint behind a `dyn Constraint`, because a sweep over many cases works on copies.
///
/// Every constraint that implements `Clone` implements this trait.
pub trait CloneBoxed {
    /// Returns a copy of the constraint.
    fn clone_boxed(&self) -> Box<dyn Constraint>;
}

impl<T: Constraint + Clone + 'static> CloneBoxed for T {
    fn clone_boxed(&self) -> Box<dyn Constraint> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Constraint> {
    fn clone(&self) -> Self {
        self.as_ref().clone_boxed()
    }
}

/// A constraint C(q, t) = 0 with m rows on the coordinates of its arguments.
///
/// Columns are local: the columns of the first argument come first. A planar body has 3 columns, a
/// spatial body 7, and a scalar coordinate 1. The ground has columns too. Output slices have the
/// stated lengths, and a method does not change a shorter slice. Entries are in the unit of their
/// row.
pub trait Constraint: CloneBoxed + Send + Sync {
    /// Returns the fixed facts: names, the shape of the terms, and promises about them.
    fn facts(&self) -> Facts<'_>;

    /// Returns the bodies and coordinates of the constraint, in the order of its signature.
    fn arguments(&self) -> Vec<Argument>;

    /// Writes the [`Facts::n_timed`] numbers that depend on time t into `timed`.
    ///
    /// The solver calls this method once for each time, before all other methods.
    fn at_time(&self, t: f64, timed: &mut [f64]) {
        let _ = (t, timed);
    }

    /// Writes C(q, t) into `c` (length m).
    fn residual(&self, at: &At<'_>, c: &mut [f64]);

    /// Writes C_q(q, t) into `c_q`, one value for each entry of the pattern.
    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]);

    /// Writes C and C_q together.
    ///
    /// Override this method if both are faster to compute together.
    fn linearize(&self, at: &At<'_>, c: &mut [f64], c_q: &mut [f64]) {
        self.residual(at, c);
        self.jacobian(at, c_q);
    }

    /// Writes the right side of C_q q̇ = −C_t into `rhs` (length m). \[row/s\]
    fn velocity_rhs(&self, at: &At<'_>, rhs: &mut [f64]);

    /// Writes r(q̇, ṫ) = −\[(C_q q̇)_q q̇ + 2 ṫ C_qt q̇ + ṫ² C_tt\] into `q_d` (length m).
    /// \[row/s²\]
    ///
    /// With ṫ = 1 this is the right side of C_q q̈ = Q_d.
    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, t_dot: f64, q_d: &mut [f64]);

    /// Writes the right side of C_q q⃛ = −g‴(0) for the jerk into `rhs` (length m), with g(s) = C(q
    /// + s q̇ + ½ s² q̈, t + s). \[row/s³\]
    ///
    /// Returns false and writes nothing if the right side is unknown. The default implementation
    /// knows the right side only if the constraint has a formula. If the right side is unknown, a
    /// run that computes the jerk ends with an error that names the constraint.
    fn jerk_rhs(&self, at: &At<'_>, qd: &Rates<'_>, qdd: &Rates<'_>, rhs: &mut [f64]) -> bool {
        let Some(written) = self.parts().written else { return false };
        written.jerk_rhs(&self.arguments(), at, [qd, qdd], rhs)
    }

    /// Returns measure k of [`Facts::measures`] and its first three derivatives along q̇, q̈ and
    /// q⃛.
    fn measure(&self, k: usize, at: &At<'_>, rates: &[Rates<'_>; 3]) -> [f64; 4] {
        let _ = (k, at, rates);
        [f64::NAN; 4]
    }

    /// Returns a description of the mistake if a position satisfies C = 0 on the wrong branch, such
    /// as an axis turned by 180°.
    ///
    /// The solver calls this method after it finds a position.
    fn wrong_branch(&self, at: &At<'_>) -> Option<&str> {
        let _ = at;
        None
    }

    /// Returns the additional traits of the constraint. By default a constraint has none.
    fn parts(&self) -> Parts<'_> {
        Parts::default()
    }

    /// Returns mutable access to the parameters, or `None` if the constraint has none.
    ///
    /// [`Parts::parameters`] gives read access.
    fn parameters_mut(&mut self) -> Option<&mut dyn Parameters> {
        None
    }
}

/// The additional traits of a constraint.
///
/// A field is `None` if the constraint does not implement the trait.
#[derive(Clone, Copy, Default)]
pub struct Parts<'a> {
    /// The parameters, which callers read by name.
    pub parameters: Option<&'a dyn Parameters>,
    /// The equation as the user wrote it.
    pub written: Option<&'a dyn Written>,
}
