//! The diagnosis that the error of a failed run carries.

use super::{DiagnosisOptions, diagnose};
use crate::model::error::Error;
use crate::solve::explain::{Explain, Start};
use crate::solve::newton::Options;
use crate::system::System;
use crate::system::scaled::Model;

/// Coordinates up to which a failing run is examined by itself; [`System::diagnose`] does it for any number.
const EXAMINED: usize = 1500;

/// The functions that explain a failed run by its diagnosis.
pub(crate) const EXPLAIN: Explain = Explain { cannot_be_driven, explained };

fn cannot_be_driven(model: Model<'_>, start: Start<'_>, t: f64, options: &Options) -> Error {
    match diagnose(model, start, t, &DiagnosisOptions::searching(&options.search)) {
        Ok(diagnosis) => Error::CannotBeDriven { diagnosis: Box::new(diagnosis), motion: None },
        Err(error) => error,
    }
}

pub(crate) fn explained(mut error: Error, system: &System, options: &Options) -> Error {
    if let Error::SingularAt { t, diagnosis, motion, .. }
    | Error::NoConvergence { t, diagnosis, motion, .. }
    | Error::Toggle { asked: t, diagnosis, motion, .. } = &mut error
        && system.n_coordinates() <= EXAMINED
    {
        let last = motion.as_ref().and_then(|motion| Some(motion.q(motion.len().checked_sub(1)?)));
        let start = last.map_or(Start::Guess(system.initial()), Start::Pose);
        let found = diagnose(system.model(), start, *t, &DiagnosisOptions::searching(&options.search));
        *diagnosis = found.ok().map(Box::new);
    }
    error
}
