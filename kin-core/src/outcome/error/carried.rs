//! Returns the data that an error of a run carries: the kind of the failure, the motion before the
//! failure and the diagnosis of the mechanism.

use super::{Error, FailureKind, RunFailure};
use crate::outcome::motion::Motion;
use crate::outcome::verdict::Diagnosis;

/// `Result` with Kin's [`Error`].
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// Returns the failure of a run or of a single position; `None` for the errors of other
    /// operations.
    pub fn failure(&self) -> Option<&RunFailure> {
        match self {
            Error::Run(failure) => Some(failure),
            _ => None,
        }
    }

    /// Returns the kind of a failure of a run or of a single position; `None` for the errors of
    /// other operations.
    pub fn kind(&self) -> Option<&FailureKind> {
        self.failure().map(|failure| &failure.kind)
    }

    /// Returns the motion that a failing run had computed, or the configuration where a follower
    /// stopped; `None` for the errors of other operations.
    pub fn motion(&self) -> Option<&Motion> {
        match self {
            Error::Run(failure) => failure.motion.as_ref(),
            Error::Stopped { motion, .. } => motion.as_deref(),
            Error::CannotReach(stop) => Some(&stop.motion),
            _ => None,
        }
    }

    /// Returns the motion that a failing run had computed, without a copy; `None` as for
    /// [`Error::motion`].
    pub fn into_motion(self) -> Option<Motion> {
        match self {
            Error::Run(failure) => failure.motion,
            Error::Stopped { motion, .. } => motion.map(|motion| *motion),
            Error::CannotReach(stop) => Some(stop.motion),
            _ => None,
        }
    }

    /// Returns the diagnosis of the mechanism, if the error carries one.
    pub fn diagnosis(&self) -> Option<&Diagnosis> {
        self.failure()?.diagnosis.as_ref()
    }

    /// Adds the computed motion to the error.
    pub(crate) fn with_motion(mut self, computed: Motion) -> Error {
        match &mut self {
            _ if computed.is_empty() => {}
            Error::Run(failure) => failure.motion = Some(computed),
            Error::Stopped { motion, .. } => *motion = Some(Box::new(computed)),
            _ => {}
        }
        self
    }

    /// Returns the motion before the failure, mutable.
    pub(crate) fn motion_mut(&mut self) -> Option<&mut Motion> {
        match self {
            Error::Run(failure) => failure.motion.as_mut(),
            Error::Stopped { motion, .. } => motion.as_deref_mut(),
            _ => None,
        }
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
