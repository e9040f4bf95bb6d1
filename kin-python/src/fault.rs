//! Kin's errors as Python's exceptions: the same words, the fields by name, the motion before.

use kin::Error;
use kin::error::{DimensionError, FailureKind, Jammed, RunFailure};
use kin::solver::NamedValue;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::motion::Motion;

/// The exception that an error becomes: a class of `kin` with the name of the variant.
pub fn raised(py: Python<'_>, error: Error) -> PyErr {
    let text = error.to_string();
    let (kind, fields) = facts(&error);
    let motion = error.motion().cloned().map(Motion::from);
    let diagnosis = error.diagnosis().and_then(|diagnosis| serde_json::to_string(diagnosis).ok());
    let made = py.import("kin._errors").and_then(|module| {
        module.getattr("raised")?.call1((kind, text, fields.to_string(), motion, diagnosis))
    });
    match made {
        Ok(exception) => PyErr::from_value(exception),
        Err(failure) => failure,
    }
}

/// The value, or the exception.
pub fn or_raise<T>(py: Python<'_>, result: kin::Result<T>) -> PyResult<T> {
    result.map_err(|error| raised(py, error))
}

/// JSON that does not say what it should.
pub fn unreadable(error: &serde_json::Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// A `ValueError` of these words.
pub fn value(text: impl Into<String>) -> PyErr {
    PyValueError::new_err(text.into())
}

/// A `TypeError` of these words.
pub fn wrong_type(text: impl Into<String>) -> PyErr {
    PyTypeError::new_err(text.into())
}

/// The name of the variant, and its fields.
fn facts(error: &Error) -> (&'static str, Value) {
    if let Some(facts) = of_runs(error) {
        return facts;
    }
    match error {
        Error::ParameterNotFinite { constraint, parameter, .. } => {
            ("ParameterNotFinite", json!({ "constraint": constraint, "parameter": parameter }))
        }
        Error::InvalidParameters { constraint, kind, reason } => (
            "InvalidParameters",
            json!({ "constraint": constraint, "constraint_kind": kind, "reason": reason }),
        ),
        Error::InitialNotFinite { name, coordinate, .. } => {
            ("InitialNotFinite", json!({ "name": name, "coordinate": coordinate }))
        }
        Error::InvalidLength { link, .. } => ("InvalidLength", json!({ "link": link })),
        Error::ForeignBody { mechanism, place, argument } => {
            ("ForeignBody", json!({ "mechanism": mechanism, "place": place, "argument": argument }))
        }
        Error::RepeatedBody { constraint, first, second, name } => (
            "RepeatedBody",
            json!({ "constraint": constraint, "first": first, "second": second, "name": name }),
        ),
        Error::NoCoordinates { constraint, row, reason } => {
            ("NoCoordinates", json!({ "constraint": constraint, "row": row, "reason": reason }))
        }
        Error::CannotBeProved { what, reason } => {
            ("CannotBeProved", json!({ "what": what, "reason": reason }))
        }
        Error::CannotEmit { what, reason } => {
            ("CannotEmit", json!({ "what": what, "reason": reason }))
        }
        Error::InvalidConstraint { constraint, kind, reason } => (
            "InvalidConstraint",
            json!({ "constraint": constraint, "constraint_kind": kind, "reason": reason }),
        ),
        Error::DuplicateName { what, name } => {
            ("DuplicateName", json!({ "what": what, "name": name }))
        }
        Error::EmptyName { what } => ("EmptyName", json!({ "what": what })),
        Error::UnknownName { what, name, known } => {
            ("UnknownName", json!({ "what": what, "name": name, "known": known }))
        }
        Error::InvalidTimes { reason } => ("InvalidTimes", json!({ "reason": reason })),
        Error::InvalidOptions { reason } => ("InvalidOptions", json!({ "reason": reason })),
        Error::NeedsMemory { needed, allowed, .. } => {
            ("NeedsMemory", json!({ "needed": needed, "allowed": allowed }))
        }
        Error::CaseNotFinite { case, name, .. } => {
            ("CaseNotFinite", json!({ "case": case, "name": name }))
        }
        Error::WrongLength { what, expected, found } => {
            ("WrongLength", json!({ "what": what, "expected": expected, "found": found }))
        }
        Error::CannotReach(stop) => {
            let values = |all: &[NamedValue]| -> Value {
                all.iter().map(|driver| (driver.name.clone(), json!(driver.value))).collect()
            };
            (
                "CannotReach",
                json!({
                    "asked": values(&stop.asked),
                    "reached": values(&stop.reached),
                    "singular": stop.singular,
                    "movable": stop.movable,
                    "dependent": stop.dependent,
                    "reason": stop.reason,
                }),
            )
        }
        Error::Dimension(found) => ("DimensionError", of_dimension(found)),
        Error::NotUnique(_) => ("NotUnique", json!({})),
        Error::OtherMotion(found) => {
            ("OtherMotion", json!({ "equation": found.equation, "t": found.t }))
        }
        Error::OutputNotFinite { output, t, .. } => {
            ("OutputNotFinite", json!({ "output": output, "t": t }))
        }
        Error::Mismatch(_) => ("Mismatch", json!({})),
        Error::NoDerivative(_) => ("NoDerivative", json!({})),
        Error::Data { place, reason } => ("DataError", json!({ "place": place, "reason": reason })),
        Error::Table { reason, .. } => ("TableError", json!({ "reason": reason })),
        Error::File { path, .. } => ("FileError", json!({ "path": path })),
        _ => ("Error", json!({})),
    }
}

/// The fields of a mistake in a dimension.
fn of_dimension(error: &DimensionError) -> Value {
    match error {
        DimensionError::Unused { name } => json!({ "name": name }),
        DimensionError::Invalid { name, reason } => json!({ "name": name, "reason": reason }),
        DimensionError::Foreign { mechanism, place } => {
            json!({ "mechanism": mechanism, "place": place })
        }
        _ => json!({}),
    }
}

/// The same of errors that a motion leads to.
fn of_runs(error: &Error) -> Option<(&'static str, Value)> {
    Some(match error {
        Error::Run(failure) => of_failure(failure),
        Error::Jammed(found) => {
            let Jammed { constraint, t, share, drives, .. } = found.as_ref();
            (
                "Jammed",
                json!({ "constraint": constraint, "t": t, "share": share, "drives": drives }),
            )
        }
        Error::Unbounded(found) => {
            let growth = found.growth.iter();
            let told =
                growth.map(|one| json!({ "constraint": one.constraint, "power": one.power }));
            ("Unbounded", json!({ "t": found.t, "growth": told.collect::<Vec<_>>() }))
        }
        Error::Stopped { done, .. } => ("Stopped", json!({ "done": done })),
        _ => return None,
    })
}

/// The same of failures of a run: the exception has the name of the kind.
fn of_failure(failure: &RunFailure) -> (&'static str, Value) {
    let t = failure.t;
    match &failure.kind {
        FailureKind::NoConvergence { iterations, constraint, row, residual, last } => (
            "NoConvergence",
            json!({ "t": t, "iterations": iterations, "constraint": constraint, "row": row, "residual": residual, "last": last }),
        ),
        FailureKind::SingularAt { n, rank, pivot, movable, dependent, drawn, .. } => (
            "SingularAt",
            json!({ "t": t, "n": n, "rank": rank, "pivot": pivot, "movable": movable, "dependent": dependent, "drawn": drawn }),
        ),
        FailureKind::Toggle { asked, movable, dependent } => (
            "Toggle",
            json!({ "t": t, "asked": asked, "movable": movable, "dependent": dependent }),
        ),
        FailureKind::CannotFollow { reason } => {
            ("CannotFollow", json!({ "t": t, "reason": reason.to_string() }))
        }
        FailureKind::WrongBranch { constraint, kind, reason } => (
            "WrongBranch",
            json!({ "t": t, "constraint": constraint, "constraint_kind": kind, "reason": reason }),
        ),
        FailureKind::LawJumps { constraint, law, at, order } => (
            "LawJumps",
            json!({ "t": t, "constraint": constraint, "law": law, "at": at, "order": order }),
        ),
        FailureKind::NotFinite { constraint, row, quantity, .. } => (
            "NotFinite",
            json!({ "t": t, "constraint": constraint, "row": row, "quantity": quantity }),
        ),
        _ => ("CannotBeDriven", json!({})),
    }
}

/// The error of a name that nothing in Python's part has: `kin.UnknownName` with the known names,
/// the most similar one first.
#[pyfunction]
pub fn unknown(py: Python<'_>, what: &str, name: String, known: Vec<String>) -> PyResult<()> {
    const KINDS: [&str; 5] =
        ["body or coordinate", "column", "dimension", "parameter", "parameter of the derivatives"];
    let what = KINDS.into_iter().find(|kind| *kind == what).unwrap_or("column");
    Err(raised(py, Error::UnknownName { what, name, known }))
}
