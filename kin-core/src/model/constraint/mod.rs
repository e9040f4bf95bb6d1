//! The one trait of the library: what a constraint C(q, t) = 0 can be asked for.

mod route;

use crate::numbers::real::Dual3_64;

use crate::model::blame::{Asked, Blame};
use crate::model::coordinates::Argument;
use crate::model::describer::Describer;
use crate::model::formula::jerk::Along;
use crate::model::formula::{Given, Outside, Table};
use crate::model::law::Law;
use crate::model::state::{At, Rates};
use crate::numbers::algebra::Vec3;
use crate::numbers::lanes::InLanes;

pub use route::{Route, RouteReason};

/// A point or direction fixed in a body that a constraint speaks of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// Which of [`Constraint::arguments`] the body is.
    pub argument: usize,
    /// What it is, by its components in the body's frame.
    pub what: Attached,
}

/// A local point or direction; z is 0 in planar bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Attached {
    /// ū of `b.point(u)`.   \[m\]
    Point(Vec3),
    /// h̄ of `b.direction(h)`, of any length.   \[-\]
    Direction(Vec3),
}

/// What can be asked of a joint beside its equations: an angle, a slide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measured {
    /// Its name, such as `slide`.
    pub name: &'static str,
    /// Its unit, such as `m`.
    pub unit: &'static str,
    /// Whether it is an angle that is known up to whole turns, which a motion counts from one time to the
    /// next.
    pub turns: bool,
}

/// Which terms of C(q, t) can change or be other than zero, at any q, t and parameters: what a solver need
/// not ask for.
///
/// Facts known before the program runs. `true` promises nothing, so [`Dependence::default`] (all `true`) is
/// right for every constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dependence {
    /// C depends on t explicitly: its value can change with t at the same q.
    pub c_on_t: bool,
    /// C_q depends on t explicitly.
    pub c_q_on_t: bool,
    /// C_t can be other than zero; if not, [`Constraint::velocity_rhs`] writes zeros.
    pub c_t: bool,
    /// Q_d can be other than zero; if not, [`Constraint::acceleration_rhs`] writes zeros for every q̇ and ṫ.
    pub q_d: bool,
    /// C can be other than linear in the coordinates; if not, C(q, t) = C_q q + C(0, t) with a C_q that never
    /// changes.
    pub curved: bool,
}

impl Default for Dependence {
    /// Everything may depend on everything.
    fn default() -> Self {
        Dependence { c_on_t: true, c_q_on_t: true, c_t: true, q_d: true, curved: true }
    }
}

/// A copy of a constraint that is only known as a `Constraint`; each one that is `Clone` has it. A sweep over
/// many cases works on copies.
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
/// Columns are local: those of the first argument first (3 for a planar body, 7 for a spatial one, 1 for a
/// bare coordinate), the ground's counted too. Output slices have the lengths stated; a shorter one is left
/// as it is. Entries are in the unit of their row.
pub trait Constraint: CloneBoxed + Send + Sync {
    /// What kind of constraint this is: the name of its function, such as `revolute`.
    fn kind(&self) -> &str;

    /// How its derivatives are obtained.
    fn route(&self) -> Route;

    /// Why it takes that route; on the dual one where the token stands that the compiler cannot read.
    fn explain_route(&self) -> RouteReason {
        RouteReason::of(self.route())
    }

    /// Whether it is a driving constraint, one in which time appears (the function has a [`crate::Time`]
    /// argument). A hand-written constraint (default `false`) counts as one too where its value is seen to
    /// change with t alone.
    fn is_driver(&self) -> bool {
        false
    }

    /// The bodies and coordinates it acts on, in the order of its signature.
    fn arguments(&self) -> Vec<Argument>;

    /// Names of its rows, such as `["x", "y"]`; their number is m.
    fn rows(&self) -> &[&str];

    /// Structural non-zeros of C_q as (row, local column); [`Constraint::jacobian`] writes one value for
    /// each, in this order.
    fn pattern(&self) -> &[(usize, usize)];

    /// Which entries of the pattern are the same number at every q and t, whatever the parameters (most are 1
    /// or −1): the solver computes with them once. An empty list says nothing (default); what is not known is
    /// `None`.
    fn constants(&self) -> &[Option<f64>] {
        &[]
    }

    /// Which terms can change with t or be other than zero. The default promises nothing.
    fn depends(&self) -> Dependence {
        Dependence::default()
    }

    /// How many numbers that depend on t and parameters alone (a law's value and slopes, sin ω t) it wants to
    /// find in [`At::timed`]; default none.
    fn n_timed(&self) -> usize {
        0
    }

    /// These numbers at time t into `timed`; asked for once a time, before anything else.
    fn at_time(&self, t: f64, timed: &mut [f64]) {
        let _ = (t, timed);
    }

    /// Where among these numbers C(0, t), −C_t and −C_tt stand, m numbers each one after the other: with C_q
    /// they are all there is to a constraint which is linear in the coordinates for good
    /// ([`Dependence::curved`] is false). Who tells is not asked for them. Default: not told.
    fn sides_of_time(&self) -> Option<usize> {
        None
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

    /// r(q̇, ṫ) = −\[(C_q q̇)_q q̇ + 2 ṫ C_qt q̇ + ṫ² C_tt\] into `q_d` (length m); with ṫ = 1 the right side
    /// of C_q q̈ = Q_d.   \[row/s²\]
    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, t_dot: f64, q_d: &mut [f64]);

