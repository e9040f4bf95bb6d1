use kin::prelude::*;

#[constraint]
fn mean_height(q: [Coord; 3]) -> f64 {
    fn mean<const N: usize>(x: [f64; N], w: [f64; N]) -> f64 {
        x[0] * w[0] / N as f64
    }
    mean(q, [1.0, 2.0])
}

fn main() {}
