//! Laws that a run asks beyond what they are made for: a run reports it by events.

use crate::model::law::{Beyond, LawRange};
use crate::solve::motion::{Event, EventKind, Motion};
use crate::system::System;

/// Arguments beyond a range by no more than this share of it are at its end: times are rounded.   \[-\]
const AT_END: f64 = 1e-9;

/// A question to a law with a range.
struct Asked {
    block: usize,
    /// Which of the block's questions.
    number: usize,
    law: String,
    range: LawRange,
    /// The time before, and the argument there.
    before: Option<(f64, f64)>,
    /// When the argument first was outside, and how far out it has been at its farthest.
    left: [Option<(f64, f64)>; 2],
}

impl System {
    /// Tells the motion of each law that is asked beyond its range, once for either end.
    pub(crate) fn note_ranges(&self, motion: &mut Motion) {
        let mut all = self.laws_with_ranges(motion);
        if all.is_empty() {
            return;
        }
        let equations = self.equations();
        for (k, &t) in motion.times().iter().enumerate() {
            let instant = equations.instant_at(t, motion.q(k));
            for asked in &mut all {
                let (block, mut number) = (&equations.blocks[asked.block], 0);
                block.constraint.laws(&equations.at(block, &instant), &mut |_, _, x| {
                    if number == asked.number {
                        asked.look(t, x);
                    }
                    number += 1;
                });
            }
        }
        for asked in all {
            let name = &equations.blocks[asked.block].name;
            asked.events(name).into_iter().for_each(|event| motion.add_event(event));
        }
    }

    fn laws_with_ranges(&self, motion: &Motion) -> Vec<Asked> {
        let (equations, mut all) = (self.equations(), Vec::new());
        let Some(&t) = motion.times().first() else { return all };
        let instant = equations.instant_at(t, motion.q(0));
        for (block, found) in equations.blocks.iter().enumerate() {
            let mut number = 0;
            found.constraint.laws(&equations.at(found, &instant), &mut |name, law, _| {
                let asked = |range| Asked {
                    block,
                    number,
                    law: name.to_string(),
                    range,
                    before: None,
                    left: [None; 2],
                };
                all.extend(law.range().map(asked));
                number += 1;
            });
        }
        all
    }
}

impl Asked {
    /// Looks at the argument at the next time.
    fn look(&mut self, t: f64, x: f64) {
        let LawRange { from, to, .. } = self.range;
        let near = AT_END * (to - from).abs().max(from.abs()).max(to.abs());
        let outside = [x < from - near, x > to + near];
        for (side, end) in [(0, from), (1, to)] {
            if !outside[side] {
                continue;
            }
            // Between two times the argument is taken as a straight line, which that of time is.
            let at = |(t0, x0): (f64, f64)| t0 + (end - x0) / (x - x0) * (t - t0);
            let inside = |(_, x0): &(f64, f64)| if side == 0 { *x0 >= end } else { *x0 <= end };
            let left = self.before.filter(inside).map_or(t, at);
            self.left[side] = Some(match self.left[side] {
                None => (left, x),
                Some((first, far)) => (first, if side == 0 { far.min(x) } else { far.max(x) }),
            });
        }
        self.before = Some((t, x));
    }

    fn events(self, name: &str) -> Vec<Event> {
        let Asked { law, range, left, .. } = &self;
        let beyond = match range.beyond {
            Beyond::Held => "the value of the end is held",
            Beyond::Line => "the law is a straight line",
        };
        let words = [("begins", range.from, "before"), ("ends", range.to, "beyond")];
        let told = left.iter().zip(words).filter_map(|(left, (does, end, side))| {
            let (t, far) = (*left)?;
            let text = format!(
                "`{law}` of `{name}` {does} at {end}, the run goes on to {far}: {side} {end} {beyond}"
            );
            let kind = EventKind::BeyondRange;
            Some(Event { t, units: Default::default(), kind, name: name.to_string(), text })
        });
        told.collect()
    }
}
