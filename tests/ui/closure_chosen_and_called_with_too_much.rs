use kin::prelude::*;

#[constraint]
fn chosen(a: Coord) -> f64 {
    let f = if a > 0.0 { f64::sin } else { f64::cos };
    f(a, a)
}

fn main() {}
