use kin::prelude::*;

fn height(body: kin::extend::state::SpatialState) -> f64 {
    body.r.z
}

#[constraint]
fn held(i: Planar, level: f64) -> f64 {
    height(i) - level
}

fn main() {}
