use kin::prelude::*;

#[constraint]
fn chain(i: [Planar; 0], a: Coord) -> f64 {
    a - i.len() as f64
}

fn main() {}
