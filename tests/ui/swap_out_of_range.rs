use kin::prelude::*;

#[constraint]
fn swapped(a: Coord, b: Coord) -> f64 {
    let mut all = [a, b];
    all.swap(0, 2);
    all[0]
}

fn main() {}
