use kin::prelude::*;

#[constraint]
fn counted(a: Coord, n: f64) -> f64 {
    let mut k = 0;
    while k < n {
        k += 1;
    }
    a - k as f64
}

fn main() {}
