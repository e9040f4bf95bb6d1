use kin::prelude::*;

#[constraint]
fn stop(i: Planar, open: bool) -> f64 {
    let gap = if open { i.r } else { i.theta };
    gap.sin()
}

fn main() {}
