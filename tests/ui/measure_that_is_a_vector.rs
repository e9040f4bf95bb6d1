use kin::prelude::*;

#[constraint]
#[measure(place = b.r, "m")]
fn f(b: Planar, k: f64) -> f64 {
    b.r.x - k
}

fn main() {}
