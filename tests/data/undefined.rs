//! Times of a motion at which derivatives are those of either side: a law breaks there, or an
//! equation has a kink.

use kin::prelude::*;
use kin::{Engine, SolverOptions};

/// True if a run that goes on beyond this time of a motion passes a break of a law or a kink within
/// `near` seconds of it: then rounding decides on which side the time is, and so which of two
/// derivatives is right.
///
/// An event at the first or last time of a motion is in none of its lists, because nothing changes
/// within the motion. So this looks at a run that begins before the time and ends after it.
pub fn is_undefined(system: &System, times: &[f64], k: usize, near: f64) -> bool {
    let t = times[k];
    let forwards = times[times.len() - 1] >= times[0];
    let near = if forwards { near } else { -near };
    let before = times[..k].iter().copied();
    let is_before = |own: &f64| (t - near - own) * near > 0.0;
    let about: Vec<f64> = before.filter(is_before).chain([t - near, t + near]).collect();
    let by_steps = SolverOptions::new().engine(Engine::StepByStep);
    let Ok(about) = system.solver().options(by_steps).run(&about) else { return false };
    // t ± near are rounded.
    let rounded = 2.0 * f64::EPSILON * t.abs();
    let is_near = |own: f64| (own - t).abs() <= near.abs() + rounded;
    about.breaks().iter().any(|own| is_near(own.between.0) && is_near(own.between.1))
        || about.events().iter().any(|event| is_near(event.t))
}
