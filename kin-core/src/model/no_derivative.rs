//! Why there is no derivative by a parameter.

use crate::model::error::Error;

/// A derivative by a parameter that does not exist, or is not known.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no derivative by `{by}`: {reason}")]
#[non_exhaustive]
pub struct NoDerivative {
    /// The parameter, such as `coupler.length`.
    pub by: String,
    /// Why, and what to ask instead.
    pub reason: String,
}

impl NoDerivative {
    /// The error for one parameter.
    pub(crate) fn error(by: &str, reason: impl Into<String>) -> Error {
        Box::new(NoDerivative { by: by.to_string(), reason: reason.into() }).into()
    }
}
