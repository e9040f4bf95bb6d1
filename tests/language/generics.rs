//! Signatures with lengths, arrays of bodies, and what lives as long as the program.

use kin::prelude::*;

use crate::twice;

/// Legs of a platform.
pub const LEGS: usize = 3;

#[constraint(LEGS = 3)]
pub fn legs(q: [Coord; LEGS], rods: [f64; LEGS]) -> f64 {
    let mut sum = 0.0;
    for k in 0..LEGS {
        sum += q[k].sin() * rods[k];
    }
    sum - q.iter().map(|x| x * x).sum::<f64>() / LEGS as f64
}

#[constraint(N = 4)]
pub fn mean_of<const N: usize>(q: [Coord; N], w: [f64; N]) -> [f64; N] {
    let mean = q.iter().sum::<f64>() / N as f64;
    std::array::from_fn(|k| (q[k] - mean) * w[k])
}

#[test]
fn lengths_of_the_attribute() {
    let constraint = legs(std::array::from_fn(|_| kin::check::any_coord()), [1.0, 2.0, 3.0]);
    assert_eq!(
        (constraint.route(), constraint.facts().pattern.len()),
        (kin::extend::Route::Symbolic, 3)
    );
    assert_eq!(
        kin::extend::terms(&constraint, &[0.0, 3.0, 0.0], &[], 0.0).c[0],
        2.0 * 3.0_f64.sin() - 3.0
    );
    kin::check::derivatives(constraint);
    let constraint =
        mean_of(std::array::from_fn(|_| kin::check::any_coord()), [1.0, 2.0, 3.0, 4.0]);
    assert_eq!(constraint.route(), kin::extend::Route::Symbolic);
    assert_eq!(
        kin::extend::terms(&constraint, &[0.0, 1.0, 2.0, 5.0], &[], 0.0).c.as_slice(),
        [-2.0, -2.0, 0.0, 12.0]
    );
    kin::check::derivatives(constraint);
}

twice! { Symbolic planar_bodies_in_an_array(planars (vec2(1.0, 0.5)) planar): fn f(chain: [Planar; 3], u: Vec2, ground: Planar) -> [Vec2; 3] {
    let mut last = ground;
    chain.map(|body| {
        let gap = last.point(u) - body.point(-u);
        last = body;
        gap
    })
} }

twice! { Symbolic spatial_bodies_in_an_array(coord spatials (vec3(0.0, 0.0, 1.0))): fn f(a: Coord, b: [Spatial; 2], h: Vec3) -> (f64, f64) {
    let [i, j] = b;
    let mut sum = 0.0;
    for body in &b {
        sum += body.direction(h).z + body.r.x;
    }
    (i.direction(h).dot(j.r) - a, sum * b.len() as f64)
} }

twice! { Symbolic what_lives_as_long_as_the_program(coord (&[1.0, 2.0, 3.0]) ("fast") (&(0.5, 2.0))):
fn f(a: Coord, table: &'static [f64], mode: &'static str, pair: &'static (f64, f64)) -> f64 {
    let gain = if mode == "fast" { 2.0 } else { 1.0 };
    a.sin() * table[1] * gain - pair.0 * a * pair.1
} }

/// A table that is borrowed for as long as its type says, with entries of any type.
#[derive(Clone, Copy)]
pub struct Table<'a, T> {
    pub entries: &'a [T],
    pub scale: T,
}

static HEIGHTS: [f64; 3] = [0.25, -1.0, 0.5];

twice! { Symbolic types_with_lifetimes_and_types_of_their_own(coord coord (Table { entries: &HEIGHTS, scale: 2.0 })):
fn f(a: Coord, b: Coord, table: Table<'static, f64>) -> f64 {
    fn larger<'a>(x: &'a f64, y: &'a f64) -> &'a f64 {
        if x > y { x } else { y }
    }
    struct Pair<'a, T> {
        first: &'a T,
        second: &'a T,
    }
    impl<'a> Pair<'a, f64> {
        fn product(&self) -> f64 {
            self.first * self.second
        }
    }
    let pair = Pair { first: &a, second: &b };
    pair.product() * table.scale - larger(&a, &b) * table.entries[1] + table.entries[2]
} }
