//! Reports an event when a run passes the limit of a joint or the end of a slot.

use super::roots::{Root, Search, Zero};
use crate::coordinates::units::Units;
use crate::model::mechanism::Limit;
use crate::outcome::error::Result;
use crate::outcome::words::time;
use crate::solve::motion::{Event, EventKind, Motion};
use crate::system::System;

impl System {
    /// Stores the limits of the user. Errors: a name that nothing has.
    pub(crate) fn set_limits(&mut self, limits: Vec<Limit>) -> Result<()> {
        if let Some(limit) = limits.iter().find(|limit| !self.is_measure(&limit.name)) {
            return Err(self.no_measure(&limit.name));
        }
        self.limits = limits;
        Ok(())
    }

    /// Returns the limits of the user and the ends of slots.
    pub(in crate::ask) fn all_limits(&self) -> Vec<Limit> {
        let mut all = self.limits.clone();
        for (joint, constraint) in self.constraints() {
            for (k, measure) in constraint.facts().measures.iter().enumerate() {
                let Some(ends) = constraint.ends(k) else { continue };
                let name = format!("{joint}.{}", measure.name);
                if !all.iter().any(|limit| limit.name == name) {
                    all.push(Limit { name, ends });
                }
            }
        }
        all
    }

    /// Adds an event to the motion for each limit that it passes. A limit that cannot be evaluated
    /// becomes an event too, so that the run does not fail.
    pub(crate) fn note_limits(&self, motion: &mut Motion) {
        for limit in self.all_limits() {
            let events = events(self, motion, &limit).unwrap_or_else(|error| {
                let t = motion.times().last().copied().unwrap_or(0.0);
                vec![event(
                    &limit,
                    t,
                    format!("Kin cannot check the limits of `{}`: {error}", limit.name),
                )]
            });
            events.into_iter().for_each(|event| motion.add_event(event));
        }
    }
}

fn event(limit: &Limit, t: f64, text: String) -> Event {
    Event { t, units: Units::default(), kind: EventKind::Limit, name: limit.name.clone(), text }
}

fn events(system: &System, motion: &Motion, limit: &Limit) -> Result<Vec<Event>> {
    let name = limit.name.as_str();
    let [from, to] = limit.ends;
    let fine = system.fine(motion, Some(&name))?;
    let grid = system.measure(&fine.motion, name)?.value;
    let (Some(&start), Some(&first)) = (motion.times().first(), grid.values().first()) else {
        return Ok(Vec::new());
    };
    let mut all = Vec::new();
    for (end, side, outside) in [(from, "lower", first < from), (to, "upper", first > to)] {
        let shown = time(end);
        let unit = grid.unit();
        if outside {
            all.push(event(
                limit,
                start,
                format!(
                    "`{name}` starts at {} {unit}, beyond the {side} limit, {shown} {unit}",
                    time(first)
                ),
            ));
        }
        // Most motions stay within the limits: the grid suffices, unless it comes close to one.
        if end.is_infinite() || !comes_near(grid.values(), end) {
            continue;
        }
        for Root { t, rises, .. } in Search::new(system, &fine, &name, Zero::Value(end))?.all()? {
            let forwards = motion.times().last().is_none_or(|last| *last >= start);
            let leaves = (rises == forwards) == (side == "upper");
            let way = if leaves { "passes" } else { "returns from beyond" };
            all.push(event(limit, t, format!("`{name}` {way} the {side} limit, {shown} {unit}")));
        }
    }
    Ok(all)
}

/// Returns true if an end is within the range of the values, or beyond it by at most their change
/// in a step.
fn comes_near(values: &[f64], end: f64) -> bool {
    let (low, high) =
        values.iter().fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(*x), high.max(*x)));
    let step = values.windows(2).fold(0.0_f64, |m, pair| m.max((pair[1] - pair[0]).abs()));
    (low - step..=high + step).contains(&end)
}
