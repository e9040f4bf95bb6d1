use kin::prelude::*;

#[constraint(symbolic)]
fn below(x: Coord, c: [f64; 3]) -> f64 {
    let mut sum = x;
    for k in 0..3 {
        sum += c[k - 1 + 1];
    }
    sum
}

fn main() {}
