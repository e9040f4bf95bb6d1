//! The error for a parameter without a known derivative.

/// Kin cannot differentiate by a parameter: the parameter does not exist, or its derivative is
/// unknown.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("Kin cannot compute a derivative by `{by}`: {reason}")]
#[non_exhaustive]
pub struct NoDerivative {
    /// The parameter, such as `coupler.length`.
    pub by: String,
    /// The reason, and an alternative.
    pub reason: String,
}
