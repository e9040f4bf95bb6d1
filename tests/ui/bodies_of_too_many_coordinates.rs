use kin::prelude::*;

#[constraint]
fn long(a: [Coord; 200], b: [Coord; 200]) -> f64 {
    a[0] - b[0]
}

fn main() {}
