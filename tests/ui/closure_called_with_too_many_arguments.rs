use kin::prelude::*;

#[constraint]
fn closed(a: Coord, b: Coord) -> f64 {
    let square = |x: f64| x * x;
    square(a, b)
}

fn main() {}
