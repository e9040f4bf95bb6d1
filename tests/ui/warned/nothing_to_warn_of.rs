use kin::prelude::*;

/// Used in bodies alone.
const MOST: f64 = 2.0;

#[derive(Clone)]
struct Gains {
    k: f64,
}

impl Gains {
    fn scaled<D: Dual>(&self, x: Real<D>) -> Real<D> {
        x * self.k
    }
}

fn wear<D: Dual>(phi: Real<D>, most: f64) -> Real<D> {
    most * phi.sin()
}

fn table(x: f64) -> f64 {
    x * x
}

#[constraint]
#[require(reach > 0.0)]
#[require(least < MOST)]
#[measure(along = j.local(i.point(u_i)).x, "m", ends = (-reach, reach))]
#[branch(side * (i.theta - j.theta) < 10.0, "it is turned over")]
fn slot(i: Planar, j: Planar, u_i: Vec2, reach: f64, least: f64, side: f64) -> f64 {
    j.local(i.point(u_i)).y
}

#[constraint]
fn own(i: Planar, gains: Gains, _spare: f64, t: Time) -> (f64, f64) {
    let [x, _] = [i.r.x, i.r.y];
    (gains.scaled(x) - wear(i.theta, MOST), table(2.0) * i.r.y - t)
}

#[constraint]
fn counted(x: Coord, mut h: f64, n: usize) -> f64 {
    let mut sum = x;
    for _ in 0..n {
        h *= 0.5;
        sum += h;
    }
    sum
}

#[constraint]
fn by_name(x: Coord, k: f64) -> f64 {
    use std::f64::consts::PI;
    type T = f64;
    fn square(x: T) -> T {
        x * x
    }
    let y: T = (x * PI).cos();
    if y > k { square(y) } else { y }
}

#[constraint(dual)]
#[allow(unused_variables)]
fn allowed(x: Coord, spare: f64) -> f64 {
    x
}

#[law]
#[require(h > 0.0)]
#[require(beta > 0.0)]
fn rise(x: f64, h: f64, beta: f64) -> f64 {
    0.5 * h * (1.0 - (PI * x).cos())
}

fn main() {
    let (i, x) = (kin::check::any_planar(), kin::check::any_coord());
    let _ = (slot(i, i, vec2(0.0, 0.0), 1.0, 1.0, 1.0), own(i, Gains { k: 1.0 }, 0.0), counted(x, 1.0, 3));
    let _ = (by_name(x, 1.0), allowed(x, 1.0), rise(1.0, 1.0));
}
