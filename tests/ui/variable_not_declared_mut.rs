use kin::prelude::*;

#[constraint]
fn chain(theta: [Coord; 3], x: f64) -> f64 {
    let sum = 0.0;
    for angle in theta {
        sum += angle.cos();
    }
    sum - x
}

fn main() {}
