use kin::prelude::*;

#[constraint]
fn rod(x: Coord, length: f64) -> f64 {
    assert!(length);
    x - length
}

fn main() {}
