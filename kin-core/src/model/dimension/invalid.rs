//! The error for a dimension that makes no sense, as calls give it.

use super::DimensionError;
use crate::model::error::Error;

impl DimensionError {
    pub(crate) fn invalid(name: &str, reason: impl Into<String>) -> Error {
        Box::new(DimensionError::Invalid { name: name.to_string(), reason: reason.into() }).into()
    }
}
