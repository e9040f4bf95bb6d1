use kin::prelude::*;

#[constraint]
fn slide(i: Planar, j: Planar, u: Vec3, profile: Law) -> (f64, f64) {
    let p = i.point(u);
    (p.x - j.r.x, j.theta - profile)
}

fn main() {}
