//! Runs a tape without stages over all times of a motion.
//!
//! The inputs and outputs of the tape are rows of lists, one row for each time.

use kin_graph::Input;
use pulp::NullaryFnOnce;

use super::replay::Replay;
use super::{SHORT, Stage};
use crate::law::Law;
use crate::numbers::lanes::{Lanes, Level, Mask, Wide, WithLevel};

/// A time is returned to the caller if a guard falls below this share of its mark. \[-\]
const LEAST: f64 = 0.02;

/// The side of the tiles that are transposed in registers, and the number of tiles that equals the
/// largest number of lanes.
const SIDE: usize = 4;
const MOST: usize = 4;

/// Steps from inputs to outputs, on a memory of `places` numbers.
#[derive(Debug)]
pub(crate) struct Straight {
    pub(in crate::program) stage: Stage,
    pub(in crate::program) laws: Vec<Law>,
    pub(in crate::program) places: usize,
    pub(in crate::program) constants: Vec<(u32, f64)>,
    pub(in crate::program) inputs: Vec<(Input, u32)>,
    pub(in crate::program) outputs: Vec<u32>,
}

/// A list with a row of this many numbers for each time.
pub(crate) type Rows<'a> = (&'a [f64], usize);

/// A tape to be run over the times of a motion. Its first outputs are guards, one for each mark,
/// then pairs of a number and its limit.
pub(crate) struct OverTimes<'a, K> {
    pub tape: &'a Straight,
    pub times: usize,
    /// Returns the list and the column of each input; an input without a list is NaN.
    pub port: &'a dyn Fn(Input) -> Option<(Rows<'a>, usize)>,
    pub marks: &'a [f64],
    /// The number of pairs.
    pub limited: usize,
    pub sink: K,
}

/// The receiver of the outputs after the guards.
pub(crate) trait Sink {
    /// Receives some lanes; the first one belongs to time `first`. Lanes that are not good must be
    /// ignored.
    fn take<S: Level>(
        &mut self,
        simd: S,
        outputs: Outputs<'_, S>,
        first: usize,
        lanes: (usize, Mask<S>),
    );
}

/// The outputs after the guards, in all lanes.
#[derive(Clone, Copy)]
pub(crate) struct Outputs<'a, S: Level> {
    memory: &'a [Wide<S>],
    places: &'a [u32],
}

impl<S: Level> Outputs<'_, S> {
    #[inline(always)]
    fn of(&self, k: usize) -> &[f64] {
        self.memory[self.places[k] as usize].as_slice()
    }
}

#[cfg(test)]
impl Straight {
    /// Returns the number of steps.
    pub(crate) fn size(&self) -> usize {
        self.stage.steps.len()
    }
}

impl<K: Sink> OverTimes<'_, K> {
    /// Runs all times and returns those that are not good, in order: a guard is small, a number
    /// exceeds its limit, or an output is not finite. Returns `None` if the machine has no SIMD.
    pub(crate) fn run(self) -> Option<Vec<usize>> {
        Lanes::Best.dispatch(self).ok()
    }
}

impl<K: Sink> WithLevel for OverTimes<'_, K> {
    type Output = Vec<usize>;

    fn run<S: Level>(self, simd: S) -> Vec<usize> {
        let tape = self.tape;
        // One place more than the tape has: unread inputs are written there.
        let unread = tape.places.max(SHORT);
        let mut memory = vec![Wide::splat(simd, f64::NAN); unread + 1];
        tape.constants
            .iter()
            .for_each(|(place, x)| memory[*place as usize] = Wide::splat(simd, *x));
        let ports = Ports::new(tape, self.port, unread as u32);
        let mut bad = Vec::new();
        simd.vectorize(Passing {
            all: self,
            simd,
            memory: &mut memory,
            ports: &ports,
            bad: &mut bad,
        });
        bad
    }
}

/// The lists and columns of the inputs of a tape.
struct Ports<'a> {
    /// All inputs, as (list, column, place).
    all: Vec<(Rows<'a>, usize, u32)>,
    /// The inputs in lists with long enough rows, grouped by neighbouring columns.
    tiles: Vec<Tile<'a>>,
    /// The other inputs.
    single: Vec<(Rows<'a>, usize, u32)>,
}

/// Neighbouring columns of a list from index `first` on, with their places. Columns that are no
/// inputs have a place that nothing reads.
struct Tile<'a> {
    /// The list that contains the columns.
    rows: Rows<'a>,
    /// The index of the first column in a row of the list.
    first: usize,
    /// The place of each column on the tape.
    places: [u32; SIDE],
}

