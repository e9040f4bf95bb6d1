use kin::prelude::*;

#[constraint]
fn offset(i: Spatial, k: f64) -> f64 {
    let dead = i.r.z * k;
    i.r.x - k
}

fn main() {
    let _ = offset(kin::check::any_spatial(), 1.0);
}
