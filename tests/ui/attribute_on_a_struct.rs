use kin::prelude::*;

#[constraint]
struct Level {
    h: f64,
}

fn main() {}
