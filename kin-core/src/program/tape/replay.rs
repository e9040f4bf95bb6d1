//! A tape replayed over lanes.

use std::marker::PhantomData;

use kin_graph::{Comparison, Function, Function2};
use pulp::NullaryFnOnce;

use super::{Kind, Run, SHORT, Stage, Step};
use crate::model::law::Law;
use crate::numbers::lanes::{Level, Mask, Wide};

/// A stage on its way into the function that has the machine's instructions.
pub(in crate::program) struct Replay<'a, S: Level> {
    pub stage: &'a Stage,
    pub laws: &'a [Law],
    pub memory: &'a mut [Wide<S>],
    pub level: PhantomData<S>,
}

impl<S: Level> NullaryFnOnce for Replay<'_, S> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Replay { stage, laws, memory, .. } = self;
        match memory.first_chunk_mut::<SHORT>() {
            Some(memory) if !stage.short.is_empty() => all(&stage.runs, &stage.short, laws, memory),
            _ => all(&stage.runs, &stage.steps, laws, memory),
        }
    }
}

/// A memory, and how its places are told.
trait Places<S: Level> {
    type Place: Copy;
    fn get(&self, place: Self::Place) -> Wide<S>;
    fn put(&mut self, place: Self::Place, number: Wide<S>);
}

macro_rules! places {
    ($memory:ty, $place:ty) => {
        impl<S: Level> Places<S> for $memory {
            type Place = $place;

            #[inline(always)]
            fn get(&self, place: $place) -> Wide<S> {
                self[place as usize]
            }

            #[inline(always)]
            fn put(&mut self, place: $place, number: Wide<S>) {
                self[place as usize] = number;
            }
        }
    };
}

places!([Wide<S>], u32);
places!([Wide<S>; SHORT], u8);

/// Run by run.
#[inline(always)]
fn all<S: Level, M: Places<S> + ?Sized>(
    runs: &[Run],
    mut steps: &[Step<M::Place>],
    laws: &[Law],
    memory: &mut M,
) {
    for Run { kind, steps: count } in runs {
        let (own, rest) = steps.split_at(*count as usize);
        steps = rest;
        run(*kind, own, laws, memory);
    }
}

/// The steps of one run.
#[inline(always)]
fn run<S: Level, M: Places<S> + ?Sized>(kind: Kind, steps: &[Step<M::Place>], laws: &[Law], memory: &mut M) {
    match kind {
        Kind::Add => two(steps, memory, |a, b| a + b),
        Kind::Sub => two(steps, memory, |a, b| a - b),
        Kind::Mul => two(steps, memory, |a, b| a * b),
        Kind::Div => two(steps, memory, |a, b| a / b),
        Kind::Neg => one(steps, memory, |a| -a),
        Kind::Fma => three(steps, memory, |a, b, c| a.mul_add(b, c)),
        Kind::NegatedProduct => three(steps, memory, |a, b, c| a.negative_mul_add(b, c)),
        Kind::ProductLess => three(steps, memory, |a, b, c| a.mul_add(b, -c)),
        Kind::NegatedSum => three(steps, memory, |a, b, c| -a.mul_add(b, c)),
        Kind::LargerProduct => three(steps, memory, |a, b, c| c.max((a * b).abs())),
        Kind::SinCos => {
            for step in steps {
                let (sin, cos) = memory.get(step.a).sin_cos();
                memory.put(step.out, sin);
                memory.put(step.c, cos);
            }
        }
        Kind::One(Function::Sqrt) => one(steps, memory, Wide::sqrt),
        Kind::One(Function::Abs) => one(steps, memory, Wide::abs),
        Kind::Two(Function2::Max) => two(steps, memory, Wide::max),
        Kind::Two(Function2::Min) => two(steps, memory, Wide::min),
        Kind::Power(n) => one(steps, memory, |a| a.powi(n)),
        Kind::Compare(comparison) => two(steps, memory, |a, b| compare(comparison, a, b).as_numbers()),
        Kind::Both => two(steps, memory, |a, b| a * b),
        Kind::Either => two(steps, memory, Wide::or_larger),
        Kind::Not => one(steps, memory, |a| a.all(1.0) - a),
        Kind::Select => three(steps, memory, |c, a, b| c.is_true().select(a, b)),
        Kind::One(f) => one_by_one(f, steps, memory),
        Kind::Two(f) => two_by_two(f, steps, memory),
        Kind::Law(law, order) => ask(laws.get(law as usize), order, steps, memory),
    }
}

#[inline(always)]
fn one<S: Level, M: Places<S> + ?Sized>(
    steps: &[Step<M::Place>],
    memory: &mut M,
    f: impl Fn(Wide<S>) -> Wide<S>,
) {
    for step in steps {
        memory.put(step.out, f(memory.get(step.a)));
    }
}

#[inline(always)]
fn two<S: Level, M: Places<S> + ?Sized>(
    steps: &[Step<M::Place>],
    memory: &mut M,
    f: impl Fn(Wide<S>, Wide<S>) -> Wide<S>,
) {
    for step in steps {
        memory.put(step.out, f(memory.get(step.a), memory.get(step.b)));
    }
}

#[inline(always)]
fn three<S: Level, M: Places<S> + ?Sized>(
    steps: &[Step<M::Place>],
    memory: &mut M,
    f: impl Fn(Wide<S>, Wide<S>, Wide<S>) -> Wide<S>,
) {
    for step in steps {
        memory.put(step.out, f(memory.get(step.a), memory.get(step.b), memory.get(step.c)));
    }
}

#[inline(always)]
fn compare<S: Level>(comparison: Comparison, a: Wide<S>, b: Wide<S>) -> Mask<S> {
    match comparison {
        Comparison::Less => a.lt(b),
        Comparison::LessEqual => a.le(b),
        Comparison::Greater => a.gt(b),
        Comparison::GreaterEqual => a.ge(b),
        Comparison::Equal => a.equal(b),
        Comparison::NotEqual => a.differ(b),
    }
}

/// A function that goes lane by lane: a function of its own, for it calls others anyway.
#[inline(never)]
fn one_by_one<S: Level, M: Places<S> + ?Sized>(f: Function, steps: &[Step<M::Place>], memory: &mut M) {
    let value = f.value();
    one(steps, memory, |a| a.map(value));
}

#[inline(never)]
fn two_by_two<S: Level, M: Places<S> + ?Sized>(f: Function2, steps: &[Step<M::Place>], memory: &mut M) {
    let value = f.value();
    two(steps, memory, |a, b| a.map2(b, value));
}

/// A derivative of a law and the two that follow it; not a number where that is not known.
#[inline(never)]
fn ask<S: Level, M: Places<S> + ?Sized>(
    law: Option<&Law>,
    order: u8,
    steps: &[Step<M::Place>],
    memory: &mut M,
) {
    for step in steps {
        let x = memory.get(step.a);
        let mut jet = [x; 3];
        for (lane, x) in x.as_slice().iter().enumerate() {
            let [f, f1, f2, f3] = law.map_or([f64::NAN; 4], |law| law.jet(*x));
            let own = if order == 0 {
                [f, f1, f2]
            } else {
                [f3, law.map_or(f64::NAN, |law| law.fourth(*x)), f64::NAN]
            };
            jet.iter_mut().zip(own).for_each(|(wide, number)| wide.as_mut_slice()[lane] = number);
        }
        [step.out, step.b, step.c].into_iter().zip(jet).for_each(|(place, number)| memory.put(place, number));
    }
}
