//! A tape without stages, over all times of a motion: what it reads and gives are rows of lists, one a time.

use std::marker::PhantomData;

use kin_graph::Input;
use pulp::NullaryFnOnce;

use super::replay::Replay;
use super::{SHORT, Stage};
use crate::model::law::Law;
use crate::numbers::lanes::{Lanes, Level, Mask, Wide, WithLevel};

/// A guard that is less than this share of its mark leaves a time to other ways.   \[-\]
const LEAST: f64 = 0.02;

/// The side of the squares that are turned in registers.
const SIDE: usize = 4;

/// Steps from inputs to outputs, on a memory of `places` numbers.
#[derive(Debug)]
pub(crate) struct Straight {
    pub(super) stage: Stage,
    pub(super) laws: Vec<Law>,
    pub(super) places: usize,
    pub(super) constants: Vec<(u32, f64)>,
    pub(super) inputs: Vec<(Input, u32)>,
    pub(super) outputs: Vec<u32>,
}

/// A list with a row of so many numbers for each time.
pub(crate) type Rows<'a> = (&'a [f64], usize);

/// A tape on its way over the times of a motion. Its first outputs are guards, one for each mark.
pub(crate) struct OverTimes<'a, K> {
    pub tape: &'a Straight,
    pub times: usize,
    /// The list and the column of each input; an input that has none is not a number.
    pub port: &'a dyn Fn(Input) -> Option<(Rows<'a>, usize)>,
    pub marks: &'a [f64],
    pub sink: K,
}

/// Where the outputs behind the guards go.
pub(crate) trait Sink {
    /// Takes some lanes, the first of them of time `first`. Lanes that are not good are of no use.
    fn take<S: Level>(&mut self, simd: S, outputs: Outputs<'_, S>, first: usize, lanes: (usize, Mask<S>));
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
    /// Hands over all times; gives those that are not good, in their order: where a guard is small, or an
    /// output is not finite. `None` where the machine has no lanes.
    pub(crate) fn run(self) -> Option<Vec<usize>> {
        Lanes::Best.dispatch(self).ok()
    }
}

impl<K: Sink> WithLevel for OverTimes<'_, K> {
    type Output = Vec<usize>;

    fn run<S: Level>(self, simd: S) -> Vec<usize> {
        let tape = self.tape;
        let mut memory = vec![Wide::splat(simd, f64::NAN); tape.places.max(SHORT)];
        tape.constants.iter().for_each(|(place, x)| memory[*place as usize] = Wide::splat(simd, *x));
        let ports = tape.inputs.iter().filter_map(|(input, place)| Some(((self.port)(*input)?, *place)));
        let ports: Vec<(Rows<'_>, usize, u32)> =
            ports.map(|((rows, column), place)| (rows, column, place)).collect();
        let mut bad = Vec::new();
        simd.vectorize(Passing { all: self, simd, memory: &mut memory, ports: &ports, bad: &mut bad });
        bad
    }
}

/// All times, on their way into the function that has the machine's instructions.
struct Passing<'x, 'a, S: Level, K> {
    all: OverTimes<'a, K>,
    simd: S,
    memory: &'x mut [Wide<S>],
    ports: &'x [(Rows<'x>, usize, u32)],
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
            for ((list, width), column, place) in ports {
                let own = memory[*place as usize].as_mut_slice();
                let rows = list[first * width..].chunks_exact(*width).take(lanes);
                own.iter_mut().zip(rows).for_each(|(own, row)| *own = row[*column]);
            }
            simd.vectorize(Replay { stage: &tape.stage, laws: &tape.laws, memory, level: PhantomData });
            let good = judged(simd, memory, &tape.outputs, all.marks);
            bad.extend((0..lanes).filter(|lane| !good.lane(*lane)).map(|lane| first + lane));
            let outputs = Outputs { memory, places: &tape.outputs[all.marks.len()..] };
            all.sink.take(simd, outputs, first, (lanes, good));
        }
    }
}

/// Where no guard is small beside its mark and all outputs are finite.
#[inline(always)]
fn judged<S: Level>(simd: S, memory: &[Wide<S>], outputs: &[u32], marks: &[f64]) -> Mask<S> {
    let zero = Wide::splat(simd, 0.0);
    let (mut good, mut none) = (Mask::splat(simd, true), zero);
    for (place, mark) in outputs.iter().zip(marks) {
        good = good & memory[*place as usize].abs().ge(Wide::splat(simd, LEAST * mark.abs()));
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
            let rows = Turning { simd, outputs, width, first: before };
            before += width;
            let to = &mut list[first * width..][..lanes * width];
            if width == 1 {
                to.copy_from_slice(&outputs.of(rows.first)[..lanes]);
                continue;
            }
            for column in (0..width / SIDE * SIDE).step_by(SIDE) {
                rows.turn::<SIDE>(column, to);
            }
            let last = width / SIDE * SIDE;
            match width % SIDE {
                1 => rows.turn::<1>(last, to),
                2 => rows.turn::<2>(last, to),
                3 => rows.turn::<3>(last, to),
                _ => {}
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
    first: usize,
}

impl<S: Level> Turning<'_, S> {
    /// Some columns from `column` on, by squares that are turned in registers.
    #[inline(always)]
    fn turn<const WIDTH: usize>(&self, column: usize, rows: &mut [f64]) {
        let Turning { simd, outputs, width, first } = *self;
        // Lines beyond the last column are turned for nothing.
        let mut lines = [outputs.of(first + column); SIDE];
        for (k, line) in lines.iter_mut().enumerate().take(WIDTH) {
            *line = outputs.of(first + column + k);
        }
        let lanes = rows.len() / width;
        for lane in (0..lanes).step_by(SIDE) {
            let mut square = [[0.0; SIDE]; SIDE];
            for (own, line) in square.iter_mut().zip(lines) {
                own.copy_from_slice(&line[lane..][..SIDE]);
            }
            for (k, own) in simd.turn(square).iter().enumerate().take(lanes - lane) {
                rows[(lane + k) * width + column..][..WIDTH].copy_from_slice(&own[..WIDTH]);
            }
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
