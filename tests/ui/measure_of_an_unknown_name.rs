use kin::prelude::*;

#[constraint]
#[measure(height = b.r.y - offset, "m")]
fn f(b: Planar, k: f64) -> f64 {
    b.r.x - k
}

fn main() {}
