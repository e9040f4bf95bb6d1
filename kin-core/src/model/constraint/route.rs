//! The two routes to the derivatives of a constraint, and the reason for the one that is taken.

use std::fmt;

use super::Constraint;
use crate::model::blame::Source;

/// The way in which the derivatives of a constraint are obtained.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Route {
    /// Straight-line code, differentiated at compile time by `#[constraint]`.
    Symbolic,
    /// The constraint's own equation evaluated with dual numbers.
    Dual,
    /// Written by hand: an `impl Constraint` without the macro.
    Hand,
}

impl fmt::Display for Route {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Route::Symbolic => "symbolic",
            Route::Dual => "dual",
            Route::Hand => "hand-written",
        })
    }
}

/// The reason why a constraint takes its route, [`crate::constraint::Facts::reason`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RouteReason {
    /// [`Route::Symbolic`]: the compiler has read the whole body.
    Read,
    /// [`Route::Symbolic`]: the compiler has read the body but for what stands outside of it: the
    /// program's own functions, whose values and derivatives come from dual numbers, and its
    /// constants.
    ReadBut {
        /// Each function and constant with the token where it stands.
        outside: &'static [(&'static str, Source)],
    },
    /// [`Route::Dual`]: something in the body cannot be read by the compiler.
    Unread {
        /// The construct that cannot be read, such as `` `while` ``.
        what: &'static str,
        /// The token where it begins.
        source: Source,
    },
    /// [`Route::Dual`]: the program asks for it.
    Asked {
        /// The word `dual` of `#[constraint(dual)]`; `None` where `by_dual` asks, or an
        /// implementation by hand.
        source: Option<Source>,
    },
    /// [`Route::Hand`]: an `impl Constraint` without the macro.
    Hand,
}

/// The route of any constraint, in short; the prelude has it.
pub trait Routed {
    /// How its derivatives are obtained.
    fn route(&self) -> Route;

    /// Why it takes that route; on the dual one where the token stands that the compiler cannot
    /// read.
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
    /// The route that it is the reason for.
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
            RouteReason::Read => f.write_str("symbolic: the compiler has read the whole body"),
            RouteReason::ReadBut { outside } => {
                let one = |(name, source): &(&str, Source)| format!("`{name}` at {source}");
                let all: Vec<String> = outside.iter().map(one).collect();
                write!(f, "symbolic, but for what only the program knows: {}", all.join(", "))
            }
            RouteReason::Unread { what, source } => {
                write!(f, "dual: {what} at {source} cannot be read by the compiler")
            }
            RouteReason::Asked { source: Some(source) } => {
                write!(f, "dual: `#[constraint(dual)]` asks for it at {source}")
            }
            RouteReason::Asked { source: None } => f.write_str("dual: the program asks for it"),
            RouteReason::Hand => {
                f.write_str("hand-written: an `impl Constraint` without the macro")
            }
        }
    }
}
