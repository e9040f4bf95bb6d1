use kin::prelude::*;

#[constraint]
fn offset(i: Planar, k: f64) -> f64 {
    use std::f64::consts::E;
    i.r.x - k
}

fn main() {
    let _ = offset(kin::check::any_planar(), 1.0);
}
