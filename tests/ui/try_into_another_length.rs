use kin::prelude::*;

#[constraint]
fn shortened(q: [Coord; 3]) -> f64 {
    let pair: [f64; 2] = q[..3].try_into().unwrap();
    pair[0] - pair[1]
}

fn main() {}
