use kin::prelude::*;

#[constraint]
#[measure(height = b.r.y, "m")]
#[measure(height = b.r.y - k, "m")]
fn f(b: Planar, k: f64) -> f64 {
    b.r.x - k
}

fn main() {}
