use kin::prelude::*;

#[constraint(symbolic)]
fn series(x: Coord, n: usize) -> f64 {
    let mut sum = x;
    for _ in 0..n {
        sum = sum.sin();
    }
    sum
}

fn main() {}
