//! The last few times of all lanes, until they are appended to the motions: what came time by time for all lanes goes on lane by lane.

use pulp::NullaryFnOnce;

use crate::lanes::{Level, Mask, Wide};
use crate::motion::Motion;

/// Times that are kept: few, so that they are still at hand, and a multiple of 4.
const TIMES: usize = 8;

/// What is kept of each time: q, q̇, q̈, the largest residual and the number of Newton steps.
const KINDS: usize = 5;

pub(super) struct Kept<S: Level> {
    simd: S,
    times: Vec<f64>,
    kinds: [Vec<Wide<S>>; KINDS],
    /// The same lane by lane, in fours.
    own: [Vec<[f64; 4]>; KINDS],
    /// The largest residual of each lane so far, and its row.
    largest: Wide<S>,
    worst: Vec<usize>,
}

impl<S: Level> Kept<S> {
    /// For n coordinates.
    pub(super) fn new(simd: S, n: usize) -> Self {
        let room = [n, n, n, 1, 1];
        Kept {
            simd,
            times: Vec::with_capacity(TIMES),
            kinds: room.map(|n| Vec::with_capacity(TIMES * n)),
            own: room.map(|n| Vec::with_capacity(TIMES * n * Wide::<S>::LANES / 4 + 1)),
            largest: Wide::splat(simd, -1.0),
            worst: vec![0; Wide::<S>::LANES],
        }
    }

    /// Forgets everything, for other cases.
    pub(super) fn begin(&mut self) {
        self.largest = Wide::splat(self.simd, -1.0);
    }

    /// Keeps one more time: q, q̇, q̈, and C with its size and the number of Newton steps; true where it is time to append.
    pub(super) fn keep(&mut self, t: f64, coordinates: [&[Wide<S>]; 3], c: &[Wide<S>], residual: Wide<S>, steps: Wide<S>) -> bool {
        self.times.push(t);
        for (kept, now) in self.kinds.iter_mut().zip(coordinates.into_iter().chain([&[residual][..], &[steps]])) {
            kept.extend_from_slice(now);
        }
        let grown = residual.gt(self.largest);
        if grown.any() {
            self.note(grown, c, residual);
        }
        self.times.len() >= TIMES
    }

    /// The row of the residual where it is the largest so far.
    fn note(&mut self, grown: Mask<S>, c: &[Wide<S>], residual: Wide<S>) {
        self.largest = grown.select(residual, self.largest);
        for (lane, worst) in self.worst.iter_mut().enumerate().filter(|(lane, _)| grown.lane(*lane)) {
            let row = c.iter().position(|c| c.as_slice()[lane].abs() == residual.as_slice()[lane]);
            *worst = row.unwrap_or_default();
        }
    }

    /// Appends what was kept to the motions, one a lane.
    pub(super) fn flush(&mut self, motions: &mut [Motion]) {
        self.simd.vectorize(Turn(self));
        for (lane, motion) in motions.iter_mut().enumerate() {
            let own = |k: usize| {
                let (count, fours) = (self.kinds[k].len(), self.kinds[k].len().div_ceil(4));
                self.own[k][lane * fours..][..fours].as_flattened().split_at(count).0
            };
            motion.push_all(&self.times, std::array::from_fn(own), (self.largest.as_slice()[lane], self.worst[lane]));
        }
        self.times.clear();
        self.kinds.iter_mut().for_each(Vec::clear);
    }
}

/// What was kept on its way into the function that has the machine's instructions.
struct Turn<'k, S: Level>(&'k mut Kept<S>);

impl<S: Level> NullaryFnOnce for Turn<'_, S> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (all, own) in self.0.kinds.iter().zip(&mut self.0.own) {
            turn(self.0.simd, all, own);
        }
    }
}

/// From numbers over lanes to lanes of numbers, each filled up to a multiple of 4: by squares of four numbers and four lanes.
#[inline(always)]
fn turn<S: Level>(simd: S, all: &[Wide<S>], own: &mut Vec<[f64; 4]>) {
    let fours = all.len().div_ceil(4);
    own.resize(Wide::<S>::LANES * fours, [0.0; 4]);
    let (squares, rest) = if Wide::<S>::LANES.is_multiple_of(4) { all.as_chunks::<4>() } else { (&[][..], all) };
    for (lanes, rows) in own.chunks_exact_mut((4 * fours).max(1)).enumerate() {
        let (first, rest) = rows.split_at_mut(2 * fours);
        let ((one, two), (three, four)) = (first.split_at_mut(fours), rest.split_at_mut(fours));
        for ((((square, one), two), three), four) in squares.iter().zip(one).zip(two).zip(three).zip(four) {
            let [a, b, c, d] = square;
            [*one, *two, *three, *four] = simd.turn([of(a, lanes), of(b, lanes), of(c, lanes), of(d, lanes)]);
        }
    }
    for (k, x) in (4 * squares.len()..).zip(rest) {
        for (lane, x) in x.as_slice().iter().enumerate() {
            own[lane * fours + k / 4][k % 4] = *x;
        }
    }
}

/// Four of the lanes.
#[inline(always)]
fn of<S: Level>(x: &Wide<S>, lanes: usize) -> [f64; 4] {
    x.as_slice().as_chunks().0[lanes]
}
