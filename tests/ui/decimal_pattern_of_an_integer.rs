use kin::prelude::*;

#[constraint]
fn legendre(x: Coord) -> f64 {
    fn p(n: u32, x: f64) -> f64 {
        match n {
            0.0 => 1.0,
            1 => x,
            n => ((2 * n - 1) as f64 * x * p(n - 1, x) - (n - 1) as f64 * p(n - 2, x)) / n as f64,
        }
    }
    p(4, x) - 0.1
}

fn main() {}
