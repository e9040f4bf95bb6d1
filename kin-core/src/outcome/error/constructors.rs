//! Builds errors whose data have a type of their own.

use super::{Error, FailureKind, RunFailure};
use crate::coordinates::layout::{Layout, Undeclared};
use crate::outcome::no_derivative::NoDerivative;
use crate::outcome::not_unique::NotUnique;
use crate::outcome::verdict::Diagnosis;

impl Error {
    /// Builds the error for a mechanism that nothing can drive.
    pub(crate) fn cannot_be_driven(diagnosis: Diagnosis) -> Error {
        let t = diagnosis.t;
        let units = diagnosis.units.clone();
        let kind = FailureKind::CannotBeDriven;
        Error::Run(Box::new(RunFailure {
            t,
            units,
            kind,
            motion: None,
            diagnosis: Some(diagnosis),
        }))
    }

    /// Builds the error for a parameter without a known derivative.
    pub(crate) fn no_derivative(by: &str, reason: impl Into<String>) -> Error {
        Box::new(NoDerivative { by: by.to_string(), reason: reason.into() }).into()
    }

    /// Builds the error for a force that is not unique.
    pub(crate) fn not_unique(constraint: &str, what: &str, shared: Vec<String>) -> Error {
        let constraint = constraint.to_string();
        Box::new(NotUnique { constraint, what: what.to_string(), shared }).into()
    }

    /// Builds the error for a value of coordinate `column` that is not finite.
    pub(crate) fn initial_not_finite(layout: &Layout, column: usize, value: f64) -> Error {
        let name = layout.owner(column).map(|item| item.name.clone()).unwrap_or_default();
        let coordinate = layout.names.get(column).cloned().unwrap_or_default();
        Error::InitialNotFinite { name, coordinate, value }
    }
}

impl From<Undeclared> for Error {
    fn from(why: Undeclared) -> Error {
        match why {
            Undeclared::Empty(kind) => Error::EmptyName { what: kind.noun() },
            Undeclared::Taken(name) => Error::DuplicateName { what: "bodies or coordinates", name },
        }
    }
}
