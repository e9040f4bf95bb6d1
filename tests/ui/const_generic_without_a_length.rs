use kin::prelude::*;

#[constraint]
fn mean<const N: usize>(q: [Coord; N]) -> f64 {
    q.iter().sum::<f64>() / N as f64
}

fn main() {}
