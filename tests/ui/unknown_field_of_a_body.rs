use kin::prelude::*;

#[constraint]
fn on_line(i: Planar, h: f64) -> f64 {
    i.y - h
}

fn main() {}
