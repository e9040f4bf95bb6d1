use kin::prelude::*;

#[constraint]
fn chebyshev(a: Coord, x0: f64) -> f64 {
    fn polynomial(n: usize, x: f64) -> f64 {
        if n == 0 { 1.0 } else { x * polynomial(n - 1, x) }
    }
    polynomial(3.0, a) - x0
}

fn main() {}
