use kin::prelude::*;

#[constraint]
fn held(a: &'static Coord, k: f64) -> f64 {
    *a - k
}

fn main() {}
