//! Replays a tape over any type of number: one number for each lane, or a single number.

use kin_graph::{Comparison, Function, Function2};
use pulp::NullaryFnOnce;

use super::{Kind, Run, SHORT, Stage, Step};
use crate::law::Law;
use crate::numbers::lanes::lanewise::Computed;

/// A stage, passed to the function that uses the machine's SIMD instructions.
pub(in crate::program) struct Replay<'a, N> {
    pub stage: &'a Stage,
    pub laws: &'a [Law],
    pub memory: &'a mut [N],
}

impl<N: Computed> NullaryFnOnce for Replay<'_, N> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Replay { stage, laws, memory } = self;
        match memory.first_chunk_mut::<SHORT>() {
            Some(memory) if !stage.short.is_empty() => all(&stage.runs, &stage.short, laws, memory),
            _ => all(&stage.runs, &stage.steps, laws, memory),
        }
    }
}

/// A memory and its kind of places.
trait Places<N> {
    type Place: Copy;
    fn get(&self, place: Self::Place) -> N;
    fn put(&mut self, place: Self::Place, number: N);
}

macro_rules! places {
    ($memory:ty, $place:ty) => {
        impl<N: Copy> Places<N> for $memory {
            type Place = $place;

            #[inline(always)]
            fn get(&self, place: $place) -> N {
                self[place as usize]
            }

            #[inline(always)]
            fn put(&mut self, place: $place, number: N) {
                self[place as usize] = number;
            }
        }
    };
}

places!([N], u32);
places!([N; SHORT], u8);

/// Replays run by run.
#[inline(always)]
fn all<N: Computed, M: Places<N> + ?Sized>(
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

/// Replays the steps of one run.
#[inline(always)]
fn run<N: Computed, M: Places<N> + ?Sized>(
    kind: Kind,
    steps: &[Step<M::Place>],
    laws: &[Law],
    memory: &mut M,
) {
    match kind {
        Kind::Add => two(steps, memory, |a, b| a + b),
        Kind::Sub => two(steps, memory, |a, b| a - b),
        Kind::Mul => two(steps, memory, |a, b| a * b),
        Kind::Div => two(steps, memory, |a, b| a / b),
        Kind::Neg => one(steps, memory, |a| -a),
        Kind::Fma => three(steps, memory, |a, b, c| a.fused(b, c)),
        Kind::NegatedProduct => three(steps, memory, |a, b, c| a.fused_less(b, c)),
        Kind::ProductLess => three(steps, memory, |a, b, c| a.fused(b, -c)),
        Kind::NegatedSum => three(steps, memory, |a, b, c| -a.fused(b, c)),
        Kind::LargerProduct => three(steps, memory, |a, b, c| c.max((a * b).abs())),
        Kind::SinCos => {
            for step in steps {
                let (sin, cos) = memory.get(step.a).sin_cos();
                memory.put(step.out, sin);
                memory.put(step.c, cos);
            }
        }
        Kind::One(Function::Sqrt) => one(steps, memory, N::sqrt),
        Kind::One(Function::Abs) => one(steps, memory, N::abs),
        Kind::Two(Function2::Max) => two(steps, memory, N::max),
        Kind::Two(Function2::Min) => two(steps, memory, N::min),
        Kind::Power(n) => one(steps, memory, |a| a.powi(n)),
        Kind::Compare(comparison) => {
            two(steps, memory, |a, b| a.one_where(compare(comparison, a, b)))
        }
        Kind::Both => two(steps, memory, |a, b| a * b),
        Kind::Either => two(steps, memory, N::or_larger),
        Kind::Not => one(steps, memory, |a| a.all(1.0) - a),
        Kind::Select => three(steps, memory, |c, a, b| a.where_or(!c.equals(c.all(0.0)), b)),
        Kind::One(f) => one_by_one(f, steps, memory),
        Kind::Two(f) => two_by_two(f, steps, memory),
        Kind::Law(law, order) => ask(laws.get(law as usize), order, steps, memory),
    }
}

#[inline(always)]
fn one<N: Computed, M: Places<N> + ?Sized>(
    steps: &[Step<M::Place>],
    memory: &mut M,
    f: impl Fn(N) -> N,
) {
    for step in steps {
        memory.put(step.out, f(memory.get(step.a)));
    }
}

#[inline(always)]
fn two<N: Computed, M: Places<N> + ?Sized>(
    steps: &[Step<M::Place>],
    memory: &mut M,
    f: impl Fn(N, N) -> N,
) {
    for step in steps {
        memory.put(step.out, f(memory.get(step.a), memory.get(step.b)));
    }
}

#[inline(always)]
fn three<N: Computed, M: Places<N> + ?Sized>(
    steps: &[Step<M::Place>],
    memory: &mut M,
    f: impl Fn(N, N, N) -> N,
) {
    for step in steps {
        memory.put(step.out, f(memory.get(step.a), memory.get(step.b), memory.get(step.c)));
    }
}

#[inline(always)]
fn compare<N: Computed>(comparison: Comparison, a: N, b: N) -> N::Answer {
    match comparison {
        Comparison::Less => a.below(b),
        Comparison::LessEqual => a.at_most(b),
        Comparison::Greater => a.above(b),
        Comparison::GreaterEqual => b.at_most(a),
        Comparison::Equal => a.equals(b),
        Comparison::NotEqual => !a.equals(b),
    }
}

/// Evaluates a function lane by lane. It is a separate function, because it calls others anyway.
#[inline(never)]
fn one_by_one<N: Computed, M: Places<N> + ?Sized>(
    f: Function,
    steps: &[Step<M::Place>],
    memory: &mut M,
) {
    let value = f.value();
    one(steps, memory, |a| a.map_to(|x| [value(x)])[0]);
}

#[inline(never)]
fn two_by_two<N: Computed, M: Places<N> + ?Sized>(
    f: Function2,
    steps: &[Step<M::Place>],
    memory: &mut M,
) {
    let value = f.value();
    two(steps, memory, |a, b| a.map2(b, value));
}

/// Evaluates a derivative of a law and the two that follow it; unknown ones are NaN.
#[inline(never)]
fn ask<N: Computed, M: Places<N> + ?Sized>(
    law: Option<&Law>,
    order: u8,
    steps: &[Step<M::Place>],
    memory: &mut M,
) {
    for step in steps {
        let jet = memory.get(step.a).map_to(|x| {
            let [f, f1, f2, f3] = law.map_or([f64::NAN; 4], |law| law.jet(x));
            let fourth = || law.map_or(f64::NAN, |law| law.fourth(x));
            if order == 0 { [f, f1, f2] } else { [f3, fourth(), f64::NAN] }
        });
        [step.out, step.b, step.c]
            .into_iter()
            .zip(jet)
            .for_each(|(place, number)| memory.put(place, number));
    }
}
