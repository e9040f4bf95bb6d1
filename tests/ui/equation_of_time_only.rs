use kin::prelude::*;

#[constraint]
fn driver(theta: Coord, omega: f64, t: Time) -> f64 {
    omega * t
}

fn main() {}
