use kin::prelude::*;

#[constraint]
fn lowest(q: [Coord; 3]) -> f64 {
    q.into_iter().min_by(|a, b| a - b).unwrap_or(0.0)
}

fn main() {}
