use kin::prelude::*;

const LEGS: usize = 5;

#[constraint(LEGS = 6)]
fn platform(q: [Coord; LEGS]) -> f64 {
    q[0] - q[1]
}

fn main() {}
