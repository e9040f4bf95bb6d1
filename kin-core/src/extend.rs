//! Items for hand-written constraints and laws, which ordinary programs do not call.
//!
//! Code that compares derivatives term by term, and the code that `#[constraint]` emits, also use
//! this module.
//!
//! A hand-written constraint is an `impl` of [`Constraint`](crate::Constraint). [`state`] describes
//! the values that a constraint reads, and [`coordinates`] describes the bodies on which a
//! constraint acts. A hand-written law is an `impl` of [`LawFunction`].

#[doc(inline)]
pub use crate::coordinates::Target;
#[doc(inline)]
pub use crate::law::LawFunction;
#[doc(inline)]
pub use crate::model::constraint::{
    Attached, Attachment, Dependence, Entry, Facts, Measured, Parameters, Parts, Route,
    RouteReason, Routed, Written,
};
#[doc(inline)]
pub use crate::model::dual_route::by_dual;
#[doc(inline)]
pub use crate::model::terms::{Moving, Terms, dual_terms, jerk_rhs, measure, terms};
#[doc(inline)]
pub use crate::numbers::enclosure::Series;
#[doc(inline)]
pub use crate::numbers::lanes::Lanes;
#[doc(inline)]
pub use crate::numbers::real::{Dual, Real};

/// Finds the expressions and parameters that make a term of a constraint infinite or not a number.
pub mod blame {
    #[doc(inline)]
    pub use crate::model::blame::*;
}

/// Handles that a mechanism returns for its bodies and coordinates, and the arguments that
/// constraints store.
pub mod coordinates {
    #[doc(inline)]
    pub use crate::coordinates::*;
    #[doc(inline)]
    pub use crate::dimensions::IntoAxis;
}

/// Evaluates the equation of a constraint with dual numbers: the dual route.
pub mod dual_route {
    #[doc(inline)]
    pub use crate::model::dual_route::*;
}

/// Numbers that carry derivatives.
pub mod real {
    #[doc(inline)]
    pub use crate::numbers::real::*;
}

/// The state of the arguments of a constraint at one instant.
pub mod state {
    #[doc(inline)]
    pub use crate::model::state::*;
}
