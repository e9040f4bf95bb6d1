//! Finds where to start instead of a singular position: another time, or another value of a driver.
//!
//! Kin tests the alternative before it reports the alternative.

use crate::outcome::verdict::{Asks, Elsewhere};

use super::examined::Examined;
use crate::linear::Echelon;
use crate::solve::assembly::search;
use crate::system::scaled::Model;

/// The smallest pivot of a position that counts as regular. \[-\]
const CLEAR: f64 = 1e-4;

/// Returns a time near the examined one, later if possible, otherwise earlier. If the drivers are
/// at rest, it returns another value of a driver.
pub(super) fn elsewhere(examined: &Examined<'_>) -> Option<Elsewhere> {
    /// The steps, in units of the time in which the fastest driver moves something by one. \[-\]
    const STEPS: [f64; 8] = [0.01, 0.03, 0.1, 0.3, -0.01, -0.03, -0.1, -0.3];
    let model = examined.model();
    let t = examined.t;
    let time = examined.measures().time;
    let times = STEPS.iter().map(|step| rounded(t, step * time));
    let regular = |t: &f64| {
        let found = search::descend(*model, examined.q, *t, &|_| true, false, examined.walk.steps)
            .filter(|found| found.met);
        found.is_some_and(|found| is_clear(model, &found.place.q, *t))
    };
    times.into_iter().find(regular).map(Elsewhere::Time).or_else(|| other_value(examined))
}

/// Rounds a time to two digits of the step.
fn rounded(t: f64, step: f64) -> f64 {
    let digit = 10.0_f64.powf(step.abs().log10().floor() - 1.0);
    if digit > 0.0 && digit.is_finite() { ((t + step) / digit).round() * digit } else { t + step }
}

/// Returns true if C_q is far from singular at a pose.
fn is_clear(model: &Model<'_>, q: &[f64], t: f64) -> bool {
    let rank = |values: &[f64]| {
        Echelon::new(model.scaled(values, &model.measure(q, t), &|_| true), model.n(), CLEAR).rank()
    };
    model.linearize(q, t).is_ok_and(|point| rank(&point.values) == model.n())
}

/// Returns the value of a driver of one coordinate at a regular position nearby.
fn other_value(examined: &Examined<'_>) -> Option<Elsewhere> {
    let model = examined.model();
    let nearby = examined.nearby?;
    if !is_clear(model, &nearby.q, nearby.t) {
        return None;
    }
    let point = model.linearize(&nearby.q, examined.t).ok()?;
    model.equations.blocks.iter().filter(|block| block.drives && block.rows().len() == 1).find_map(
        |block| {
            let row = block.rows().start;
            let mut own = model
                .entries(&point.values)
                .filter(|(known, _, value)| *known == row && *value != 0.0);
            let (Some((_, column, _)), None) = (own.next(), own.next()) else { return None };
            let asked = examined.q[column];
            let stands = nearby.q[column];
            let asks = Asks::of(model.layout, column, asked, stands);
            (asked != stands).then(|| Elsewhere::Drive { constraint: block.name.clone(), asks })
        },
    )
}
