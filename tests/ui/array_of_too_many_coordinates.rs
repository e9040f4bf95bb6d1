use kin::prelude::*;

#[constraint]
fn long(x: [Coord; 1000000]) -> f64 {
    x[0] - x[999999]
}

fn main() {}
