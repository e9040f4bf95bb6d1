use kin::prelude::*;

#[constraint]
fn guarded(i: Planar) -> f64 {
    for k in 0..3 {
        if i.theta > k as f64 {
            return i.r;
        }
    }
    i.theta
}

fn main() {}
