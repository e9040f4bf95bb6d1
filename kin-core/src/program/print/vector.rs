//! Computes a test vector of a tape: all its numbers at one place, which need not be a solution.

use crate::law::{Law, LawFunction};
use crate::program::tape::replay::Replay;
use crate::program::tape::{SHORT, Stage, Tape};

/// The inputs of a test vector. Without drivers the first one is the time.
pub(super) struct Inputs<'a> {
    /// For each driver its value, velocity and acceleration.
    pub drivers: &'a [[f64; 3]],
    pub torn: &'a [f64],
    pub parameters: &'a [f64],
}

/// A driver with a fixed value and derivatives.
struct Fixed([f64; 3]);

impl LawFunction for Fixed {
    fn jet(&self, _: f64) -> [f64; 4] {
        let [u, ud, udd] = self.0;
        [u, ud, udd, 0.0]
    }
}

/// Replays a tape once and returns its memory; `drivers` are the laws that are inputs.
pub(super) fn memory(tape: &Tape, drivers: &[Law], inputs: &Inputs<'_>) -> Vec<f64> {
    let mut memory = vec![0.0; tape.places.max(SHORT)];
    for (place, x) in &tape.constants {
        memory[*place as usize] = *x;
    }
    if let ([], [[t, ..], ..]) = (drivers, inputs.drivers) {
        memory[tape.t as usize] = *t;
    }
    let torn = tape.torn.iter().zip(inputs.torn);
    for (place, x) in torn.chain(tape.parameters.iter().zip(inputs.parameters)) {
        memory[*place as usize] = *x;
    }
    let fixed = |law: &Law| match drivers.iter().position(|driver| driver.is(law)) {
        Some(k) => Law::new(Fixed(inputs.drivers[k])),
        None => law.clone(),
    };
    let laws: Vec<Law> = tape.laws.iter().map(fixed).collect();
    let stages: [&Stage; 4] = [&tape.setup, &tape.time, &tape.correct, &tape.rest];
    for stage in stages {
        pulp::NullaryFnOnce::call(Replay { stage, laws: &laws, memory: &mut memory });
    }
    memory
}
