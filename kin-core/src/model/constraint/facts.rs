//! Facts of a constraint that hold before the program runs, whatever its parameters, in one
//! description.

#[cfg(doc)]
use super::{At, Constraint};
use super::{Measured, Route, RouteReason};

/// A structural non-zero of C_q.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Entry {
    /// Local row.
    pub row: usize,
    /// Local column.
    pub column: usize,
}

impl Entry {
    /// The entry in a row and a column.
    pub const fn new(row: usize, column: usize) -> Self {
        Entry { row, column }
    }
}

/// Which terms of C(q, t) can change or be other than zero, at any q, t and parameters: what a
/// solver need not ask for.
///
/// Facts known before the program runs. `true` promises nothing, so [`Dependence::ANY`] (all
/// `true`) is right for every constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dependence {
    /// C depends on t explicitly: its value can change with t at the same q.
    pub c_on_t: bool,
    /// C_q depends on t explicitly.
    pub c_q_on_t: bool,
    /// C_t can be other than zero; if not, [`Constraint::velocity_rhs`] writes zeros.
    pub c_t: bool,
    /// Q_d can be other than zero; if not, [`Constraint::acceleration_rhs`] writes zeros for every
    /// q̇ and ṫ.
    pub q_d: bool,
    /// C can be other than linear in the coordinates; if not, C(q, t) = C_q q + C(0, t) with a C_q
    /// that never changes.
    pub curved: bool,
}

impl Dependence {
    /// Everything may depend on everything.
    pub const ANY: Dependence =
        Dependence { c_on_t: true, c_q_on_t: true, c_t: true, q_d: true, curved: true };
}

impl Default for Dependence {
    /// Everything may depend on everything.
    fn default() -> Self {
        Dependence::ANY
    }
}

/// The fixed facts about a constraint: its names, the shape of its terms, and promises about them.
///
/// By hand it starts from [`Facts::of`], which promises nothing:
///
/// ```
/// use kin::extend::{Entry, Facts};
///
/// const FACTS: Facts<'static> = Facts {
///     rows: &["height"],
///     pattern: &[Entry::new(0, 1), Entry::new(0, 2)],
///     ..Facts::of("pin_height")
/// };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts<'a> {
    /// The kind of the constraint: the name of its function, such as `revolute`.
    pub kind: &'a str,
    /// Its meaning, in the words of its documentation: a sentence with its equation, freedoms
    /// removed, signs.
    pub description: &'a str,
    /// How its derivatives are obtained and why so; on the dual route with the token that the
    /// compiler cannot read.
    pub reason: RouteReason,
    /// True of a driving constraint, one in which time appears (the function has a [`crate::Time`]
    /// argument). A hand-written constraint counts as one too where its value is seen to change
    /// with t alone.
    pub is_driver: bool,
    /// Names of its rows, such as `["x", "y"]`; their number is m.
    pub rows: &'a [&'a str],
    /// Structural non-zeros of C_q; [`Constraint::jacobian`] writes one value for each, in this
    /// order.
    pub pattern: &'a [Entry],
    /// The entries of the pattern that are the same number at every q and t, whatever the
    /// parameters (most are 1 or −1): the solver computes with them once. An empty list says
    /// nothing; what is not known is `None`.
    pub constants: &'a [Option<f64>],
    /// The terms that can change with t or be other than zero.
    pub dependence: Dependence,
    /// How many numbers that depend on t and parameters alone (a law's value and slopes, sin ω t)
    /// it wants to find in [`At::timed`].
    pub n_timed: usize,
    /// Where among these numbers C(0, t), −C_t and −C_tt stand, m numbers each one after the other:
    /// with C_q they are all there is to a constraint which is linear in the coordinates for good
    /// ([`Dependence::curved`] is false). A constraint that tells them is not asked for its terms.
    pub sides_of_time: Option<usize>,
    /// The measures that can be asked of it beside its equations (`#[measure(slide = …, "m")]`).
    pub measures: &'a [Measured],
    /// False if [`Constraint::wrong_branch`] never has anything to say. `true` promises nothing.
    pub has_branches: bool,
    /// True of an energy, a function under `#[potential]`: it acts as a load and holds nothing.
    pub is_energy: bool,
}

impl<'a> Facts<'a> {
    /// The facts of a constraint of this kind that is written by hand and promises nothing; its
    /// rows and its pattern are still empty.
    pub const fn of(kind: &'a str) -> Self {
        Facts {
            kind,
            description: "",
            reason: RouteReason::Hand,
            is_driver: false,
            rows: &[],
            pattern: &[],
            constants: &[],
            dependence: Dependence::ANY,
            n_timed: 0,
            sides_of_time: None,
            measures: &[],
            has_branches: true,
            is_energy: false,
        }
    }

    /// How its derivatives are obtained.
    pub const fn route(&self) -> Route {
        self.reason.route()
    }
}
