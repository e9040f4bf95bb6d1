//! From lanes to times: the lines of coordinates become rows of all coordinates, one a time.

use std::ops::Range;

use pulp::NullaryFnOnce;

use super::times::{ORDERS, Times};
use crate::numbers::lanes::Level;

/// The side of the squares that are turned in registers.
const SIDE: usize = 4;

impl<S: Level> Times<S> {
    /// Appends q, q̇, q̈ and, where it is asked for, q⃛ in some lanes to these lists, a row a lane.
    pub(crate) fn append(&self, lanes: Range<usize>, lists: [&mut Vec<f64>; ORDERS + 1]) {
        self.simd.vectorize(Turning { times: self, lanes, lists });
    }

    /// q in a lane, into a list.
    pub(crate) fn position(&self, lane: usize, list: &mut Vec<f64>) {
        list.clear();
        list.extend((0..self.tape().values.len()).map(|column| self.of(column, 0)[lane]));
    }
}

/// Lanes on their way into the function that has the machine's instructions.
struct Turning<'x, S: Level> {
    times: &'x Times<S>,
    lanes: Range<usize>,
    lists: [&'x mut Vec<f64>; ORDERS + 1],
}

impl<S: Level> NullaryFnOnce for Turning<'_, S> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Turning { times, lanes, lists: [q, qd, qdd, qddd] } = self;
        let all = &times.lines[..];
        for (order, list) in [q, qd, qdd].into_iter().enumerate() {
            times.turn_all(&all[Times::<S>::line(0, order)..], ORDERS * Times::<S>::STRIDE, &lanes, list);
        }
        if !times.tape().third_rates.is_empty() {
            times.turn_all(&all[times.line_of(0, ORDERS)..], Times::<S>::STRIDE, &lanes, qddd);
        }
    }
}

/// Room for so many numbers more, none of them a number yet.
#[inline(never)]
fn lengthen(list: &mut Vec<f64>, count: usize) {
    list.resize(list.len() + count, f64::NAN);
}

/// Four numbers from a place on.
#[inline(always)]
fn four(line: &[f64], place: usize) -> [f64; SIDE] {
    let mut own = [0.0; SIDE];
    own.copy_from_slice(&line[place..place + SIDE]);
    own
}

impl<S: Level> Times<S> {
    /// The lines of all coordinates, so many places apart, appended to a list as rows of these lanes.
    #[inline(always)]
    fn turn_all(&self, lines: &[f64], apart: usize, lanes: &Range<usize>, list: &mut Vec<f64>) {
        let (n, begun) = (self.tape().values.len(), list.len());
        lengthen(list, lanes.len() * n);
        let rows = &mut list[begun..];
        for first in (0..Self::LANES).step_by(SIDE) {
            let (from, to) = (first.max(lanes.start), (first + SIDE).min(lanes.end));
            if from < to {
                let own = &mut rows[(from - lanes.start) * n..(to - lanes.start) * n];
                if to - from == SIDE {
                    self.turn(lines, apart, first + 1, own);
                } else {
                    one_by_one(lines, apart, from + 1, own, n);
                }
            }
        }
    }

    /// Four rows, by squares that are turned in registers.
    #[inline(always)]
    fn turn(&self, lines: &[f64], apart: usize, place: usize, rows: &mut [f64]) {
        let n = rows.len() / SIDE;
        let (a, rest) = rows.split_at_mut(n);
        let (b, rest) = rest.split_at_mut(n);
        let (c, d) = rest.split_at_mut(n);
        let [a, b, c, d] = [a.as_chunks_mut(), b.as_chunks_mut(), c.as_chunks_mut(), d.as_chunks_mut()];
        let squares = a.0.iter_mut().zip(b.0).zip(c.0).zip(d.0);
        for (own, (((a, b), c), d)) in lines.chunks(SIDE * apart).zip(squares) {
            let square = [
                four(own, place),
                four(own, apart + place),
                four(own, 2 * apart + place),
                four(own, 3 * apart + place),
            ];
            [*a, *b, *c, *d] = self.simd.turn(square);
        }
        let left = a.1.iter_mut().zip(b.1).zip(c.1).zip(d.1);
        for (own, (((a, b), c), d)) in lines.chunks(apart).skip(n / SIDE * SIDE).zip(left) {
            [*a, *b, *c, *d] = four(own, place);
        }
    }
}

/// Fewer rows than four, of so many numbers.
#[inline(always)]
fn one_by_one(lines: &[f64], apart: usize, place: usize, rows: &mut [f64], n: usize) {
    for (k, row) in rows.chunks_exact_mut(n.max(1)).enumerate() {
        for (x, line) in row.iter_mut().zip(lines.chunks(apart)) {
            *x = line[place + k];
        }
    }
}
