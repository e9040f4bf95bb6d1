//! Returns the data that an error of a run carries: the motion before the failure and the diagnosis
//! of the mechanism.

use super::Error;
use crate::outcome::motion::Motion;
use crate::outcome::verdict::Diagnosis;

/// `Result` with Kin's [`Error`].
pub type Result<T> = std::result::Result<T, Error>;

/// Selects the motion that an error carries, shared or mutable like the error; `None` if it carries
/// no motion.
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
    /// Returns the motion that a failing run had computed, or the configuration where a follower
    /// stopped; `None` for the errors of other operations.
    pub fn motion(&self) -> Option<&Motion> {
        if let Error::CannotReach(stop) = self {
            return Some(&stop.motion);
        }
        carried!(self)?.as_deref()
    }

    /// Returns the diagnosis of the mechanism, if the error carries one.
    pub fn diagnosis(&self) -> Option<&Diagnosis> {
        match self {
            Error::CannotBeDriven { diagnosis, .. } => Some(diagnosis),
            Error::SingularAt { diagnosis, .. }
            | Error::NoConvergence { diagnosis, .. }
            | Error::Toggle { diagnosis, .. } => diagnosis.as_deref(),
            _ => None,
        }
    }

    /// Adds the computed motion to the error.
    pub(crate) fn with_motion(mut self, computed: Motion) -> Error {
        if let Some(place) = carried!(&mut self).filter(|_| !computed.is_empty()) {
            *place = Some(Box::new(computed));
        }
        self
    }

    /// Returns the motion before the failure, mutable.
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
