use kin::prelude::*;

#[constraint(warn_dual)]
fn series(x: Coord, h: f64) -> f64 {
    let (mut term, mut sum) = (x, x);
    while term.abs() > 1e-12 {
        term = -term * x * x;
        sum += term;
    }
    sum - h
}

#[constraint(warn_dual)]
fn read(x: Coord, h: f64) -> f64 {
    x - h
}

fn main() {
    let _ = (series(kin::check::any_coord(), 1.0), read(kin::check::any_coord(), 1.0));
}
