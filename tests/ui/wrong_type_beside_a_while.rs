use kin::prelude::*;

#[constraint]
fn series(x: Coord, h: f64) -> f64 {
    let (mut term, mut sum) = (x, x);
    while term.abs() {
        term = -term * x * x;
        sum += term;
    }
    sum - h
}

fn main() {}
