use kin::prelude::*;

#[constraint]
fn driver(theta: f64, omega: f64, t: Time) -> f64 {
    theta - omega * t
}

fn main() {}
