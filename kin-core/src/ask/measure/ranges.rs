//! Reports an event when a run evaluates a law beyond its table.
//!
//! Kin does not report a law that holds its last value, such as a sequence that comes to rest.

use crate::law::LawRange;
use crate::solve::motion::{Event, EventKind, Motion};
use crate::system::System;

/// Arguments beyond a range by at most this share of it are at its end, because times are rounded.
/// \[-\]
const AT_END: f64 = 1e-9;

/// The argument of a law with a table.
struct Asked {
    block: usize,
    /// The index of the law in its constraint.
    number: usize,
    law: String,
    range: LawRange,
    /// The preceding time, and the argument there.
    before: Option<(f64, f64)>,
    /// For each end, the time at which the argument first left the range, and the largest distance
    /// since.
    left: [Option<(f64, f64)>; 2],
}

impl System {
    /// Adds an event to the motion for each law that is evaluated beyond its table, once for each
    /// end.
    pub(crate) fn note_ranges(&self, motion: &mut Motion) {
        let mut all = self.laws_with_tables();
        if all.is_empty() {
            return;
        }
        let equations = self.equations();
        for (k, &t) in motion.times().iter().enumerate() {
            let instant = equations.instant_at(t, motion.q(k));
            for asked in &mut all {
                let block = &equations.blocks[asked.block];
                let mut number = 0;
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

    fn laws_with_tables(&self) -> Vec<Asked> {
        let equations = self.equations();
        let mut all = Vec::new();
        // The laws do not depend on the pose, so no position is needed to see which have tables.
        let instant = equations.instant();
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
                all.extend(law.table_range().map(asked));
                number += 1;
            });
        }
        all
    }
}

impl Asked {
    /// Examines the argument at the next time.
    fn look(&mut self, t: f64, x: f64) {
        let LawRange { from, to, .. } = self.range;
        let finite = |x: f64| if x.is_finite() { x.abs() } else { 0.0 };
        let near = AT_END * finite(to - from).max(finite(from)).max(finite(to));
        let outside = [x < from - near, x > to + near];
        for (side, end) in [(0, from), (1, to)] {
            if !outside[side] {
                continue;
            }
            // Between two times the argument counts as linear, which is exact for time itself.
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
        let words = [("begins", range.from, "Before"), ("ends", range.to, "Beyond")];
        let told = left.iter().zip(words).filter_map(|(left, (does, end, side))| {
            let (t, far) = (*left)?;
            let text = format!(
                "`{law}` of `{name}` {does} at {end}, but the run continues to {far}. {side} {end} the law is a \
                 straight line"
            );
            let kind = EventKind::BeyondRange;
            Some(Event { t, units: Default::default(), kind, name: name.to_string(), text })
        });
        told.collect()
    }
}
