use kin::prelude::*;

#[constraint]
fn level(i: [Planar; 2]) -> f64 {
    i[0].theta - i[1].theta
}

fn main() {}
