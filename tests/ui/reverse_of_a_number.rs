use kin::prelude::*;

#[constraint]
fn turned(q: [Coord; 3]) -> f64 {
    let mut parts = q;
    parts[0].reverse();
    parts[0] - parts[2]
}

fn main() {}
