use kin::prelude::*;

#[constraint]
fn counted(i: Planar, k: f64) -> f64 {
    i.r as f64 - k
}

fn main() {}
