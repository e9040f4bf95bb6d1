//! Describes the routes to the derivatives of a constraint, and the reason for a route.

use std::fmt;

use super::Constraint;
use crate::outcome::culprit::Source;
pub use crate::outcome::mismatch::Route;

/// The reason why a constraint takes its route ([`crate::constraint::Facts::reason`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RouteReason {
    /// [`Route::Symbolic`]: the compiler reads the whole body.
    Read,
    /// [`Route::Symbolic`]: the compiler reads the body, except functions and constants that the
    /// program defines elsewhere. Kin evaluates these functions and their derivatives with dual
    /// numbers.
    ReadBut {
        /// Each function and constant, with its token.
        outside: &'static [(&'static str, Source)],
    },
    /// [`Route::Dual`]: the compiler cannot read something in the body.
    Unread {
        /// The construct that the compiler cannot read, such as `` `while` ``.
        what: &'static str,
        /// The token at which the construct begins.
        source: Source,
    },
    /// [`Route::Dual`]: the program selects this route.
    Asked {
        /// The word `dual` of `#[constraint(dual)]`; `None` if `by_dual` or a hand-written
        /// implementation selects the route.
        source: Option<Source>,
    },
    /// [`Route::Hand`]: an `impl Constraint` without the macro.
    Hand,
}

/// Returns the route of any constraint.
///
/// The prelude contains this trait.
pub trait Routed {
    /// Returns the route to the derivatives.
    fn route(&self) -> Route;

    /// Returns the reason for the route.
    ///
    /// On the dual route the reason names the token that the compiler cannot read.
    fn explain_route(&self) -> RouteReason;
}

impl<C: Constraint + ?Sized> Routed for C {
    fn route(&self) -> Route {
        self.facts().route()
    }

    fn explain_route(&self) -> RouteReason {
        self.facts().reason
    }
}

impl RouteReason {
    /// Returns the route that this reason explains.
    pub const fn route(self) -> Route {
        match self {
            RouteReason::Read | RouteReason::ReadBut { .. } => Route::Symbolic,
            RouteReason::Unread { .. } | RouteReason::Asked { .. } => Route::Dual,
            RouteReason::Hand => Route::Hand,
        }
    }
}

impl fmt::Display for RouteReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RouteReason::Read => f.write_str("symbolic: Kin has read the whole function"),
            RouteReason::ReadBut { outside } => {
                let one = |(name, source): &(&str, Source)| format!("`{name}` at {source}");
                let all: Vec<String> = outside.iter().map(one).collect();
                write!(
                    f,
                    "symbolic, except for functions that only rustc can read: {}",
                    all.join(", ")
                )
            }
            RouteReason::Unread { what, source } => {
                write!(f, "dual: Kin cannot read {what} at {source}")
            }
            RouteReason::Asked { source: Some(source) } => {
                write!(f, "dual: `#[constraint(dual)]` at {source} requests dual numbers")
            }
            RouteReason::Asked { source: None } => {
                f.write_str("dual: your code requests dual numbers")
            }
            RouteReason::Hand => {
                f.write_str("hand-written: an `impl Constraint` without the macro")
            }
        }
    }
}
