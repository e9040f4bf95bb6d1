//! Finds the breaks of laws that a run crosses.
//!
//! Kin queries the laws, because positions at two times do not show a break between them.

use std::f64::consts::{PI, TAU};

use crate::law::{Break, Law, MOST_BREAKS};
use crate::outcome::error::{Error, FailureKind};
use crate::outcome::motion::CrossedBreak;
use crate::system::System;
use crate::system::evaluate::Instant;

/// The largest number of breaks that a run lists; further breaks are omitted.
const MOST_CROSSED: usize = 100_000;

/// The laws of a system that have breaks, with their last arguments.
#[derive(Default)]
pub(super) struct LawBreaks {
    asked: Vec<Asked>,
    last: Option<f64>,
}

/// One evaluation of a law.
struct Asked {
    block: usize,
    /// The index of the law in its constraint.
    number: usize,
    x: f64,
}

impl LawBreaks {
    /// Examines the laws at a solved time and appends the breaks crossed since the last time. A
    /// jump of a value, or of the slope of a law of time, is an error.
    #[inline(always)]
    pub(super) fn look(
        &mut self,
        system: &System,
        instant: &Instant,
        crossed: &mut Vec<CrossedBreak>,
    ) -> Result<(), Error> {
        match self.last.replace(instant.t()) {
            None => self.asked = questions(system, instant),
            Some(before) if !self.asked.is_empty() => {
                return self.cross(system, instant, before, crossed);
            }
            Some(_) => {}
        }
        Ok(())
    }

    /// Examines every law with breaks between the time `before` and the present time.
    fn cross(
        &mut self,
        system: &System,
        instant: &Instant,
        before: f64,
        crossed: &mut Vec<CrossedBreak>,
    ) -> Result<(), Error> {
        let t = instant.t();
        let known = crossed.len();
        for asked in &mut self.asked {
            let block = &system.equations().blocks[asked.block];
            let mut number = 0;
            let mut jumps = None;
            block.constraint.laws(
                &system.equations().at(block, instant),
                &mut |law, function, x| {
                    number += 1;
                    if number != asked.number + 1 {
                        return;
                    }
                    let from = std::mem::replace(&mut asked.x, x);
                    let to = x + turns(function, from, x);
                    let stops = |b: &Break| {
                        b.order == 0
                            || (b.order == 1
                                && is_of_time(system, instant, asked.block, asked.number, x))
                    };
                    let named = |found: Break| {
                        let constraint = block.name.clone();
                        let law = law.to_owned();
                        CrossedBreak { between: (before, t), constraint, law, found }
                    };
                    match between(
                        function,
                        [from, to],
                        MOST_CROSSED.saturating_sub(crossed.len()),
                        stops,
                    ) {
                        Ok(all) => crossed.extend(all.into_iter().map(named)),
                        Err(jump) => jumps = Some(named(jump)),
                    }
                },
            );
            if let Some(CrossedBreak { constraint, law, found, .. }) = jumps {
                // The run ends before these breaks.
                crossed.truncate(known);
                let order = found.order;
                let kind = FailureKind::LawJumps { constraint, law, at: found.x, order };
                return Err(kind.at(t, system.unit_words()));
            }
        }
        Ok(())
    }
}

/// Returns the full revolutions between two arguments of a law, if an angle crossed its cut. Only a
/// law that repeats has any. \[rad\]
fn turns(law: &Law, from: f64, to: f64) -> f64 {
    if (to - from).abs() > PI && law.is_periodic(TAU) {
        TAU * ((from - to) / TAU).round()
    } else {
        0.0
    }
}

/// Returns the breaks of a law between two arguments, as many as the list may contain, and the
/// first one that stops the run.
fn between(
    law: &Law,
    [from, to]: [f64; 2],
    room: usize,
    stops: impl Fn(&Break) -> bool,
) -> Result<Vec<Break>, Break> {
    let all = if room > 0 { law.breaks(from, to) } else { Vec::new() };
    let full = room == 0 || all.len() >= MOST_BREAKS;
    let range = if all.is_empty() && !full { None } else { law.range() };
    // At the ends of its range a law has the derivatives of its inside.
    let passed = |b: &Break| match range {
        Some(range) if b.x == range.to => from.min(to) <= b.x && b.x < from.max(to),
        Some(range) if b.x == range.from => from.min(to) < b.x && b.x <= from.max(to),
        _ => b.x != from,
    };
    let here = all.iter().filter(|b| passed(b));
    // The break that the run reaches first.
    let mut jump =
        if to < from { here.clone().rfind(|b| stops(b)) } else { here.clone().find(|b| stops(b)) }
            .copied();
    if jump.is_none() && full {
        jump = law.sharpest_break(from, to).filter(|b| passed(b) && stops(b));
    }
    jump.map_or_else(|| Ok(here.take(room).copied().collect()), Err)
}

/// Returns every evaluation of a law with breaks.
fn questions(system: &System, instant: &Instant) -> Vec<Asked> {
    let mut all = Vec::new();
    for (block, found) in system.equations().blocks.iter().enumerate() {
        let mut number = 0;
        found.constraint.laws(&system.equations().at(found, instant), &mut |_, law, x| {
            if !law.is_smooth() {
                all.push(Asked { block, number, x });
            }
            number += 1;
        });
    }
    all
}

/// Returns true if the argument of a law depends on time alone.
fn is_of_time(system: &System, instant: &Instant, block: usize, wanted: usize, now: f64) -> bool {
    let block = &system.equations().blocks[block];
    let mut later = system.equations().at(block, instant).with_timed(&[]);
    later.t += 1.0;
    let mut number = 0;
    let mut moves = false;
    block.constraint.laws(&later, &mut |_, _, x| {
        moves |= number == wanted && x != now;
        number += 1;
    });
    moves
}
