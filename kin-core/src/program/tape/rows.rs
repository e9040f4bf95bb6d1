//! Converts lanes to times: the lines of coordinates become rows of all coordinates, one for each
//! time.

use std::ops::Range;

use pulp::NullaryFnOnce;

use super::times::{ORDERS, Times};
use crate::numbers::lanes::Level;

/// The side of the squares that are transposed in registers.
const SIDE: usize = 4;

impl<S: Level> Times<S> {
    /// Appends q, q̇, q̈, and q⃛ if it is computed, of some lanes to these lists, one row for each
    /// lane.
    pub(crate) fn append(&self, lanes: Range<usize>, lists: [&mut Vec<f64>; ORDERS + 1]) {
        self.simd.vectorize(Turning { times: self, lanes, lists });
    }

    /// Writes q of a lane into a list.
    pub(crate) fn position(&self, lane: usize, list: &mut Vec<f64>) {
        list.clear();
        list.extend((0..self.tape().values.len()).map(|column| self.of(column, 0)[lane]));
    }
}

/// Lanes, passed to the function that uses the machine's SIMD instructions.
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
            times.turn_all(
                &all[Times::<S>::line(0, order)..],
                ORDERS * Times::<S>::STRIDE,
                &lanes,
                list,
            );
        }
        if !times.tape().third_rates.is_empty() {
            times.turn_all(&all[times.line_of(0, ORDERS)..], Times::<S>::STRIDE, &lanes, qddd);
        }
    }
}

/// NaN to be copied in one piece; a loop that writes them takes four instructions each.
const NONE: [f64; 256] = [f64::NAN; 256];

/// Extends a list by this number of NaN.
#[inline(never)]
fn lengthen(list: &mut Vec<f64>, count: usize) {
    let mut left = count;
    while left > 0 {
        let part = left.min(NONE.len());
        list.extend_from_slice(&NONE[..part]);
        left -= part;
    }
}

// Places are counted by hand here: chunks and zips divide for their lengths, which costs more than
// the copy.
impl<S: Level> Times<S> {
    /// Appends the lines of all coordinates, `apart` places from each other, to a list as rows of
    /// these lanes.
    #[inline(always)]
    fn turn_all(&self, lines: &[f64], apart: usize, lanes: &Range<usize>, list: &mut Vec<f64>) {
        let n = self.tape().values.len();
        let begun = list.len();
        lengthen(list, lanes.len() * n);
        let rows = &mut list[begun..];
        let mut lane = lanes.start;
        let mut at = 0;
        while lane < lanes.end {
            let is_square = lane.is_multiple_of(SIDE) && lane + SIDE <= lanes.end;
            let count = if is_square { SIDE } else { 1 };
            let own = &mut rows[at..at + count * n];
            if is_square {
                self.turn(lines, apart, lane + 1, own);
            } else {
                own.iter_mut()
                    .enumerate()
                    .for_each(|(column, x)| *x = lines[column * apart + lane + 1]);
            }
            (lane, at) = (lane + count, at + count * n);
        }
    }

    /// Transposes four rows, by squares in registers.
    #[inline(always)]
    fn turn(&self, lines: &[f64], apart: usize, mut place: usize, rows: &mut [f64]) {
        let n = rows.len() / SIDE;
        let (a, rest) = rows.split_at_mut(n);
        let (b, rest) = rest.split_at_mut(n);
        let (c, d) = rest.split_at_mut(n);
        let mut rows = [a, b, c, d];
        let mut column = 0;
        while column + SIDE <= n {
            self.square::<SIDE>((lines, apart, place), &mut rows, column);
            (column, place) = (column + SIDE, place + SIDE * apart);
        }
        match n - column {
            1 => self.square::<1>((lines, apart, place), &mut rows, column),
            2 => self.square::<2>((lines, apart, place), &mut rows, column),
            3 => self.square::<3>((lines, apart, place), &mut rows, column),
            _ => {}
        }
    }

    /// Transposes a number of columns of each of four rows.
    #[inline(always)]
    fn square<const WIDTH: usize>(
        &self,
        (lines, apart, place): (&[f64], usize, usize),
        [a, b, c, d]: &mut [&mut [f64]; SIDE],
        column: usize,
    ) {
        let mut square = [[0.0; SIDE]; SIDE];
        let mut at = place;
        for own in &mut square[..WIDTH] {
            own.copy_from_slice(&lines[at..at + SIDE]);
            at += apart;
        }
        let [w, x, y, z] = self.simd.turn(square);
        a[column..column + WIDTH].copy_from_slice(&w[..WIDTH]);
        b[column..column + WIDTH].copy_from_slice(&x[..WIDTH]);
        c[column..column + WIDTH].copy_from_slice(&y[..WIDTH]);
        d[column..column + WIDTH].copy_from_slice(&z[..WIDTH]);
    }
}
