use kin::prelude::*;

#[constraint]
fn parallel(i: Planar, j: Planar) -> Mat2 {
    i.a() - j.a()
}

fn main() {}
