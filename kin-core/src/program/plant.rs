//! Faults as a generator could make them, for tests that look whether they are noticed.

pub(crate) mod passes;

use kin_graph::{Input, Node};

use super::stages::Program;
use super::tape::{Kind, Stage, Tape};

/// The fault.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fault {
    /// A coordinate (0) or one of its rates, by their orders, has lost its sign.
    Sign(usize),
    /// A rate is that of the next coordinate.
    Column(usize),
    /// A coordinate or one of its rates is off by a thousandth.
    Slight(usize),
    /// A row reads the coordinate after its own in `verify`.
    Row,
    /// Newton's corrections have lost their signs.
    Correction,
    /// A pivot or determinant is that of nothing.
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

/// The nodes of coordinates (0) or of one of their rates, by orders.
fn list(program: &mut Program, order: usize) -> &mut Vec<Node> {
    match order {
        0 => &mut program.values,
        1 => &mut program.rates,
        2 => &mut program.second_rates,
        _ => &mut program.third_rates,
    }
}

/// Plants a fault in what concerns coordinate, or row, number k; none where the program has no such
/// number.
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

/// Makes q̈ of coordinate k wrong at all times but one, with `size` times how far that is away:
/// what looks at that time alone notices nothing.
pub(crate) fn wrong_but_at(program: &mut Program, k: usize, t: f64, size: f64) {
    let graph = &mut program.graph;
    let [now, then, size] = [graph.input(Input::Time), graph.constant(t), graph.constant(size)];
    let away = graph.sub(now, then);
    let off = graph.mul(size, away);
    program.second_rates[k] = graph.add(program.second_rates[k], off);
}

/// The fault of one step of a tape, as the pass that schedules could make it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Slip {
    /// Its sign, or that of one of its terms, is the other one.
    Sign,
    /// It reads the place after its first operand's.
    Operand,
    /// It writes the place after its own.
    Place,
}

/// Every slip.
pub(crate) const SLIPS: [Slip; 3] = [Slip::Sign, Slip::Operand, Slip::Place];

/// Makes step number k of a tape wrong; false where there is no such step.
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

/// Gives a step the kind with another sign: all steps become runs of one.
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
