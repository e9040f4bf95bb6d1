use kin::prelude::*;

#[force]
fn brake(x: Coord, i: Planar, c: f64) -> f64 {
    -c * x * i.theta
}

fn main() {
    let m = Mechanism::new("door");
    let _ = brake(kin::loads::turn(m.ground(), kin::check::any_planar()), 1.0, 2.0);
}
