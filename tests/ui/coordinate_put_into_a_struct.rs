use kin::prelude::*;

struct Pair {
    a: f64,
    b: f64,
}

#[constraint]
fn product(i: Planar, k: f64) -> f64 {
    let pair = Pair { a: i.r.x, b: k };
    pair.a * pair.b
}

fn main() {}
