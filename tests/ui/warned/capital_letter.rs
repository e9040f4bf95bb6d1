use kin::prelude::*;

#[constraint]
fn offset(i: Planar, L: f64) -> f64 {
    i.r.x - L
}

fn main() {
    let _ = offset(kin::check::any_planar(), 1.0);
}
