use kin::prelude::*;

#[law]
fn path(t: f64, r: f64) -> Vec2 {
    vec2(r * t.cos(), r * t.sin())
}

fn main() {}
