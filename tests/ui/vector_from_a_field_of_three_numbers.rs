use kin::prelude::*;

#[derive(Clone)]
struct Mount {
    at: [f64; 3],
}

#[constraint]
fn mounted(i: Planar, mount: Mount) -> Vec2 {
    i.r - Vec2::from(mount.at)
}

fn main() {}
