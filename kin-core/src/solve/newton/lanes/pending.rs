//! The last few times of all lanes, until they are appended to the motions: what came time by time for all
//! lanes goes on lane by lane.

use pulp::NullaryFnOnce;

use crate::numbers::lanes::{Level, Wide, whole};
use crate::solve::motion::Motion;

/// Times that are kept, a multiple of 4: with fewer the motions are written in pieces too short for the
/// memory, with more what is kept is not at hand any more.
const TIMES: usize = 16;

/// The numbers kept of each time: q, q̇, q̈, the largest residual and the number of Newton steps.
const KINDS: usize = 5;

pub(super) struct Pending<S: Level> {
    simd: S,
    /// How many times are kept.
    times: usize,
    kinds: [Vec<Wide<S>>; KINDS],
    /// The same lane by lane, in fours.
    own: [Vec<[f64; 4]>; KINDS],
    /// The largest residual of each lane so far, and C there.
    largest: Wide<S>,
    worst: Vec<Wide<S>>,
}

impl<S: Level> Pending<S> {
    /// For n coordinates.
    pub(super) fn new(simd: S, n: usize) -> Self {
        let room = [n, n, n, 1, 1].map(|n| TIMES * n);
        Pending {
            simd,
            times: 0,
            kinds: room.map(|n| vec![Wide::splat(simd, 0.0); n]),
            own: room.map(|n| vec![[0.0; 4]; Wide::<S>::LANES * n / 4]),
            largest: Wide::splat(simd, -1.0),
            worst: vec![Wide::splat(simd, 0.0); n],
        }
    }

    /// Forgets everything, for other cases.
    pub(super) fn begin(&mut self) {
        (self.times, self.largest) = (0, Wide::splat(self.simd, -1.0));
    }

    /// Keeps one more time: q, q̇, q̈, and C with its size and the number of Newton steps; true where it is
    /// time to append.
    #[inline(always)]
    pub(super) fn keep(
        &mut self,
        [q, qd, qdd, c]: [&[Wide<S>]; 4],
        residual: Wide<S>,
        steps: Wide<S>,
    ) -> bool {
        for (kept, now) in self.kinds.iter_mut().zip([q, qd, qdd, &[residual], &[steps]]) {
            kept[self.times * now.len()..][..now.len()].copy_from_slice(now);
        }
        self.times += 1;
        let grown = residual.gt(self.largest);
        if grown.any() {
            self.largest = grown.select(residual, self.largest);
            for (worst, c) in self.worst.iter_mut().zip(c) {
                *worst = grown.select(*c, *worst);
            }
        }
        self.times == TIMES
    }

    /// Appends what was kept to the motions, one a lane.
    pub(super) fn flush(&mut self, motions: &mut [Motion]) {
        self.simd.vectorize(Turn(self));
        for (lane, motion) in motions.iter_mut().enumerate() {
            let own = |k: usize| {
                let count = self.kinds[k].len() / TIMES * self.times;
                let quads = count.div_ceil(4);
                self.own[k][lane * quads..][..quads].as_flattened().split_at(count).0
            };
            let [q, qd, qdd, residuals, steps] = std::array::from_fn(own);
            motion.push_all([q, qd, qdd, residuals], steps.iter().map(|steps| whole(*steps)));
        }
        self.times = 0;
    }

    /// Completes the motions, which have come to the end of these times.
    pub(super) fn complete(&self, times: &[f64], motions: &mut [Motion]) {
        for (lane, motion) in motions.iter_mut().enumerate() {
            let largest = self.largest.as_slice()[lane];
            let row = self.worst.iter().position(|c| c.as_slice()[lane].abs() == largest);
            motion.complete(times, (largest, row.unwrap_or_default()));
        }
    }
}

/// Pending results on their way into the function that has the machine's instructions.
struct Turn<'k, S: Level>(&'k mut Pending<S>);

impl<S: Level> NullaryFnOnce for Turn<'_, S> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Pending { simd, times, kinds, own, .. } = self.0;
        for (all, own) in kinds.iter().zip(own) {
            turn(*simd, &all[..all.len() / TIMES * *times], own);
        }
    }
}

/// From numbers over lanes to lanes of numbers, each filled up to a multiple of 4: by blocks of four numbers
/// and four lanes.
#[inline(always)]
fn turn<S: Level>(simd: S, all: &[Wide<S>], own: &mut [[f64; 4]]) {
    let quads = all.len().div_ceil(4);
    let own = &mut own[..Wide::<S>::LANES * quads];
    let (blocks, rest) =
        if Wide::<S>::LANES.is_multiple_of(4) { all.as_chunks::<4>() } else { (&[][..], all) };
    for (lanes, rows) in own.chunks_exact_mut((4 * quads).max(1)).enumerate() {
        let (first, rest) = rows.split_at_mut(2 * quads);
        let ((one, two), (three, four)) = (first.split_at_mut(quads), rest.split_at_mut(quads));
        for ((((block, one), two), three), four) in blocks.iter().zip(one).zip(two).zip(three).zip(four) {
            let [a, b, c, d] = block;
            [*one, *two, *three, *four] = simd.turn([of(a, lanes), of(b, lanes), of(c, lanes), of(d, lanes)]);
        }
    }
    for (k, x) in (4 * blocks.len()..).zip(rest) {
        for (lane, x) in x.as_slice().iter().enumerate() {
            own[lane * quads + k / 4][k % 4] = *x;
        }
    }
}

/// Quad of the lanes.
#[inline(always)]
fn of<S: Level>(x: &Wide<S>, lanes: usize) -> [f64; 4] {
    x.as_slice().as_chunks().0[lanes]
}
