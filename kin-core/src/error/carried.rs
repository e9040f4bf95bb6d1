//! What errors of a failing run carry: the motion before it and what is wrong with the mechanism.

use super::Error;
use crate::diagnosis::{self, Diagnosis, DiagnosisOptions, Start};
use crate::motion::Motion;
use crate::newton::Options;
use crate::system::System;

impl Error {
    /// What a failing run had computed before it failed; `None` for errors of other operations.
    pub fn motion(&self) -> Option<&Motion> {
        match self {
            Error::NoConvergence { motion, .. }
            | Error::SingularAt { motion, .. }
            | Error::NotFinite { motion, .. }
            | Error::CannotBeDriven { motion, .. }
            | Error::WrongBranch { motion, .. }
            | Error::LawJumps { motion, .. }
            | Error::Toggle { motion, .. }
            | Error::CannotFollow { motion, .. } => motion.as_deref(),
            _ => None,
        }
    }

    /// What is wrong with the mechanism, by name, where the error is of that kind.
    pub fn diagnosis(&self) -> Option<&Diagnosis> {
        match self {
            Error::CannotBeDriven { diagnosis, .. } => Some(diagnosis),
            Error::SingularAt { diagnosis, .. } | Error::NoConvergence { diagnosis, .. } | Error::Toggle { diagnosis, .. } => {
                diagnosis.as_deref()
            }
            _ => None,
        }
    }

    /// The same error with what is wrong with the mechanism at that time, by name, as far as the size of the system allows to look for it.
    pub(crate) fn explained(mut self, system: &System, options: &Options) -> Error {
        /// Coordinates up to which a failing run is examined by itself; [`System::diagnose`] does it for any number.
        const EXAMINED: usize = 1500;
        if let Error::SingularAt { t, diagnosis, motion, .. }
        | Error::NoConvergence { t, diagnosis, motion, .. }
        | Error::Toggle { asked: t, diagnosis, motion, .. } = &mut self
            && system.n_coordinates() <= EXAMINED
        {
            let options = DiagnosisOptions { search: options.search.clone(), ..DiagnosisOptions::default() };
            let last = motion.as_ref().and_then(|motion| Some(motion.q(motion.len().checked_sub(1)?)));
            let start = last.map_or(Start::Guess(system.initial()), Start::Pose);
            *diagnosis = diagnosis::diagnose(system.model(), start, *t, &options).ok().map(Box::new);
        }
        self
    }

    /// The same error, carrying what was computed before.
    pub(crate) fn with_motion(mut self, computed: Motion) -> Error {
        if let Some(place) = self.carried().filter(|_| !computed.is_empty()) {
            *place = Some(Box::new(computed));
        }
        self
    }

    /// What was computed before, to be added to.
    pub(crate) fn motion_mut(&mut self) -> Option<&mut Motion> {
        self.carried()?.as_deref_mut()
    }

    fn carried(&mut self) -> Option<&mut Option<Box<Motion>>> {
        match self {
            Error::NoConvergence { motion, .. }
            | Error::SingularAt { motion, .. }
            | Error::NotFinite { motion, .. }
            | Error::CannotBeDriven { motion, .. }
            | Error::WrongBranch { motion, .. }
            | Error::LawJumps { motion, .. }
            | Error::Toggle { motion, .. }
            | Error::CannotFollow { motion, .. } => Some(motion),
            _ => None,
        }
    }
}

impl std::fmt::Debug for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        std::fmt::Display::fmt(self, f)
    }
}
