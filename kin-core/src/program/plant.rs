//! Faults as a generator could make them, for tests that look whether they are noticed.

use kin_graph::Node;

use super::stages::Program;

/// The fault.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fault {
    /// A coordinate, a rate or a second rate has lost its sign.
    Sign(usize),
    /// A rate or a second rate is that of the next coordinate.
    Column(usize),
    /// A coordinate, a rate or a second rate is off by a thousandth.
    Slight(usize),
    /// A row reads the coordinate after its own in `verify`.
    Row,
    /// Newton's corrections have lost their signs.
    Correction,
    /// A pivot or determinant is that of nothing.
    Guard,
}

/// Every fault.
pub(crate) const ALL: [Fault; 11] = [
    Fault::Sign(0),
    Fault::Sign(1),
    Fault::Sign(2),
    Fault::Column(1),
    Fault::Column(2),
    Fault::Slight(0),
    Fault::Slight(1),
    Fault::Slight(2),
    Fault::Row,
    Fault::Correction,
    Fault::Guard,
];

/// Plants a fault in what concerns coordinate, or row, number k.
pub(crate) fn plant(program: &mut Program, fault: Fault, k: usize) {
    let n = program.values.len();
    let of = |program: &Program, order: usize, k: usize| match order {
        0 => program.values[k],
        1 => program.rates[k],
        _ => program.second_rates[k],
    };
    let put = |program: &mut Program, order: usize, node: Node| match order {
        0 => program.values[k] = node,
        1 => program.rates[k] = node,
        _ => program.second_rates[k] = node,
    };
    match fault {
        Fault::Sign(order) => {
            let node = of(program, order, k);
            let node = program.graph.neg(node);
            put(program, order, node);
        }
        Fault::Column(order) => {
            let node = of(program, order, (k + 1) % n);
            put(program, order, node);
        }
        Fault::Slight(order) => {
            let (node, factor) = (of(program, order, k), program.graph.constant(1.001));
            let node = program.graph.mul(factor, node);
            put(program, order, node);
        }
        Fault::Row => program.verify[k] = program.verify[(k + 1) % n],
        Fault::Correction => {
            let all = std::mem::take(&mut program.correction);
            program.correction = all.into_iter().map(|node| program.graph.neg(node)).collect();
        }
        Fault::Guard => {
            program.guards.iter_mut().flatten().for_each(|guard| *guard = program.graph.constant(0.0))
        }
    }
}
