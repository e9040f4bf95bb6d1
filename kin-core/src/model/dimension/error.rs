//! Mistakes in dimensions. Each message names the dimension.

/// A dimension that is invalid, unused or used in the wrong place.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DimensionError {
    /// A dimension on which no number of the mechanism depends.
    #[error(
        "nothing hangs on the dimension `{name}`: give it, or an expression of it, to a link, a joint or a law, or leave it out"
    )]
    Unused {
        /// The dimension.
        name: String,
    },

    /// A value, range or tolerance that is not finite or contradicts itself.
    #[error("the dimension `{name}`: {reason}")]
    Invalid {
        /// The dimension.
        name: String,
        /// The mistake and its cure.
        reason: String,
    },

    /// A dimension of another mechanism.
    #[error(
        "`{place}`: a dimension of another mechanism than \"{mechanism}\", or of several; use what its own \
         `dimension` gave out"
    )]
    Foreign {
        /// The mechanism that received the dimension.
        mechanism: String,
        /// The constraint or the operation.
        place: String,
    },
}
