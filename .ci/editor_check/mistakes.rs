//! Constraints with mistakes in them, and unfinished ones: an editor works in their bodies all the
//! same.

use kin::prelude::*;

#[constraint]
fn law_as_a_number(i: Planar, profile: Law) -> f64 {
    let p = i.r;
    p.norm() - profile
}

#[constraint]
fn wrong_signature(i: &Planar, k: f64) -> f64 {
    let distance = i.r.x;
    distance - k
}

#[constraint]
fn unfinished(i: Planar, j: Planar, k: f64) -> f64 {
    let s = j.local(i.
    k
}

#[law]
fn law_of_nothing(x: f64, h: f64) -> f64 {
    let y = x * h;
    y.nothing()
}

fn main() {}
