//! Finds the first position: from a rough guess to C(q, t) = 0, in the preferred assembly.
//!
//! The phases are:
//!
//! 1. Kin rotates driven bodies to their drivers.
//! 2. If no assembly is preferred, Kin makes damped Newton steps.
//! 3. If the Newton steps fail, or if an assembly is preferred, Kin minimises |C|² by damped least
//!    squares (Levenberg–Marquardt), which does not need a regular C_q. The preferred coordinates
//!    have a target whose weight decreases to zero. Newton's method ends this phase.
//! 4. If the least squares fail too, Kin repeats the phases from a few other starts, which are the
//!    same in every run.
//!
//! A guess that satisfies every equation is an assembly, even if the position is singular. Kin
//! reports such a position as singular, and uses another assembly only if the other assembly is
//! nearer to preferred values.

use super::{Failure, Newton, Outcome, Steps, driven};
use crate::outcome::error::{Error, FailureKind, Result};
use crate::solve::assembly::{self, search, turned_over};
use crate::solve::options::Follow;
use crate::system::scale;

/// A preferred coordinate that ends this close is in the preferred assembly. \[rad, or typical
/// lengths\]
const NEAR: f64 = std::f64::consts::FRAC_PI_4;

/// An assembly that is nearer to preferred values by less than this is the same one. \[rad, or
/// typical lengths\]
const OTHER: f64 = 1e-6;

/// Sizes of guess and solution that differ by less than this factor are equal. \[-\]
const SAME: f64 = 1.25;

/// Solves at the first time t from the system's guess, including q̇ and q̈.
pub(crate) fn assemble(newton: &mut Newton<'_>, t: f64) -> Result<Outcome> {
    if !newton.options.rescue {
        return from_start(newton, t, Steps::Full);
    }
    measure(newton, t);
    let found = search(newton, t);
    let outcome =
        match newton.system.nearer(found.is_ok().then_some(&newton.q), t, &newton.options.search) {
            Some(q) => {
                newton.q.copy_from_slice(&q);
                attempt_any_way_up(newton, t).or(found)?
            }
            None => found?,
        };
    if newton.options.follow != Follow::Unchecked {
        take_reaches(newton, t)?;
    }
    newton.rates().map_err(|failure| newton.error(failure, t, None))?;
    Ok(outcome)
}

/// Solves at time t from the present point by Newton steps of this kind, including q̇ and q̈.
pub(crate) fn from_start(newton: &mut Newton<'_>, t: f64, steps: Steps) -> Result<Outcome> {
    measure(newton, t);
    if steps == Steps::Damped {
        driven::turn(newton, t);
    }
    let outcome = attempt(newton, t, steps)?;
    newton.rates().map_err(|failure| newton.error(failure, t, None))?;
    Ok(outcome)
}

/// Solves at time t from the present point, which satisfies the equations at that time but for
/// rounding, as the first position of a run.
pub(crate) fn resume(newton: &mut Newton<'_>, t: f64) -> Result<()> {
    from_start(newton, t, Steps::Near)?;
    if newton.options.follow != Follow::Unchecked {
        take_reaches(newton, t)?;
        newton.rates().map_err(|failure| newton.error(failure, t, None))?;
    }
    Ok(())
}

/// Computes the characteristic sizes at the present point, without C_q if it is not finite there.
fn measure(newton: &mut Newton<'_>, t: f64) {
    let finite = newton.linearize(t).is_ok();
    let sizes = sizes(newton, finite);
    take(newton, sizes);
}

/// Uses these sizes. If the first sizes were far off, the scales computed with them are discarded.
fn take(newton: &mut Newton<'_>, sizes: Vec<f64>) {
    if differ(&sizes, &newton.sizes, 8.0) {
        newton.linear.forget();
    }
    newton.set_sizes(sizes);
}

/// Returns the characteristic sizes at the present point, from its C_q if it is finite.
fn sizes(newton: &mut Newton<'_>, finite: bool) -> Vec<f64> {
    let system = newton.system;
    let layout = system.layout();
    let equations = system.equations();
    let t = newton.instant.t();
    if !newton.turned.serves(&newton.q, &newton.sizes) {
        newton.turned = scale::Turned::new(layout, equations, (&newton.q, t));
    }
    let values = if finite { newton.linear.values() } else { &[] };
    scale::sizes_with(&newton.turned, layout, equations, values, (&newton.q, t), system.links())
}

/// Uses the sizes for the check of steps of time, and solves again if they differ.
fn take_reaches(newton: &mut Newton<'_>, t: f64) -> Result<()> {
    let system = newton.system;
    let reaches =
        scale::reaches(system.layout(), system.equations(), (&newton.q, t), newton.sizes.clone());
    if reaches == newton.sizes {
        return Ok(());
    }
    newton.linear.forget();
    newton.set_sizes(reaches);
    newton.solve(t, Steps::Near).map_err(|failure| newton.error(failure, t, None)).map(|_| ())
}

fn differ(sizes: &[f64], others: &[f64], factor: f64) -> bool {
    sizes
        .iter()
        .zip(others)
        .any(|(size, other)| !(factor.recip()..factor).contains(&(size / other)))
}

/// Runs Newton's method from the present point. If the sizes at the solution differ, it runs again
/// with them, which takes no step.
fn attempt(newton: &mut Newton<'_>, t: f64, steps: Steps) -> Result<Outcome> {
    let tried = newton.solve(t, steps).or_else(|failure| match failure {
        // A derivative without bounds at an earlier start, such as that of an angle at its pole,
        // makes all others seem small.
        Failure::Singular => {
            newton.linear.forget();
            newton.solve(t, steps)
        }
        failure => Err(failure),
    });
    let tried = tried.and_then(|outcome| {
        let sizes = sizes(newton, true);
        if !differ(&sizes, &newton.sizes, SAME) {
            return Ok(outcome);
        }
        take(newton, sizes);
        newton.solve(t, steps)
    });
    tried.map_err(|failure| newton.error(failure, t, None))
}

