//! A recording over lanes: the same steps on a memory in which right sides and solutions of all three kinds
//! stay where they are.

use super::super::recorded::program::Kind;
use super::super::recorded::record::{Places, Recording};
use super::super::recorded::replay::{Replay, SMALL};
use super::super::{GROWTH, REFINED};
use super::WideLinear;
use crate::numbers::lanes::{Level, Wide};

/// Rates that the ground has for any argument: as many as a spatial body.
pub(super) const GROUND: usize = 7;

/// Where right sides and solutions stand in the memory that the recording knows nothing of: behind its zero,
/// before what it computes.
#[derive(Clone, Copy)]
pub(super) struct Areas {
    pub recorded: Places,
    pub n: usize,
    pub velocity: usize,
    pub rates: usize,
    pub acceleration: usize,
    pub second_rates: usize,
    pub end: usize,
}

impl Areas {
    pub(super) fn new(recorded: Places, n: usize) -> Self {
        let velocity = recorded.zero as usize + 1;
        let rates = velocity + n;
        let acceleration = rates + n + GROUND;
        Areas {
            recorded,
            n,
            velocity,
            rates,
            acceleration,
            second_rates: acceleration + n,
            end: acceleration + 2 * n,
        }
    }

    /// Where a number of the recording stands here.
    pub(super) fn moved(&self, place: u32) -> u32 {
        if place <= self.recorded.zero { place } else { place - self.recorded.zero - 1 + self.end as u32 }
    }

    /// The same for a program with a right side and a solution of its own.
    fn moved_to(&self, rhs: usize, solution: usize, place: u32) -> u32 {
        let own = [(self.recorded.rhs, rhs), (self.recorded.solution, solution)];
        let inside = |(first, _): &(u32, usize)| (*first..*first + self.n as u32).contains(&place);
        own.into_iter()
            .find(inside)
            .map_or_else(|| self.moved(place), |(first, new)| place - first + new as u32)
    }
}

impl<S: Level> WideLinear<S> {
    /// Takes over the recording, if there is one.
    pub(super) fn load(&mut self) {
        let Some(recording) = &self.recorder.recording else { return };
        let Recording { factor, solve, weights, factored, .. } = recording.as_ref();
        let (areas, zero) = (self.areas, self.recorder.places.zero);
        self.factor = Replay::new(factor, |place| areas.moved(place), [], zero);
        self.correct = Replay::new(solve, |place| areas.moved(place), [], zero);
        let to = |rhs, solution| move |place| areas.moved_to(rhs, solution, place);
        let [velocity, acceleration] = [0, 1].map(|k| self.zeros[k].iter().copied());
        self.velocity = Replay::new(solve, to(areas.velocity, areas.rates), velocity, zero);
        self.acceleration =
            Replay::new(solve, to(areas.acceleration, areas.second_rates), acceleration, zero);
        let written: Vec<(Kind, u32)> = factor.written().collect();
        let allowed = |kind: Kind| if kind == Kind::Scaled { GROWTH } else { REFINED };
        let shares = |first: usize, end: usize| {
            let mut shares = vec![0.0; end - first];
            for ((kind, place), weight) in written
                .iter()
                .zip(weights)
                .filter(|((_, place), _)| (first..end).contains(&(*place as usize)))
            {
                shares[*place as usize - first] = weight / allowed(*kind);
            }
            // The end is filled up to whole fours.
            shares.truncate(shares.iter().rposition(|share| *share != 0.0).map_or(0, |last| last + 1));
            (areas.moved(first as u32) as usize, shares)
        };
        self.judged =
            [shares(factored.cells, factored.multipliers), shares(factored.multipliers, factored.pivots)];
        let none = Wide::splat(self.simd, 0.0);
        let pivot = |&(step, row, column): &(u32, u32, u32)| {
            (areas.moved(written[step as usize].1), [row, column], none)
        };
        self.pivots = recording.watched.iter().map(pivot).collect();
        // Places beyond values, right sides and solutions hold constants, or numbers that are computed before
        // they are read.
        self.memory.truncate(areas.end);
        self.memory
            .extend(self.recorder.memory.iter().skip(zero as usize + 1).map(|x| Wide::splat(self.simd, *x)));
        self.small = areas.moved(factored.end as u32) as usize <= SMALL;
        self.memory.resize(if self.small { SMALL } else { self.memory.len() }, none);
        for place in
            [&self.correct, &self.velocity, &self.acceleration].into_iter().flat_map(|replay| &replay.zeros)
        {
            self.memory[*place as usize] = none;
        }
        (self.weighted, self.best) = (false, Wide::splat(self.simd, f64::INFINITY));
    }
}
