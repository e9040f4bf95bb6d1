//! The one trait of the library: what a constraint C(q, t) = 0 can be asked for. Each of its
//! methods is a formula; what is fixed is told once, by [`Facts`], parameters and the written
//! equation have traits of their own.

mod facts;
mod parameters;
mod route;
mod written;

use crate::model::coordinates::Argument;
use crate::model::state::{At, Rates};

pub use facts::{Dependence, Entry, Facts};
pub use parameters::Parameters;
pub use route::{Route, RouteReason, Routed};
pub use written::{Attached, Attachment, Written};

/// A measure of a joint, which can be asked beside its equations: an angle, a slide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measured {
    /// Its name, such as `slide`.
    pub name: &'static str,
    /// Its unit, such as `m`.
    pub unit: &'static str,
    /// True if it is an angle that is known up to whole turns, which a motion counts from one time
    /// to the next.
    pub turns: bool,
}

/// A copy of a constraint that is only known as a `Constraint`; each one that is `Clone` has it. A
/// sweep over many cases works on copies.
pub trait CloneBoxed {
    /// The copy.
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
/// Columns are local: those of the first argument first (3 for a planar body, 7 for a spatial one,
/// 1 for a bare coordinate), the ground's counted too. Output slices have the lengths stated; a
/// shorter one is left as it is. Entries are in the unit of their row.
pub trait Constraint: CloneBoxed + Send + Sync {
    /// The fixed facts about it: its names, the shape of its terms, and promises about them.
    fn facts(&self) -> Facts<'_>;

    /// The bodies and coordinates it acts on, in the order of its signature.
    fn arguments(&self) -> Vec<Argument>;

    /// Evaluates the [`Facts::n_timed`] numbers of time t into `timed`; asked for once a time,
    /// before anything else.
    fn at_time(&self, t: f64, timed: &mut [f64]) {
        let _ = (t, timed);
    }

    /// C(q, t) into `c` (length m).
    fn residual(&self, at: &At<'_>, c: &mut [f64]);

    /// C_q(q, t) into `c_q` (one value an entry of the pattern).
    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]);

    /// C and C_q together, where that saves work.
    fn linearize(&self, at: &At<'_>, c: &mut [f64], c_q: &mut [f64]) {
        self.residual(at, c);
        self.jacobian(at, c_q);
    }

    /// The right side of C_q q̇ = −C_t into `rhs` (length m).   \[row/s\]
    fn velocity_rhs(&self, at: &At<'_>, rhs: &mut [f64]);

    /// r(q̇, ṫ) = −\[(C_q q̇)_q q̇ + 2 ṫ C_qt q̇ + ṫ² C_tt\] into `q_d` (length m); with ṫ = 1 the
    /// right side of C_q q̈ = Q_d.   \[row/s²\]
    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, t_dot: f64, q_d: &mut [f64]);

    /// −g‴(0) with g(s) = C(q + s q̇ + ½ s² q̈, t + s) into `rhs` (length m): the right side of C_q
    /// q⃛ = −g‴(0), for the jerk.   \[row/s³\]
    ///
    /// False, and nothing written, where that is not known (default, unless it has a formula): a
    /// run that is asked for the jerk then ends with an error by name.
    fn jerk_rhs(&self, at: &At<'_>, qd: &Rates<'_>, qdd: &Rates<'_>, rhs: &mut [f64]) -> bool {
        let Some(written) = self.parts().written else { return false };
        written.jerk_rhs(&self.arguments(), at, [qd, qdd], rhs)
    }

    /// Measure k of [`Facts::measures`] with its first three derivatives along the rates q̇, q̈ and
    /// q⃛.
    fn measure(&self, k: usize, at: &At<'_>, rates: &[Rates<'_>; 3]) -> [f64; 4] {
        let _ = (k, at, rates);
        [f64::NAN; 4]
    }

    /// The fault of a position where C = 0 holds but not as it is meant, such as with an axis
    /// turned by 180°. Looked at whenever a position has been found.
    fn wrong_branch(&self, at: &At<'_>) -> Option<&str> {
        let _ = at;
        None
    }

    /// The traits of its own that it has beside its formulas; none by default.
    fn parts(&self) -> Parts<'_> {
        Parts::default()
    }

    /// Its parameters, to be changed; [`Parts::parameters`] shows them.
    fn parameters_mut(&mut self) -> Option<&mut dyn Parameters> {
        None
    }
}

/// A constraint beside its formulas, each side of it a trait of its own; `None` where it has none.
#[derive(Clone, Copy, Default)]
pub struct Parts<'a> {
    /// Its parameters, which can be read by name.
    pub parameters: Option<&'a dyn Parameters>,
    /// Its equation as it was written.
    pub written: Option<&'a dyn Written>,
}
