use kin::prelude::*;

fn scaled<D: Dual>(n: i64, x: Real<D>) -> Real<D> {
    Real::from(n) * x
}

#[constraint]
fn counted(a: Coord) -> f64 {
    scaled(3, a) - 1.0
}

fn main() {}
