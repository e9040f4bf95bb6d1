use kin::prelude::*;

#[constraint]
fn later(i: Planar) -> f64 {
    let (x, y);
    x = i.r;
    y = i.theta;
    x + y
}

fn main() {}
