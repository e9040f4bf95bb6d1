use kin::prelude::*;

const NAME: &str = "slot";

#[constraint]
fn series(x: Coord) -> f64 {
    let mut sum = x;
    while sum > 1.0 {
        sum -= 1.0;
    }
    sum - NAME
}

fn main() {}
