//! Computes all times of a run, with the compiled program or with the step-by-step solver.

use crate::outcome::error::Result;
use crate::solve::compiled::Computing;
use crate::solve::explain::Explain;
use crate::solve::first_run;
use crate::solve::motion::Motion;
use crate::solve::options::SolverOptions;
use crate::solve::run::{Progress, Run, times};
use crate::system::System;

/// Computes position, velocity and acceleration at each of the times.
pub(crate) fn run<'a>(
    system: &'a System,
    times: &[f64],
    options: &'a SolverOptions,
    explain: Option<Explain>,
    progress: Option<Progress<'a>>,
) -> Result<Motion> {
    times::check(times)?;
    options.check_memory(1, times.len(), system.n_coordinates())?;
    let computing = Computing::new(system, times.len(), options)?;
    let mut run = Run::new(system, options, explain)?.watched(progress, times.len());
    let mut found = all(&mut run, times, computing);
    first_run::note_result(system, &mut found, run.first_pivot());
    found
}

/// Runs with a given engine, over times that were checked.
pub(crate) fn run_by<'a>(
    system: &'a System,
    times: &[f64],
    (options, explain): (&'a SolverOptions, Option<Explain>),
    computing: Computing,
) -> Result<Motion> {
    let mut found = all(&mut Run::new(system, options, explain)?, times, computing);
    if let Ok(motion) = &mut found {
        motion.guess = system.initial().to_vec();
        // Nobody has looked: an angle far from its guess may have been turned to.
        motion.turned_before = true;
    }
    found
}

/// Returns the motion at all of these times.
fn all(run: &mut Run<'_>, times: &[f64], mut computing: Computing) -> Result<Motion> {
    let mut motion = Motion::new(run.system(), times.len());
    match computing.run(run, times, &mut motion) {
        Ok(()) => Ok(motion),
        Err(error) => Err(run.failed(error, motion)),
    }
}
