//! A program computes the numbers of its system: positions, velocities and accelerations at the
//! times of a motion.

use kin_graph::{Node, evaluate};

use super::at::At;
use super::models::systems;
use crate::program::refusal::Refusal;
use crate::program::stages::{Pose, Program, program};
use crate::system::scale;
use crate::{SolverOptions, System, linspace};

pub(crate) fn compiled(system: &System, t: f64, q: &[f64]) -> Result<Program, Refusal> {
    compiled_with(system, t, q, false)
}

/// The same with q⃛, if that is asked for.
pub(super) fn compiled_with(
    system: &System,
    t: f64,
    q: &[f64],
    jerk: bool,
) -> Result<Program, Refusal> {
    let point = system.model().linearize(q, t).expect("finite");
    let sizes =
        scale::sizes(system.layout(), system.equations(), &point.values, (q, t), system.links());
    program(system, Pose { t, q, sizes: &sizes }, jerk)
}

fn largest(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    pairs.fold(0.0, |m, (a, b)| {
        let off = (a - b).abs() / (1.0 + a.abs());
        if off <= m { m } else { off }
    })
}

/// Newton's method on what is torn, from values that are off; then all coordinates, q̇, q̈, q⃛ and
/// C beside those of the motion.
fn difference(program: &Program, t: f64, [q, qd, qdd, qddd]: [&[f64]; 4]) -> [f64; 5] {
    let mut own = q.to_vec();
    program
        .torn
        .iter()
        .enumerate()
        .for_each(|(k, column)| own[*column] += 1e-4 * (k as f64 + 1.0).sin());
    let of = |nodes: &[Node], q: &[f64], given: &[f64]| {
        let results = evaluate(&program.graph, nodes, &At { t, q, given, program });
        nodes.iter().map(|node| results.number(*node).expect("evaluated")).collect::<Vec<f64>>()
    };
    for _ in 0..6 {
        let correction = of(&program.correction, &own, &[]);
        program.torn.iter().zip(correction).for_each(|(column, change)| own[*column] += change);
    }
    let values = of(&program.values, &own, &[]);
    let verify = of(&program.verify, &own, &values);
    let [rates, second_rates, third_rates] =
        [&program.rates, &program.second_rates, &program.third_rates]
            .map(|nodes| of(nodes, &own, &[]));
    assert_eq!(third_rates.len(), qddd.len());
    let all = |a: &[f64], b: &[f64]| largest(a.iter().copied().zip(b.iter().copied()));
    [
        all(q, &values),
        all(qd, &rates),
        all(qdd, &second_rates),
        all(qddd, &third_rates),
        verify.iter().fold(0.0, |m: f64, c| m.max(c.abs())),
    ]
}

/// True if a pivot is less than a hundredth of what it was at the first of two poses.
fn fades(program: &Program, times: [f64; 2], poses: [&[f64]; 2]) -> bool {
    let nodes: Vec<Node> = program.guards.iter().flatten().copied().collect();
    let [marks, now] = [0, 1].map(|k| {
        let results =
            evaluate(&program.graph, &nodes, &At { t: times[k], q: poses[k], given: &[], program });
        nodes.iter().map(|node| results.number(*node).expect("evaluated")).collect::<Vec<f64>>()
    });
    now.iter().zip(marks).any(|(now, mark)| now.abs() < 0.01 * mark.abs())
}

#[test]
fn the_program_has_the_positions_and_rates_of_the_system() {
    let mut compared = 0;
    let mut refused = Vec::new();
    for (name, system) in systems() {
        let options = SolverOptions::new().jerk(true);
        let Ok(motion) = system.solver().options(options.clone()).run(linspace(0.0, 0.5, 26))
        else {
            continue;
        };
        let program = match compiled_with(&system, 0.0, motion.q(0), true) {
            Ok(program) => program,
            Err(refusal) => {
                refused.push((name, refusal.reason));
                continue;
            }
        };
        compared += 1;
        for k in (0..motion.len()).step_by(5) {
            let all = [motion.q(k), motion.qd(k), motion.qdd(k), motion.qddd(k)];
            let t = motion.times()[k];
            // Where a pivot has faded another order is to be taken.
            let faded = fades(&program, [0.0, t], [motion.q(0), motion.q(k)]);
            let another =
                faded.then(|| compiled_with(&system, t, motion.q(k), true).expect("as before"));
            let [q, qd, qdd, qddd, c] = difference(another.as_ref().unwrap_or(&program), t, all);
            assert!(
                q < 1e-11 && qd < 1e-9 && qdd < 1e-7 && qddd < 1e-6 && c < 1e-11,
                "{name} at {k}: {q:e} {qd:e} {qdd:e} {qddd:e} {c:e}"
            );
        }
    }
    assert!(compared > 12, "{compared} {refused:?}");
}
