//! Makes the diagnosis that the error of a failed run carries.

use super::{Diagnosis, diagnose};
use crate::outcome::error::{Error, FailureKind, RunFailure};
use crate::solve::explain::{Explain, Start};
use crate::solve::options::SolverOptions;
use crate::system::System;
use crate::system::scaled::{Model, Work};

/// The largest number of coordinates for which a failed run makes a diagnosis. [`System::diagnose`]
/// accepts any number.
const EXAMINED: usize = 1500;

/// The functions that explain a failed run by its diagnosis.
pub(crate) const EXPLAIN: Explain = Explain { cannot_be_driven, explained };

/// The number of values of C_q that the diagnosis of a failed run may compute and factor: a few
/// seconds of work.
const WORK: f64 = 2e8;

fn cannot_be_driven(model: Model<'_>, start: Start<'_>, t: f64, options: &SolverOptions) -> Error {
    let work = Work::new(WORK * options.effort);
    let found = diagnose(Model { work: Some(&work), ..model }, start, t, &options.search);
    match found {
        // An unfinished search reports nothing.
        Ok(_) if work.is_spent() => unsolved(model, start, t, None),
        // An error never carries a diagnosis without a fault.
        Ok(diagnosis) if diagnosis.can_be_driven() => unsolved(model, start, t, Some(diagnosis)),
        Ok(diagnosis) => Error::cannot_be_driven(diagnosis),
        Err(error) => error,
    }
}

/// Builds the error for a position that the solver did not find although the diagnosis sees no
/// fault.
fn unsolved(model: Model<'_>, start: Start<'_>, t: f64, diagnosis: Option<Diagnosis>) -> Error {
    let (Start::Guess(q) | Start::Pose(q)) = start;
    let c = model.linearize(q, t).map(|point| point.c).unwrap_or_default();
    let rows = c.iter().map(|c| c.abs()).enumerate();
    let (worst, residual) =
        rows.fold((0, 0.0), |worst, row| if row.1 > worst.1 { row } else { worst });
    let block = model.equations.block_of(worst);
    let (constraint, row) = block
        .map(|(block, local)| (block.name.clone(), block.row(local).to_string()))
        .unwrap_or_default();
    let kind = FailureKind::NoConvergence { iterations: 0, constraint, row, residual, last: None };
    let units = model.layout.words.clone();
    Error::Run(Box::new(RunFailure { t, units, kind, motion: None, diagnosis }))
}

pub(crate) fn explained(mut error: Error, system: &System, options: &SolverOptions) -> Error {
    if let Error::Run(failure) = &mut error
        && let Some(t) = failure.unreached()
        && system.n_coordinates() <= EXAMINED
    {
        let last =
            failure.motion.as_ref().and_then(|motion| Some(motion.q(motion.len().checked_sub(1)?)));
        let start = last.map_or(Start::Guess(system.initial()), Start::Pose);
        let work = Work::new(WORK * options.effort);
        let model = Model { work: Some(&work), ..system.model() };
        let found = diagnose(model, start, t, &options.search);
        // Of a search that was not brought to its end nothing is reported.
        failure.diagnosis = found.ok().filter(|_| !work.is_spent());
    }
    error
}