impl<'a> Ports<'a> {
    /// Sorts the inputs. `unread` is a place that nothing reads.
    fn new(
        tape: &Straight,
        port: &'a dyn Fn(Input) -> Option<(Rows<'a>, usize)>,
        unread: u32,
    ) -> Self {
        let own = tape.inputs.iter().filter_map(|(input, place)| Some((port(*input)?, *place)));
        let mut all: Vec<(Rows<'a>, usize, u32)> =
            own.map(|((rows, column), place)| (rows, column, place)).collect();
        all.sort_by_key(|(rows, column, _)| (rows.0.as_ptr() as usize, *column));
        let mut tiles = Vec::<Tile<'a>>::new();
        let mut single = Vec::new();
        for &(rows, column, place) in &all {
            let Some(last) = rows.1.checked_sub(SIDE) else {
                single.push((rows, column, place));
                continue;
            };
            let known = tiles.last_mut().filter(|tile| std::ptr::eq(tile.rows.0, rows.0));
            match known.filter(|tile| column < tile.first + SIDE) {
                Some(tile) => tile.places[column - tile.first] = place,
                None => {
                    let first = column.min(last);
                    let mut places = [unread; SIDE];
                    places[column - first] = place;
                    tiles.push(Tile { rows, first, places });
                }
            }
        }
        Ports { all, tiles, single }
    }

    /// Reads some lanes; the first one belongs to time `first`.
    #[inline(always)]
    fn read<S: Level>(&self, simd: S, memory: &mut [Wide<S>], first: usize, lanes: usize) {
        let whole = lanes == Wide::<S>::LANES;
        for ((list, width), column, place) in if whole { &self.single } else { &self.all } {
            let own = memory[*place as usize].as_mut_slice();
            for (lane, own) in own.iter_mut().enumerate().take(lanes) {
                *own = list[(first + lane) * width + column];
            }
        }
        if whole {
            for tile in &self.tiles {
                tile.read(simd, memory, first);
            }
        }
    }
}

impl Tile<'_> {
    /// Reads all lanes, by tiles that are transposed in registers.
    #[inline(always)]
    fn read<S: Level>(&self, simd: S, memory: &mut [Wide<S>], first: usize) {
        let (list, width) = self.rows;
        let mut turned = [[[0.0; SIDE]; SIDE]; MOST];
        let rows = &list[first * width + self.first..];
        for lane in 0..Wide::<S>::LANES {
            let row = rows.get(lane * width..).and_then(|row| row.first_chunk::<SIDE>());
            if let Some(row) = row {
                turned[lane / SIDE][lane % SIDE] = *row;
            }
        }
        turned.iter_mut().take(Wide::<S>::LANES / SIDE).for_each(|part| *part = simd.turn(*part));
        for (k, place) in self.places.iter().enumerate() {
            let own = memory[*place as usize].as_mut_slice();
            for (own, turned) in own.chunks_exact_mut(SIDE).zip(&turned) {
                own.copy_from_slice(&turned[k]);
            }
        }
    }
}

/// All times, passed to the function that uses the machine's SIMD instructions.
struct Passing<'x, 'a, S: Level, K> {
    all: OverTimes<'a, K>,
    simd: S,
    memory: &'x mut [Wide<S>],
    ports: &'x Ports<'a>,
    bad: &'x mut Vec<usize>,
}

impl<S: Level, K: Sink> NullaryFnOnce for Passing<'_, '_, S, K> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Passing { mut all, simd, memory, ports, bad } = self;
        let tape = all.tape;
        for first in (0..all.times).step_by(Wide::<S>::LANES) {
            let lanes = (all.times - first).min(Wide::<S>::LANES);
            ports.read(simd, memory, first, lanes);
            simd.vectorize(Replay { stage: &tape.stage, laws: &tape.laws, memory });
            let good = judged(simd, memory, &tape.outputs, (all.marks, all.limited));
            if (!good).any() {
                bad.extend((0..lanes).filter(|lane| !good.lane(*lane)).map(|lane| first + lane));
            }
            let judged = all.marks.len() + 2 * all.limited;
            let outputs = Outputs { memory, places: &tape.outputs[judged..] };
            all.sink.take(simd, outputs, first, (lanes, good));
        }
    }
}

