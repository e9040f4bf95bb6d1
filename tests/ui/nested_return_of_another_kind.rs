use kin::prelude::*;

#[constraint]
fn nested(a: Coord, k: f64) -> f64 {
    for j in 0..3 {
        if a > k {
            return j;
        }
    }
    a
}

fn main() {}
