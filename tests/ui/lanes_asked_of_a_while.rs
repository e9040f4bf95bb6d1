use kin::prelude::*;

#[constraint(lanes)]
fn series(x: Coord, h: f64) -> f64 {
    let (mut term, mut sum) = (x, x);
    while term.abs() > 1e-12 {
        term = -term * x * x;
        sum += term;
    }
    sum - h
}

fn main() {}
