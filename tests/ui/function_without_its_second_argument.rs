use kin::prelude::*;

#[constraint]
fn angle(i: Planar, phi: f64) -> f64 {
    f64::atan2(i.r.y) - phi
}

fn main() {}
