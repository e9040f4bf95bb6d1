use kin::prelude::*;

#[constraint]
fn rows(x: Coord) -> [[f64; 1000]; 1000] {
    [[x; 1000]; 1000]
}

fn main() {}
