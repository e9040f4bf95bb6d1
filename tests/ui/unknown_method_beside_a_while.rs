use kin::prelude::*;

#[constraint]
fn series(x: Coord, h: f64) -> f64 {
    let mut sum = x;
    while sum > 1.0 {
        sum = sum.square();
    }
    sum - h
}

fn main() {}
