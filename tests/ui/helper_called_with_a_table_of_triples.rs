use kin::prelude::*;

fn longest(points: &[(f64, f64)]) -> f64 {
    points.iter().map(|p| p.0.hypot(p.1)).fold(0.0, f64::max)
}

#[constraint]
fn reach(x: Coord, points: [(f64, f64, f64); 3]) -> f64 {
    x - longest(&points)
}

fn main() {}
