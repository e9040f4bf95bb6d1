use kin::prelude::*;

#[constraint]
fn series(x: Coord, h: f64) -> f64 {
    let dead = h;
    let (mut term, mut sum) = (x, x);
    while term.abs() > 1e-12 {
        term = -term * x * x;
        sum += term;
    }
    sum
}

fn main() {
    let _ = series(kin::check::any_coord(), 1.0);
}
