use kin::prelude::*;

#[constraint]
fn driver(crank: Planar) -> f64 {
    crank
}

fn main() {}
