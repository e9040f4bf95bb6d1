use kin::prelude::*;

#[constraint]
fn offset(a: Coord, at: Option<Vec2>) -> f64 {
    if let Some(v) = at { a - v } else { a }
}

fn main() {}
