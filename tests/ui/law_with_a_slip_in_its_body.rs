use kin::prelude::*;

#[law]
fn bump(x: f64, h: f64) -> f64 {
    h * (1 - x.cos())
}

fn main() {}
