use kin::prelude::*;

#[constraint]
fn widest(q: [Coord; 3]) -> f64 {
    q.into_iter().reduce(|a| a).unwrap_or(0.0)
}

fn main() {}
