use kin::prelude::*;

#[constraint]
fn total(a: Coord, b: Coord) -> f64 {
    let sum = 0.0;
    let mut add = |x: f64| sum += x;
    add(a);
    add(b);
    sum - 1.0
}

fn main() {}
