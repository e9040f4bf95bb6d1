use kin::prelude::*;

#[constraint]
fn placed(i: Planar) -> Vec2 {
    Planar::point(&i)
}

fn main() {}
