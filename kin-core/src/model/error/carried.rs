//! The data that errors of a failing run carry: the motion before it and the diagnosis of the
//! mechanism.

use super::Error;
use crate::model::motion::Motion;
use crate::model::verdict::Diagnosis;

/// `Result` with Kin's [`Error`].
pub type Result<T> = std::result::Result<T, Error>;

/// The motion that an error carries, shared or mutable as the error is; `None` where it carries
/// none.
macro_rules! carried {
    ($error:expr) => {
        match $error {
            Error::NoConvergence { motion, .. }
            | Error::SingularAt { motion, .. }
            | Error::NotFinite { motion, .. }
            | Error::CannotBeDriven { motion, .. }
            | Error::WrongBranch { motion, .. }
            | Error::LawJumps { motion, .. }
            | Error::Toggle { motion, .. }
            | Error::CannotFollow { motion, .. }
            | Error::Stopped { motion, .. } => Some(motion),
            _ => None,
        }
    };
}

impl Error {
    /// The part of the motion that a failing run had computed; `None` for errors of other
    /// operations.
    pub fn motion(&self) -> Option<&Motion> {
        carried!(self)?.as_deref()
    }

    /// The diagnosis of the mechanism, by name, where the error is of that kind.
    pub fn diagnosis(&self) -> Option<&Diagnosis> {
        match self {
            Error::CannotBeDriven { diagnosis, .. } => Some(diagnosis),
            Error::SingularAt { diagnosis, .. }
            | Error::NoConvergence { diagnosis, .. }
            | Error::Toggle { diagnosis, .. } => diagnosis.as_deref(),
            _ => None,
        }
    }

    /// The same error, carrying what was computed before.
    pub(crate) fn with_motion(mut self, computed: Motion) -> Error {
        if let Some(place) = carried!(&mut self).filter(|_| !computed.is_empty()) {
            *place = Some(Box::new(computed));
        }
        self
    }

    /// The motion computed before the failure, to be added to.
    pub(crate) fn motion_mut(&mut self) -> Option<&mut Motion> {
        carried!(self)?.as_deref_mut()
    }
}

impl std::fmt::Debug for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        std::fmt::Display::fmt(self, f)
    }
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
