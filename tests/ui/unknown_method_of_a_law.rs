use kin::prelude::*;

#[constraint]
fn driver(crank: Planar, motion: Law, t: Time) -> f64 {
    crank.theta - motion.eval(t)
}

fn main() {}
