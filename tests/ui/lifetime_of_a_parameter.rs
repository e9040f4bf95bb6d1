use kin::prelude::*;

#[constraint]
fn tabled<'a>(a: Coord, table: &'a [f64]) -> f64 {
    a - table[0]
}

fn main() {}
