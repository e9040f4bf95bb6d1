//! A tape without stages, over all times of a motion: what it reads and gives are rows of lists,
//! one a time.

use kin_graph::Input;
use pulp::NullaryFnOnce;

use super::replay::Replay;
use super::{SHORT, Stage};
use crate::model::law::Law;
use crate::numbers::lanes::{Lanes, Level, Mask, Wide, WithLevel};

/// A guard that is less than this share of its mark leaves a time to other ways.   \[-\]
const LEAST: f64 = 0.02;

/// The side of the tiles that are turned in registers, and how many of them are as long as any
/// number of lanes.
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

/// A list with a row of so many numbers for each time.
pub(crate) type Rows<'a> = (&'a [f64], usize);

/// A tape on its way over the times of a motion. Its first outputs are guards, one for each mark,
/// then pairs of a number and its limit.
pub(crate) struct OverTimes<'a, K> {
    pub tape: &'a Straight,
    pub times: usize,
    /// The list and the column of each input; an input that has none is not a number.
    pub port: &'a dyn Fn(Input) -> Option<(Rows<'a>, usize)>,
    pub marks: &'a [f64],
    /// The number of pairs.
    pub limited: usize,
    pub sink: K,
}

/// Where the outputs behind the guards go.
pub(crate) trait Sink {
    /// Takes some lanes, the first of them of time `first`. Lanes that are not good are of no use.
    fn take<S: Level>(
        &mut self,
        simd: S,
        outputs: Outputs<'_, S>,
        first: usize,
        lanes: (usize, Mask<S>),
    );
}

/// The outputs behind the guards, in all lanes.
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
    /// How many steps it has.
    pub(crate) fn size(&self) -> usize {
        self.stage.steps.len()
    }
}

impl<K: Sink> OverTimes<'_, K> {
    /// Hands over all times; gives those that are not good, in their order: where a guard is small,
    /// a number is beyond its limit, or an output is not finite. `None` where the machine has no
    /// lanes.
    pub(crate) fn run(self) -> Option<Vec<usize>> {
        Lanes::Best.dispatch(self).ok()
    }
}

impl<K: Sink> WithLevel for OverTimes<'_, K> {
    type Output = Vec<usize>;

    fn run<S: Level>(self, simd: S) -> Vec<usize> {
        let tape = self.tape;
        // One more than there are places: what is not read goes there.
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

/// The lists and columns that the inputs of a tape come from.
struct Ports<'a> {
    /// All of them: list, column and place.
    all: Vec<(Rows<'a>, usize, u32)>,
    /// Those of lists whose rows are long enough, by neighbouring columns.
    tiles: Vec<Tile<'a>>,
    /// The others.
    single: Vec<(Rows<'a>, usize, u32)>,
}

/// Neighbouring columns of a list from number `first` on, and where they go: all but the inputs
/// among them to a place that nothing reads.
struct Tile<'a> {
    rows: Rows<'a>,
    first: usize,
    places: [u32; SIDE],
}

impl<'a> Ports<'a> {
    /// `unread` is a place that nothing reads.
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

    /// Reads some lanes, the first of them of time `first`.
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
    /// Reads all lanes, by tiles that are turned in registers.
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

/// All times, on their way into the function that has the machine's instructions.
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

/// Where no guard is small beside its mark, no number is beyond its limit, and all outputs are
/// finite.
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
        // 0 · x is 0 of a number, and not a number of anything else.
        none = none + x * zero;
    }
    good & none.equal(zero)
}

/// Lists of rows with the number of columns of each, which the outputs fill list by list.
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
                // Of a length that is known it is no call.
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

/// Outputs from number `first` on, on their way into rows of `width`.
#[derive(Clone, Copy)]
struct Turning<'a, S: Level> {
    simd: S,
    outputs: Outputs<'a, S>,
    width: usize,
    lanes: usize,
    first: usize,
}

impl<S: Level> Turning<'_, S> {
    /// All columns; the last ones may be written twice.
    #[inline(always)]
    fn turn_all(&self, rows: &mut [f64]) {
        // Iterators by steps divide beforehand, which takes longer than the turning.
        let mut column = 0;
        while column < self.width {
            self.turn::<SIDE>(column.min(self.width - SIDE), rows);
            column += SIDE;
        }
    }

    /// Some columns from `column` on, by tiles that are turned in registers.
    #[inline(always)]
    fn turn<const WIDTH: usize>(&self, column: usize, rows: &mut [f64]) {
        let Turning { simd, outputs, width, lanes, first } = *self;
        // Lines beyond the last column are turned for nothing.
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

/// The sum of each output over all good times, in their order.
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
