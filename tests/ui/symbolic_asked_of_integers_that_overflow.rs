use kin::prelude::*;

#[constraint(symbolic)]
fn factorial(x: Coord) -> f64 {
    let mut f = 1;
    for k in 1..20 {
        f *= k;
    }
    x - f as f64
}

fn main() {}
