//! Texts and sizes of errors.

use super::*;
use crate::coordinates::units::Units;

#[test]
fn debug_is_display() {
    let error = Error::EmptyName { what: "body" };
    assert_eq!(format!("{error:?}"), "a body has an empty name. Give the body a name");
}

#[test]
fn error_is_small_and_crosses_threads() {
    fn sent<T: Send + Sync + 'static>() {}
    sent::<Error>();
    assert!(std::mem::size_of::<Error>() <= 128);
}

#[test]
fn no_convergence_names_the_row_and_the_last_time() {
    let kind = FailureKind::NoConvergence {
        iterations: 20,
        constraint: "B".into(),
        row: "y".into(),
        residual: 0.04,
        last: Some(0.3),
    };
    let error = kind.at(0.31, &Units::default());
    let text = error.to_string();
    assert!(
        text.starts_with(
            "Kin found no position at t = 0.31 s: after 20 iterations the residual of `B` row y is still 4.0e-2 (in the unit of this equation)."
        ),
        "{text}"
    );
    assert!(text.contains("t = 0.3 s"), "{text}");
}
