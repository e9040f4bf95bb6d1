use kin::prelude::*;

struct Pair(f64, f64);

#[constraint]
fn product(i: Planar, k: f64) -> f64 {
    let pair = Pair(i.r.x, k);
    pair.0 * pair.1
}

fn main() {}
