use kin::prelude::*;

#[constraint]
fn doubled(q: [Coord; 3]) -> f64 {
    let parts = q;
    for part in parts.iter_mut() {
        *part *= 2.0;
    }
    parts[0] + parts[1] - parts[2]
}

fn main() {}
