//! Builds the error for an invalid dimension.

use crate::outcome::DimensionError;
use crate::outcome::error::Error;

impl DimensionError {
    pub(crate) fn invalid(name: &str, reason: impl Into<String>) -> Error {
        Box::new(DimensionError::Invalid { name: name.to_string(), reason: reason.into() }).into()
    }
}
