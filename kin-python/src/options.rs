//! SolverOptions of a run from Python's keywords.

use std::time::Duration;

use kin::solver::{AssemblyOptions, Stop};
use kin::{Engine, Follow, SolverOptions};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::fault::{value, wrong_type};

/// The options that keywords say; what they do not say is the default.
///
/// Errors: a keyword that nothing has, a value of another type.
pub fn options(given: Option<&Bound<'_, PyDict>>) -> PyResult<SolverOptions> {
    let mut options = SolverOptions::default();
    for (name, value) in given.into_iter().flatten() {
        put(&mut options, &name.extract::<String>()?, &value)?;
    }
    Ok(options)
}

/// How assemblies are looked for, from keywords as well.
pub fn assembly_options(given: &Bound<'_, PyDict>) -> PyResult<AssemblyOptions> {
    let mut options = AssemblyOptions::default();
    for (name, given) in given {
        let seconds = |given: f64| {
            Duration::try_from_secs_f64(given).map_err(|_| value("time_limit: seconds"))
        };
        match name.extract::<String>()?.as_str() {
            "starts" => options.starts = given.extract()?,
            "patience" => options.patience = given.extract()?,
            "steps" => options.steps = given.extract()?,
            "seed" => options.seed = given.extract()?,
            "time_limit" => options.time_limit = Some(seconds(given.extract()?)?),
            name => {
                let known = "starts, patience, steps, seed, time_limit";
                return Err(wrong_type(format!("there is no option `{name}`. Use one of {known}")));
            }
        }
    }
    Ok(options)
}

const KNOWN: &str = "max_iterations, tolerance, residual_only, predict, rescue, halvings, jerk, allowed_misfit, follow, \
                     other_branch_at, engine, memory, effort";

fn put(options: &mut SolverOptions, name: &str, given: &Bound<'_, PyAny>) -> PyResult<()> {
    match name {
        "max_iterations" => options.max_iterations = given.extract()?,
        "tolerance" => options.stop = Stop::Converged { tolerance: given.extract()? },
        "residual_only" => options.stop = Stop::ResidualOnly(given.extract()?),
        "predict" => options.predict = given.extract()?,
        "rescue" => options.rescue = given.extract()?,
        "halvings" => options.halvings = given.extract()?,
        "jerk" => options.jerk = given.extract()?,
        "allowed_misfit" => options.allowed_misfit = given.extract()?,
        "memory" => options.memory = given.extract()?,
        "effort" => options.effort = given.extract()?,
        "other_branch_at" => options.follow = Follow::OtherBranchAt(given.extract()?),
        "follow" => {
            options.follow = match given.extract::<String>()?.as_str() {
                "unchecked" => Follow::Unchecked,
                "smooth" => Follow::Smooth,
                other => {
                    return Err(value(format!(
                        "follow: \"unchecked\" or \"smooth\", not {other:?}"
                    )));
                }
            }
        }
        "engine" => options.engine = engine_named(&given.extract::<String>()?)?,
        _ => return Err(wrong_type(format!("there is no option `{name}`. Use one of {KNOWN}"))),
    }
    Ok(())
}

/// The engine of this name.
pub fn engine_named(name: &str) -> PyResult<Engine> {
    match name {
        "auto" => Ok(Engine::Auto),
        "step-by-step" => Ok(Engine::StepByStep),
        "compiled" => Ok(Engine::Compiled),
        other => {
            Err(value(format!("engine: \"auto\", \"step-by-step\" or \"compiled\", not {other:?}")))
        }
    }
}
