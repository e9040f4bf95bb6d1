//! Items that ordinary programs do not call: for constraints and laws written by hand, for
//! comparing derivatives term by term, and for the code that `#[constraint]` emits.
//!
//! A constraint by hand is an `impl` of [`Constraint`](crate::Constraint); what it sees is in
//! [`state`], the bodies that it acts on in [`coordinates`]. A law by hand is an `impl` of
//! [`LawFunction`].

#[doc(inline)]
pub use crate::model::constraint::{
    Attached, Attachment, Dependence, Entry, Facts, Measured, Parameters, Parts, Route,
    RouteReason, Routed, Written,
};
#[doc(inline)]
pub use crate::model::coordinates::Target;
#[doc(inline)]
pub use crate::model::dual_route::by_dual;
#[doc(inline)]
pub use crate::model::law::LawFunction;
#[doc(inline)]
pub use crate::model::terms::{Moving, Terms, dual_terms, jerk_rhs, measure, terms};
#[doc(inline)]
pub use crate::numbers::enclosure::Series;
#[doc(inline)]
pub use crate::numbers::lanes::Lanes;
#[doc(inline)]
pub use crate::numbers::real::{Dual, Real};

/// Culprits where a term of a constraint is infinite or not a number.
pub mod blame {
    #[doc(inline)]
    pub use crate::model::blame::*;
}

/// Handles: what a mechanism gives out for its bodies and coordinates, and what constraints hold of
/// them.
pub mod coordinates {
    #[doc(inline)]
    pub use crate::model::coordinates::*;
}

/// The second route: a constraint's own equation, evaluated with dual numbers.
pub mod dual_route {
    #[doc(inline)]
    pub use crate::model::dual_route::*;
}

/// Numbers that carry derivatives.
pub mod real {
    #[doc(inline)]
    pub use crate::numbers::real::*;
}

/// The view of a constraint: the state of its arguments at one instant.
pub mod state {
    #[doc(inline)]
    pub use crate::model::state::*;
}