    /// −g‴(0) with g(s) = C(q + s q̇ + ½ s² q̈, t + s) into `rhs` (length m): the right side of C_q q⃛ =
    /// −g‴(0), for the jerk.   \[row/s³\]
    ///
    /// False, and nothing written, where that is not known (default): a run that is asked for the jerk then
    /// ends with an error by name.
    fn jerk_rhs(&self, at: &At<'_>, qd: &Rates<'_>, qdd: &Rates<'_>, rhs: &mut [f64]) -> bool {
        let mut known = false;
        self.formula(&mut |table, parameters, outside| {
            Along::new(&self.arguments(), at, [qd, qdd], parameters, outside).jerk_rhs(table.formula(), rhs);
            known = true;
        });
        known
    }

    /// Shows each numeric parameter with its name (`k`, `u_i.x`, `c[2]`).
    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        let _ = visit;
    }

    /// Sets one numeric parameter by the name [`Constraint::parameters`] gives it; false if there is none of
    /// that name.
    fn set_parameter(&mut self, name: &str, value: f64) -> bool {
        let _ = (name, value);
        false
    }

    /// Sets one numeric parameter by its number in the order of [`Constraint::parameters`]; false if there is
    /// none. The default goes by name; emitted constraints do not.
    fn set_parameter_at(&mut self, index: usize, value: f64) -> bool {
        let (mut number, mut wanted) = (0, None);
        self.parameters(&mut |name, _| {
            if number == index {
                wanted = Some(name.to_string());
            }
            number += 1;
        });
        wanted.is_some_and(|name| self.set_parameter(&name, value))
    }

    /// The same for kernels over lanes, if it has them (`#[constraint(lanes)]`): several mechanisms of a
    /// sweep advance together.
    fn in_lanes(&self) -> Option<&dyn InLanes> {
        None
    }

    /// What can be asked of it beside its equations (`#[measure(slide = …, "m")]`); default nothing.
    fn measures(&self) -> &[Measured] {
        &[]
    }

    /// Measure k of [`Constraint::measures`] with its first three derivatives along the rates q̇, q̈ and q⃛.
    fn measure(&self, k: usize, at: &At<'_>, rates: &[Rates<'_>; 3]) -> [f64; 4] {
        let _ = (k, at, rates);
        [f64::NAN; 4]
    }

    /// Where the range of measure k ends, if it does: the ends of a slot.
    fn ends(&self, k: usize) -> Option<[f64; 2]> {
        let _ = k;
        None
    }

    /// The points and directions of its bodies that its equation speaks of, `b.point(u)` and `b.direction(h)`
    /// with nothing that moves inside: for drawings and messages. Empty where that is not known (default).
    fn attachments(&self) -> Vec<Attachment> {
        Vec::new()
    }

    /// What it is, in the words of its documentation: a sentence with its equation, freedoms removed, signs.
    fn description(&self) -> &str {
        ""
    }

    /// Why its parameters make no sense, if so: a mechanism refuses the constraint with these words.
    fn refusal(&self) -> Option<String> {
        None
    }

    /// Whether [`Constraint::wrong_branch`] can have anything to say. `true` promises nothing (default).
    fn has_branches(&self) -> bool {
        true
    }

    /// Where C = 0 holds but not as it is meant, such as an axis turned by 180°: what is wrong. Looked at
    /// whenever a position has been found.
    fn wrong_branch(&self, at: &At<'_>) -> Option<&str> {
        let _ = at;
        None
    }

    /// Shows each law that the equation asks, with its name and where it is asked; on the dual route that is
    /// not known.
    fn laws(&self, at: &At<'_>, visit: &mut dyn FnMut(&str, &Law, f64)) {
        let _ = (at, visit);
    }

    /// Tells each parameter under its name, so that the constraint can be written as data and made anew;
    /// refuses where it cannot be (default).
    fn describe(&self, to: &mut Describer) {
        to.refuse("it was not made by `#[constraint]`, so its parameters are not known");
    }

    /// Why a term is not finite: the sub-expression that made it so, as the user wrote it. Asked only when a
    /// run has failed; `None` where that is not known (default).
    fn blame(&self, asked: &Asked<'_>) -> Option<Blame> {
        let mut found = None;
        self.formula(&mut |table, parameters, outside| found = table.blame(asked, parameters, outside));
        found
    }

    /// Shows its equation as a formula, with the values of its parameters and what computes the rest; nothing
    /// where there is none.
    #[doc(hidden)]
    fn formula(&self, with: &mut dyn FnMut(&'static Table, &[f64], Outside<'_>)) {
        if let Some((table, parameters)) = self.table() {
            with(table, &parameters, &|number, x, to| self.outside(number, x, to));
        }
    }

    /// Its formula and the values of its parameters. Emitted on the symbolic route; default none.
    #[doc(hidden)]
    fn table(&self) -> Option<(&'static Table, Vec<f64>)> {
        None
    }

    /// What the formula cannot say and only the user's program can compute, by its number; default nothing.
    /// Emitted with the formula.
    #[doc(hidden)]
    fn outside(&self, number: usize, x: &[Dual3_64], to: &mut Given) {
        let _ = (number, x, to);
    }
}
