use kin::prelude::*;

#[constraint]
fn summed(q: [Coord; 3]) -> f64 {
    q.iter().scan(|sum, x| Some(*sum + x)).sum::<f64>()
}

fn main() {}
