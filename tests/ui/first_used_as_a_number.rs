use kin::prelude::*;

#[constraint]
fn led(q: [Coord; 3], k: f64) -> f64 {
    q.first() - k
}

fn main() {}
