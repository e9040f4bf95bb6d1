//! Supports the tests of the passes: plain values of nodes, and reproducible random numbers.

use std::collections::HashMap;

use crate::evaluate::{Source, evaluate};
use crate::{Graph, Input, LeafUse, Node};

/// The numbers of inputs. The graphs of these tests contain no laws or foreign values.
pub struct Given(pub HashMap<Input, f64>);

impl Source<f64> for Given {
    fn input(&self, input: Input) -> f64 {
        self.0[&input]
    }

    fn law(&self, law: usize, _: f64, _: u8) -> f64 {
        panic!("no law {law}")
    }

    fn opaque(&self, number: usize, _: usize, _: Vec<f64>) -> f64 {
        panic!("no value {number}")
    }

    fn leaf(&self, used: LeafUse, _: Vec<f64>) -> f64 {
        panic!("no leaf {used:?}")
    }
}

/// Returns the value of a node.
pub fn value(g: &Graph, node: Node, inputs: &HashMap<Input, f64>) -> f64 {
    evaluate(g, &[node], &Given(inputs.clone())).number(node).unwrap_or(f64::NAN)
}

/// Generates reproducible random numbers (SplitMix64).
pub struct SplitMix(pub u64);

impl SplitMix {
    pub fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % n as u64) as usize
    }
}
