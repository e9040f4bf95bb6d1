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
        for (order, list) in [q, qd, qdd].into_iter().enumerate() {
            times.turn_all(|column| Times::<S>::line(column, order), &lanes, list);
        }
        if !times.tape().third_rates.is_empty() {
            times.turn_all(|column| times.line_of(column, ORDERS), &lanes, qddd);
        }
    }
}

/// Room for so many numbers more, none of them a number yet.
#[inline(never)]
fn lengthen(list: &mut Vec<f64>, count: usize) {
    list.extend(std::iter::repeat_n(f64::NAN, count));
}

impl<S: Level> Times<S> {
    /// The lines of all coordinates, which are at these places, appended to a list as rows of these lanes.
    #[inline(always)]
    fn turn_all(&self, line: impl Fn(usize) -> usize, lanes: &Range<usize>, list: &mut Vec<f64>) {
        let (n, begun) = (self.tape().values.len(), list.len());
        lengthen(list, lanes.len() * n);
        let rows = &mut list[begun..];
        for column in (0..n / SIDE * SIDE).step_by(SIDE) {
            self.turn::<SIDE>(&line, column, lanes, rows);
        }
        match n % SIDE {
            1 => self.turn::<1>(&line, n - 1, lanes, rows),
            2 => self.turn::<2>(&line, n - 2, lanes, rows),
            3 => self.turn::<3>(&line, n - 3, lanes, rows),
            _ => {}
        }
    }

    /// Some coordinates from `column` on into the rows of these lanes, by squares that are turned in
    /// registers.
    #[inline(always)]
    fn turn<const WIDTH: usize>(
        &self,
        line: &impl Fn(usize) -> usize,
        column: usize,
        lanes: &Range<usize>,
        rows: &mut [f64],
    ) {
        let n = self.tape().values.len();
        for first in (0..Self::LANES).step_by(SIDE) {
            let mut square = [[0.0; SIDE]; SIDE];
            for (k, own) in square.iter_mut().enumerate().take(WIDTH) {
                own.copy_from_slice(&self.lines[line(column + k) + 1 + first..][..SIDE]);
            }
            let turned = self.simd.turn(square);
            if lanes.start <= first && first + SIDE <= lanes.end {
                for (k, own) in turned.iter().enumerate() {
                    rows[(first + k - lanes.start) * n + column..][..WIDTH].copy_from_slice(&own[..WIDTH]);
                }
                continue;
            }
            for lane in first.max(lanes.start)..(first + SIDE).min(lanes.end) {
                let own = &turned[lane - first];
                rows[(lane - lanes.start) * n + column..][..WIDTH].copy_from_slice(&own[..WIDTH]);
            }
        }
    }
}
