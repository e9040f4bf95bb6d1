use kin::prelude::*;

struct Gear {
    teeth: f64,
}

impl Gear {
    fn ratio(&self, other: f64) -> f64 {
        self.teeth / other
    }
}

#[constraint]
fn geared(a: Coord, b: Coord, teeth: f64) -> f64 {
    let gear = Gear { teeth };
    a - b * gear.ration(20.0)
}

fn main() {}
