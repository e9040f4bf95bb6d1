//! Describes mistakes in dimensions.
//!
//! Each message names the dimension.

/// A dimension is invalid, unused or used in the wrong place.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DimensionError {
    /// No number of the mechanism depends on a declared dimension.
    #[error(
        "no number of the mechanism depends on the dimension `{name}`. Use the dimension in a link, a joint or a law, or remove it"
    )]
    Unused {
        /// The dimension.
        name: String,
    },

    /// A value, range or tolerance of a dimension is not finite or makes no sense.
    #[error("{}: {reason}", dimension(.name))]
    Invalid {
        /// The dimension.
        name: String,
        /// The mistake and its cure.
        reason: String,
    },

    /// A number depends on a dimension of another mechanism.
    #[error(
        "`{place}` has a dimension that does not belong to \"{mechanism}\". Use only dimensions that belong to \"{mechanism}\""
    )]
    Foreign {
        /// The mechanism that received the dimension.
        mechanism: String,
        /// The constraint or the operation.
        place: String,
    },
}

impl DimensionError {
    /// The name of all dimensions together, where no single one is at fault.
    pub(crate) const ALL: &'static str = "dimensions";
}

/// The beginning of a sentence about one dimension, or about all of them.
fn dimension(name: &str) -> String {
    if name == DimensionError::ALL {
        "a tolerance of the dimensions".to_string()
    } else {
        format!("the dimension `{name}`")
    }
}
