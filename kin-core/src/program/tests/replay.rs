//! A tape over lanes computes what the program does, node by node.

use kin_graph::{Node, evaluate};

use super::at::At;
use super::functions::Again;
use super::models::systems;
use super::reduced::compiled_with;
use crate::linspace;
use crate::numbers::lanes::{Lanes, Level, Wide, WithLevel};
use crate::program::schedule;
use crate::program::stages::Program;
use crate::program::tape::replay::Replay;
use crate::program::tape::{SHORT, Stage, Tape};

/// All stages of a tape at one pose for each lane.
struct Replayed<'a> {
    tape: &'a Tape,
    poses: &'a [(f64, Vec<f64>)],
    /// Numbers of the memory, as many at least as the tape has places.
    room: usize,
}

impl WithLevel for Replayed<'_> {
    type Output = Vec<Vec<f64>>;

    fn run<S: Level>(self, simd: S) -> Self::Output {
        let tape = self.tape;
        let mut memory = vec![Wide::splat(simd, f64::NAN); self.room.max(tape.places)];
        tape.constants
            .iter()
            .for_each(|(place, x)| memory[*place as usize] = Wide::splat(simd, *x));
        for lane in 0..Wide::<S>::LANES {
            let (t, q) = &self.poses[lane % self.poses.len()];
            memory[tape.t as usize].as_mut_slice()[lane] = *t;
            tape.torn.iter().zip(&tape.columns).for_each(|(place, column)| {
                memory[*place as usize].as_mut_slice()[lane] = q[*column]
            });
        }
        let mut replay = |stage: &Stage| {
            simd.vectorize(Again(Replay { stage, laws: &tape.laws, memory: &mut memory }))
        };
        // The steps that lead to the correction can be replayed any number of times.
        [&tape.setup, &tape.time, &tape.correct, &tape.correct, &tape.rest]
            .into_iter()
            .for_each(&mut replay);
        let lists = [
            &tape.correction,
            &tape.left,
            &tape.values,
            &tape.corrections,
            &tape.rates,
            &tape.second_rates,
            &tape.third_rates,
            &tape.sides,
            &tape.verify,
        ];
        let places: Vec<u32> =
            lists.into_iter().flatten().chain(tape.guards.iter().flatten()).copied().collect();
        let of = |lane: usize| {
            places.iter().map(|place| memory[*place as usize].as_slice()[lane]).collect()
        };
        (0..Wide::<S>::LANES.min(self.poses.len())).map(of).collect()
    }
}

/// All that a program is asked for, number by number, and what its outputs are called.
fn scalar(program: &Program, t: f64, q: &[f64]) -> Vec<f64> {
    let of = |nodes: &[Node], given: &[f64]| {
        let results = evaluate(&program.graph, nodes, &At { t, q, given, program });
        nodes.iter().map(|node| results.number(*node).expect("evaluated")).collect::<Vec<f64>>()
    };
    let given = of(&program.values, &[]);
    of(&program.outputs(), &given)
}

#[test]
fn every_number_of_a_tape_is_that_of_its_program() {
    for (name, system) in systems() {
        let Ok(motion) = system.run(linspace(0.0, 0.4, 9)) else { continue };
        let compiled = || compiled_with(&system, 0.0, motion.q(0), true).expect("compiles");
        let program = compiled();
        let tape = schedule(compiled());
        let off = |column: usize| 1e-3 * (column as f64).cos();
        let pose = |k: usize| {
            (
                motion.times()[k],
                motion.q(k).iter().enumerate().map(|(column, q)| q + off(column)).collect(),
            )
        };
        let poses: Vec<(f64, Vec<f64>)> = (0..motion.len()).map(pose).collect();
        // Places of four bytes, and of one where the memory has as many as those tell.
        for (lanes, room) in [2, 4, 8].into_iter().flat_map(|lanes| [(lanes, 0), (lanes, SHORT)]) {
            let replayed = Replayed { tape: &tape, poses: &poses, room };
            let Ok(found) = Lanes::Only(lanes).dispatch(replayed) else { continue };
            for ((t, q), found) in poses.iter().zip(found) {
                let expected = scalar(&program, *t, q);
                let size = expected.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
                for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
                    let near = (found - expected).abs() <= 1e-11 * size;
                    assert!(
                        near,
                        "{name}, {lanes} lanes, t = {t}, number {k} of {}: {found} is not {expected}",
                        program.outputs().len()
                    );
                }
            }
        }
    }
}
