use kin::prelude::*;

#[constraint]
fn stepped(a: Coord) -> f64 {
    const HEIGHTS: [f64; 3] = [0.0, 0.5, 0.75];
    a.sin() - HEIGHTS[3]
}

fn main() {}
