//! Which breaks of its laws a run crosses: between two times nothing shows them but the law itself.

use std::f64::consts::{PI, TAU};

use crate::model::error::Error;
use crate::model::law::{Break, Law, MOST_BREAKS};
use crate::model::motion::CrossedBreak;
use crate::system::System;
use crate::system::evaluate::Instant;

/// Breaks that a run lists at most; it goes on without listing more.
pub(crate) const MOST_CROSSED: usize = 100_000;

/// The laws of a system that have breaks, and where they were asked last.
#[derive(Default)]
pub(super) struct LawBreaks {
    asked: Vec<Asked>,
    last: Option<f64>,
}

/// One question to a law.
struct Asked {
    block: usize,
    /// Which of the block's questions.
    number: usize,
    x: f64,
}

impl LawBreaks {
    /// Looks at the laws at a time that was solved, and appends the breaks crossed since the last
    /// one. A jump of a value, or of the slope of a law of time, is an error.
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

    /// Asks every law with breaks, which was asked at the time `before`.
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
                // The run ends before them.
                crossed.truncate(known);
                return Err(Error::LawJumps {
                    t,
                    units: system.unit_words().clone(),
                    constraint,
                    law,
                    at: found.x,
                    order: found.order,
                    motion: None,
                });
            }
        }
        Ok(())
    }
}

/// The turns between two arguments of a law: an angle that went over its cut. Only a law that
/// repeats is asked there.   \[rad\]
fn turns(law: &Law, from: f64, to: f64) -> f64 {
    if (to - from).abs() > PI && law.is_periodic(TAU) {
        TAU * ((from - to) / TAU).round()
    } else {
        0.0
    }
}

/// The breaks of a law between two arguments, as many as there is room for; the first one that
/// stops the run, if one does.
fn between(
    law: &Law,
    [from, to]: [f64; 2],
    room: usize,
    stops: impl Fn(&Break) -> bool,
) -> Result<Vec<Break>, Break> {
    let all = if room > 0 { law.breaks(from, to) } else { Vec::new() };
    let full = room == 0 || all.len() >= MOST_BREAKS;
    let range = if all.is_empty() && !full { None } else { law.range() };
    // At the ends of its range a law is what it is within.
    let passed = |b: &Break| match range {
        Some(range) if b.x == range.to => from.min(to) <= b.x && b.x < from.max(to),
        Some(range) if b.x == range.from => from.min(to) < b.x && b.x <= from.max(to),
        _ => b.x != from,
    };
    let here = all.iter().filter(|b| passed(b));
    // The one that is met first.
    let mut jump =
        if to < from { here.clone().rfind(|b| stops(b)) } else { here.clone().find(|b| stops(b)) }
            .copied();
    if jump.is_none() && full {
        jump = law.sharpest_break(from, to).filter(|b| passed(b) && stops(b));
    }
    jump.map_or_else(|| Ok(here.take(room).copied().collect()), Err)
}

/// Every question to a law with breaks.
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

/// True if the argument of a law moves with the time alone.
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
