use kin::prelude::*;

#[law]
fn table(x: f64, c: [f64; 1000000]) -> f64 {
    x * c[0]
}

fn main() {}
