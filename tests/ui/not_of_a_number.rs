use kin::prelude::*;

#[constraint]
fn inverted(a: Coord) -> f64 {
    let mask = !a;
    mask + a
}

fn main() {}
