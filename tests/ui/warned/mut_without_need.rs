use kin::prelude::*;

#[constraint]
fn offset(i: Planar, k: f64) -> f64 {
    let mut x = i.r.x;
    x - k
}

fn main() {
    let _ = offset(kin::check::any_planar(), 1.0);
}