/// Returns the lanes in which no guard is small relative to its mark, no number exceeds its limit,
/// and all outputs are finite.
#[inline(always)]
fn judged<S: Level>(
    simd: S,
    memory: &[Wide<S>],
    outputs: &[u32],
    (marks, limited): (&[f64], usize),
) -> Mask<S> {
    let zero = Wide::splat(simd, 0.0);
    let mut good = Mask::splat(simd, true);
    let mut none = zero;
    for (place, mark) in outputs.iter().zip(marks) {
        good = good & memory[*place as usize].abs().ge(Wide::splat(simd, LEAST * mark.abs()));
    }
    for pair in outputs[marks.len()..][..2 * limited].chunks_exact(2) {
        good = good & memory[pair[1] as usize].ge(memory[pair[0] as usize].abs());
    }
    for place in &outputs[marks.len()..] {
        let x = memory[*place as usize];
        // 0 · x is 0 for a finite x, otherwise NaN.
        none = none + x * zero;
    }
    good & none.equal(zero)
}

/// Lists of rows with their numbers of columns. The outputs fill list after list.
pub(crate) struct IntoRows<'a>(pub Vec<(&'a mut [f64], usize)>);

impl Sink for IntoRows<'_> {
    #[inline(always)]
    fn take<S: Level>(
        &mut self,
        simd: S,
        outputs: Outputs<'_, S>,
        first: usize,
        (lanes, _): (usize, Mask<S>),
    ) {
        let mut before = 0;
        for (list, width) in &mut self.0 {
            let width = *width;
            let rows = Turning { simd, outputs, width, lanes, first: before };
            before += width;
            let to = &mut list[first * width..][..lanes * width];
            if width == 1 {
                let own = outputs.of(rows.first);
                // A copy of known length needs no call.
                match to.len() == Wide::<S>::LANES {
                    true => to[..Wide::<S>::LANES].copy_from_slice(&own[..Wide::<S>::LANES]),
                    false => to.copy_from_slice(&own[..lanes]),
                }
                continue;
            }
            match width {
                2 => rows.turn::<2>(0, to),
                3 => rows.turn::<3>(0, to),
                _ => rows.turn_all(to),
            }
        }
    }
}

/// The outputs from index `first` on, to be written into rows of `width`.
#[derive(Clone, Copy)]
struct Turning<'a, S: Level> {
    simd: S,
    outputs: Outputs<'a, S>,
    /// The number of values in one row.
    width: usize,
    /// The number of lanes, each of which is one row.
    lanes: usize,
    /// The index of the first output.
    first: usize,
}

impl<S: Level> Turning<'_, S> {
    /// Transposes all columns; the last ones may be written twice.
    #[inline(always)]
    fn turn_all(&self, rows: &mut [f64]) {
        // Stepped iterators divide first, which costs more than the transposition.
        let mut column = 0;
        while column < self.width {
            self.turn::<SIDE>(column.min(self.width - SIDE), rows);
            column += SIDE;
        }
    }

    /// Transposes some columns from `column` on, by tiles in registers.
    #[inline(always)]
    fn turn<const WIDTH: usize>(&self, column: usize, rows: &mut [f64]) {
        let Turning { simd, outputs, width, lanes, first } = *self;
        // Lines beyond the last column are transposed without effect.
        let mut lines = [outputs.of(first + column); SIDE];
        for (k, line) in lines.iter_mut().enumerate().take(WIDTH) {
            *line = outputs.of(first + column + k);
        }
        let mut lane = 0;
        while lane < lanes {
            let mut square = [[0.0; SIDE]; SIDE];
            for (own, line) in square.iter_mut().zip(lines) {
                own.copy_from_slice(&line[lane..][..SIDE]);
            }
            for (k, own) in simd.turn(square).iter().enumerate().take(lanes - lane) {
                rows[(lane + k) * width + column..][..WIDTH].copy_from_slice(&own[..WIDTH]);
            }
            lane += SIDE;
        }
    }
}

/// The sum of each output over all good times, in order.
pub(crate) struct Summed<'a>(pub &'a mut [f64]);

impl Sink for Summed<'_> {
    #[inline(always)]
    fn take<S: Level>(
        &mut self,
        simd: S,
        outputs: Outputs<'_, S>,
        _: usize,
        (lanes, good): (usize, Mask<S>),
    ) {
        let zero = Wide::splat(simd, 0.0);
        for (k, sum) in self.0.iter_mut().enumerate() {
            let own = good.select(outputs.memory[outputs.places[k] as usize], zero);
            own.as_slice().iter().take(lanes).for_each(|x| *sum += x);
        }
    }
}
