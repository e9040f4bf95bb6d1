use kin::prelude::*;

const LEGS: usize = 6;

#[constraint]
fn platform(q: [Coord; LEGS]) -> f64 {
    q[0] - q[1]
}

fn main() {}
