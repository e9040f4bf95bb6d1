use kin::prelude::*;

#[constraint]
fn driver(crank: Planar, omega: f64, t: Time) -> f64 {
    crank - omega * t
}

fn main() {}
