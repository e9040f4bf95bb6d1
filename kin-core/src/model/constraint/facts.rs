//! Describes the facts of a constraint that hold for all parameters and are known before the
//! program runs.

#[cfg(doc)]
use super::{At, Constraint};
use super::{Measured, Route, RouteReason};

/// A structurally nonzero entry of C_q.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Entry {
    /// The local row.
    pub row: usize,
    /// The local column.
    pub column: usize,
}

impl Entry {
    /// Creates the entry in a row and a column.
    pub const fn new(row: usize, column: usize) -> Self {
        Entry { row, column }
    }
}

/// Says which terms of C(q, t) can change or be nonzero, for any q, t and parameters.
///
/// The solver skips the other terms.
///
/// The value `true` promises nothing, so [`Dependence::ANY`] (all `true`) is correct for every
/// constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dependence {
    /// True if C depends on t explicitly: C can change with t at the same q.
    pub c_on_t: bool,
    /// True if C_q depends on t explicitly.
    pub c_q_on_t: bool,
    /// True if C_t can be nonzero. If false, [`Constraint::velocity_rhs`] writes zeros.
    pub c_t: bool,
    /// True if Q_d can be nonzero. If false, [`Constraint::acceleration_rhs`] writes zeros for
    /// every q̇ and ṫ.
    pub q_d: bool,
    /// True if C can be nonlinear in the coordinates. If false, C(q, t) = C_q q + C(0, t) with a
    /// constant C_q.
    pub curved: bool,
}

impl Dependence {
    /// Promises nothing about the terms: every term may change.
    pub const ANY: Dependence =
        Dependence { c_on_t: true, c_q_on_t: true, c_t: true, q_d: true, curved: true };
}

impl Default for Dependence {
    /// Promises nothing about the terms: every term may change.
    fn default() -> Self {
        Dependence::ANY
    }
}

/// The fixed facts of a constraint: its names, the shape of its terms, and promises about them.
///
/// A hand-written constraint starts from [`Facts::of`], which promises nothing:
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
    /// The documentation of the constraint: a sentence with the equation, the removed freedoms, and
    /// the signs.
    pub description: &'a str,
    /// The route to the derivatives, and the reason for the route. On the dual route the reason
    /// names the token that the compiler cannot read.
    pub reason: RouteReason,
    /// True for a driver: a constraint whose function has a [`crate::Time`] argument. Kin also
    /// treats a hand-written constraint as a driver if its value changes with t alone.
    pub is_driver: bool,
    /// The names of the m rows, such as `["x", "y"]`.
    pub rows: &'a [&'a str],
    /// The structurally nonzero entries of C_q. [`Constraint::jacobian`] writes one value for each
    /// entry, in the order of the list.
    pub pattern: &'a [Entry],
    /// For each entry of the pattern, its value if the entry is constant for all q, t and
    /// parameters (mostly 1 or −1), otherwise `None`. The solver writes constant entries only once.
    /// An empty list means that no entry is known to be constant.
    pub constants: &'a [Option<f64>],
    /// The terms that can change with t or be nonzero.
    pub dependence: Dependence,
    /// The number of values in [`At::timed`] that depend only on t and parameters, such as the
    /// value and slopes of a law, or sin ω t.
    pub n_timed: usize,
    /// The index in [`At::timed`] at which C(0, t), −C_t and −C_tt begin, with m numbers each;
    /// `None` for a constraint that is nonlinear in the coordinates. Together with C_q these
    /// numbers determine a constraint that is linear in the coordinates ([`Dependence::curved`] is
    /// false). The solver does not evaluate the terms of a linear constraint.
    pub sides_of_time: Option<usize>,
    /// The measures of the joint besides its equations (`#[measure(slide = …, "m")]`).
    pub measures: &'a [Measured],
    /// False if [`Constraint::wrong_branch`] always returns `None`. `true` promises nothing.
    pub has_branches: bool,
    /// True for an energy, a function with `#[potential]`. An energy acts as a load and constrains
    /// no coordinate.
    pub is_energy: bool,
}

impl<'a> Facts<'a> {
    /// Returns the facts of a hand-written constraint of this kind that promises nothing.
    ///
    /// The lists of rows and of pattern entries are empty.
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

    /// Returns the route to the derivatives.
    pub const fn route(&self) -> Route {
        self.reason.route()
    }
}
