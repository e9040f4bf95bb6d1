use kin::prelude::*;

struct Gear {
    teeth: f64,
}

#[constraint]
fn geared(a: Coord, teeth: f64) -> f64 {
    let gear = Gear { teeth };
    a * gear.module
}

fn main() {}
