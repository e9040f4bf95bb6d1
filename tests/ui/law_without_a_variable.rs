use kin::prelude::*;

#[law]
fn constant() -> f64 {
    1.0
}

fn main() {}
