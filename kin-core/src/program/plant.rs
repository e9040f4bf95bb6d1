//! Plants faults that a generator of code could make, so that tests can check that a run detects
//! the faults.

pub(crate) mod passes;

use kin_graph::{Input, Node};

use super::stages::Program;
use super::tape::{Kind, Stage, Tape};

/// The fault.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fault {
    /// A coordinate (0) or a derivative of it, by its order, has the wrong sign.
    Sign(usize),
    /// A derivative belongs to the next coordinate.
    Column(usize),
    /// A coordinate or a derivative of it is wrong by a thousandth.
    Slight(usize),
    /// A row reads the next coordinate in `verify`.
    Row,
    /// Newton's corrections have the wrong sign.
    Correction,
    /// A pivot or determinant is a constant.
    Guard,
}

/// Every fault.
pub(crate) const ALL: [Fault; 14] = [
    Fault::Sign(0),
    Fault::Sign(1),
    Fault::Sign(2),
    Fault::Sign(3),
    Fault::Column(1),
    Fault::Column(2),
    Fault::Column(3),
    Fault::Slight(0),
    Fault::Slight(1),
    Fault::Slight(2),
    Fault::Slight(3),
    Fault::Row,
    Fault::Correction,
    Fault::Guard,
];

/// Returns the nodes of coordinates (0) or of their derivatives, by order.
fn list(program: &mut Program, order: usize) -> &mut Vec<Node> {
    match order {
        0 => &mut program.values,
        1 => &mut program.rates,
        2 => &mut program.second_rates,
        _ => &mut program.third_rates,
    }
}

/// Plants a fault at coordinate or row k. It does nothing if the program has no such index.
pub(crate) fn plant(program: &mut Program, fault: Fault, k: usize) {
    let n = program.values.len();
    match fault {
        Fault::Sign(order) | Fault::Slight(order) | Fault::Column(order) => {
            let Some(node) = list(program, order).get(k).copied() else { return };
            let wrong = match fault {
                Fault::Sign(_) => program.graph.neg(node),
                Fault::Column(_) => list(program, order)[(k + 1) % n],
                _ => {
                    let factor = program.graph.constant(1.001);
                    program.graph.mul(factor, node)
                }
            };
            list(program, order)[k] = wrong;
        }
        Fault::Row => program.verify[k] = program.verify[(k + 1) % n],
        Fault::Correction => {
            let all = std::mem::take(&mut program.correction);
            program.correction = all.into_iter().map(|node| program.graph.neg(node)).collect();
        }
        Fault::Guard => program
            .guards
            .iter_mut()
            .flatten()
            .for_each(|guard| *guard = program.graph.constant(0.0)),
    }
}

/// Makes q̈ of coordinate k wrong by `size` times the distance from a time t. A check at that time
/// alone does not detect it.
pub(crate) fn wrong_but_at(program: &mut Program, k: usize, t: f64, size: f64) {
    let graph = &mut program.graph;
    let [now, then, size] = [graph.input(Input::Time), graph.constant(t), graph.constant(size)];
    let away = graph.sub(now, then);
    let off = graph.mul(size, away);
    program.second_rates[k] = graph.add(program.second_rates[k], off);
}

/// A fault of one step of a tape, which the scheduling pass could make.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Slip {
    /// The sign of the step, or of one of its terms, is wrong.
    Sign,
    /// The step reads the place after its first operand.
    Operand,
    /// The step writes the place after its output.
    Place,
}

/// Every slip.
pub(crate) const SLIPS: [Slip; 3] = [Slip::Sign, Slip::Operand, Slip::Place];

/// Makes step k of a tape wrong. Returns false if there is no such step.
pub(crate) fn spoil(tape: &mut Tape, slip: Slip, mut k: usize) -> bool {
    let places = tape.places as u32;
    for stage in [&mut tape.setup, &mut tape.time, &mut tape.correct, &mut tape.rest] {
        if k < stage.steps.len() {
            match slip {
                Slip::Sign => turn(stage, k),
                Slip::Operand => stage.steps[k].a = (stage.steps[k].a + 1) % places,
                Slip::Place => stage.steps[k].out = (stage.steps[k].out + 1) % places,
            }
            stage.shorten();
            return true;
        }
        k -= stage.steps.len();
    }
    false
}

/// Changes the sign of a step's kind; all steps become runs of one step.
fn turn(stage: &mut Stage, k: usize) {
    let kinds: Vec<Kind> = stage
        .runs
        .iter()
        .flat_map(|run| std::iter::repeat_n(run.kind, run.steps as usize))
        .collect();
    let steps = std::mem::take(&mut stage.steps);
    stage.runs.clear();
    for (own, (kind, step)) in kinds.into_iter().zip(steps).enumerate() {
        let turned = match kind {
            Kind::Add => Kind::Sub,
            Kind::Sub => Kind::Add,
            Kind::Fma => Kind::NegatedProduct,
            Kind::NegatedProduct => Kind::Fma,
            Kind::ProductLess => Kind::NegatedSum,
            Kind::NegatedSum => Kind::ProductLess,
            Kind::Mul => Kind::Div,
            kind => kind,
        };
        stage.push(if own == k { turned } else { kind }, step);
    }
}
