use kin::prelude::*;

#[constraint]
fn limited(a: Coord, k: f64) -> f64 {
    let limit = if a > k { Some(a) } else { None };
    limit * a
}

fn main() {}
