use kin::prelude::*;

#[law]
fn rise(x: f64, h: f64, forgotten: f64) -> f64 {
    x * h
}

fn main() {
    let _ = rise(1.0, 2.0);
}
