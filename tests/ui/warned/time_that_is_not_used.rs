use kin::prelude::*;

#[constraint]
fn offset(i: Planar, t: Time, k: f64) -> f64 {
    i.r.x - k
}

fn main() {
    let _ = offset(kin::check::any_planar(), 1.0);
}
