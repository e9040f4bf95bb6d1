use kin::prelude::*;

#[constraint]
fn table(x: Coord, c: [[f64; 10000000000]; 10000000000]) -> f64 {
    x - c[0][0]
}

fn main() {}
