use kin::prelude::*;

#[constraint]
fn found(a: Coord, b: Coord) -> f64 {
    let x = loop {
        if a > b {
            break a;
        }
        break vec2(a, b);
    };
    x
}

fn main() {}