/// Runs damped Newton from the present point. If it ends with an axis turned by 180°, it runs again
/// with that body turned over.
fn attempt_any_way_up(newton: &mut Newton<'_>, t: f64) -> Result<Outcome> {
    let tried = attempt(newton, t, Steps::Damped);
    if let Err(error) = &tried
        && matches!(error.kind(), Some(FailureKind::WrongBranch { .. }))
        && let Some(found) = turned_over::mended(
            newton.system.model(),
            &newton.q,
            t,
            &|_| true,
            newton.options.search.steps,
        )
    {
        newton.steps += found.place.steps;
        newton.q.copy_from_slice(&found.place.q);
        return attempt(newton, t, Steps::Damped);
    }
    tried
}

/// Runs start after start until one ends in the preferred assembly. Otherwise returns the nearest
/// one, or the most informative error.
fn search(newton: &mut Newton<'_>, t: f64) -> Result<Outcome> {
    let preferred = newton.system.preferred();
    let mut failure: Option<Error> = None;
    driven::turn(newton, t);
    let guess = newton.q.to_vec();
    if preferred.is_empty() {
        match attempt_any_way_up(newton, t) {
            Ok(outcome) => return Ok(outcome),
            Err(error) => failure = Some(error),
        }
    }
    let drawn = match drawn(newton, &guess, t) {
        Some((_, error)) if preferred.is_empty() => return Err(error),
        drawn => drawn,
    };
    // The drawn pose itself, off by rounding, is not another assembly.
    let is_nearest = |far: f64| drawn.as_ref().is_none_or(|(known, _)| far + OTHER < *known);
    let mut best: Option<(f64, Vec<f64>)> = None;
    let clock = newton.options.search.clock();
    for start in 0..newton.options.search.starts.max(1) {
        if start > 0 && clock.is_up() {
            break;
        }
        place(newton, &guess, start);
        approach(newton, t);
        match attempt_any_way_up(newton, t) {
            Ok(outcome) => {
                let far = distance(newton);
                if far <= NEAR && is_nearest(far) {
                    return Ok(outcome);
                }
                if best.as_ref().is_none_or(|(known, _)| far < *known) {
                    best = Some((far, newton.q.to_vec()));
                }
            }
            Err(error) => failure = Some(more_telling(failure, error)),
        }
    }
    if let Some((_, q)) = best.filter(|(far, _)| is_nearest(*far)) {
        newton.q.copy_from_slice(&q);
        return attempt(newton, t, Steps::Damped);
    }
    if let Some((_, error)) = drawn {
        return Err(error);
    }
    Err(failure.unwrap_or_else(|| {
        newton.error(Failure::NoConvergence { row: 0, residual: f64::INFINITY }, t, None)
    }))
}

/// Returns the error for a guess that satisfies every equation and is singular, and its distance
/// from preferred values. Returns `None` for other guesses.
#[cold]
fn drawn(newton: &mut Newton<'_>, guess: &[f64], t: f64) -> Option<(f64, Error)> {
    let model = newton.system.model();
    let point = model.linearize(guess, t).ok()?;
    let measures = model.measure(guess, t);
    let is_met = model.met(&point, guess, &measures, &|_| true);
    if !is_met || model.rank(&point.values, &measures) == model.n() {
        return None;
    }
    newton.q.copy_from_slice(guess);
    let far = distance(newton);
    let mut error = newton.system.singular(t, guess, None);
    if let Error::Run(failure) = &mut error
        && let FailureKind::SingularAt { drawn, .. } = &mut failure.kind
    {
        *drawn = true;
    }
    Some((far, error))
}

/// Returns the more informative error: a singular position before none, and a near miss before a
/// far one.
fn more_telling(known: Option<Error>, new: Error) -> Error {
    let weight = |error: &Error| match error.kind() {
        Some(FailureKind::WrongBranch { .. }) => (4, 0.0),
        Some(FailureKind::SingularAt { unmet: None, .. }) => (3, 0.0),
        Some(FailureKind::NoConvergence { residual, .. }) => (2, *residual),
        Some(FailureKind::SingularAt { .. }) => (1, 0.0),
        _ => (0, 0.0),
    };
    match known {
        Some(known) => {
            let a = weight(&known);
            let b = weight(&new);
            if b.0 > a.0 || (b.0 == a.0 && b.1 < a.1) { new } else { known }
        }
        None => new,
    }
}

/// Returns the distance of the worst preferred coordinate from its value.
fn distance(newton: &Newton<'_>) -> f64 {
    assembly::distance(newton.system.layout(), newton.system.preferred(), &newton.q, &newton.sizes)
}

/// Sets the guess, and from the second start on the guess with random changes of everything except
/// the preferred coordinates.
fn place(newton: &mut Newton<'_>, guess: &[f64], start: usize) {
    let start = search::start_from(
        &newton.system.model(),
        guess,
        &newton.sizes,
        start,
        &newton.options.search,
    );
    newton.q.copy_from_slice(&start);
    for &(column, value) in newton.system.preferred() {
        newton.q[column] = value;
    }
}

/// Runs damped least squares from the present point, with decreasing weights of the preferred
/// coordinates.
fn approach(newton: &mut Newton<'_>, t: f64) {
    if let Some(found) = search::descend(
        newton.system.model(),
        &newton.q,
        t,
        &|_| true,
        true,
        newton.options.search.steps,
    ) {
        newton.steps += found.place.steps;
        newton.q.copy_from_slice(&found.place.q);
    }
}
