//! Good Rust that hangs on types: the user's own structs and generics, conversions, other crates'
//! vectors, states and tables handed over.

use std::ops::{Add, Mul, Sub};

use kin::emitted::PlanarState;
use kin::nalgebra::Vector3;
use kin::prelude::*;

use crate::twice;

macro_rules! with_type {
    ($name:ident, $t:ty, $number:ty) => {
        #[constraint]
        pub fn $name(a: Coord, k: $t, all: [$number; 2]) -> $number {
            let x: $number = a * k;
            let both: [$number; 2] = [x.sin(), x * all[0]];
            both[0] + both[1] - all[1]
        }
    };
}
with_type!(types_of_a_macro, f64, f64);

#[test]
fn types_that_a_macro_hands_over() {
    let constraint = types_of_a_macro(kin::check::any_coord(), 2.0, [3.0, 4.0]);
    assert_eq!(constraint.route(), Route::Symbolic);
    assert_eq!(kin::extend::terms(&constraint, &[0.5], &[], 0.0).c[0], 1.0_f64.sin() + 3.0 - 4.0);
    kin::check::derivatives(constraint);
}

pub mod belt {
    use kin::prelude::{Route, Routed, constraint};

    /// A link of a chain: the name is the user's here.
    #[derive(Clone, Copy)]
    pub struct Link {
        pub pitch: f64,
        pub roller: f64,
    }

    impl Link {
        pub fn point(&self, n: f64) -> f64 {
            self.pitch * n + self.roller
        }
    }

    #[constraint]
    pub fn own_link(a: Coord, link: Link) -> f64 {
        a.sin() * link.pitch - link.roller + link.point(2.0)
    }

    #[test]
    fn a_struct_of_the_users_may_be_called_link() {
        let constraint = own_link(kin::check::any_coord(), Link { pitch: 0.5, roller: 0.1 });
        assert_eq!(constraint.route(), Route::Symbolic);
        assert_eq!(kin::extend::terms(&constraint, &[0.0], &[], 0.0).c[0], 1.0);
        kin::check::derivatives(constraint);
    }
}

fn length(points: &[(f64, f64)]) -> f64 {
    points.windows(2).map(|pair| (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1)).sum()
}

fn centre(points: &[(f64, f64); 3]) -> (f64, f64) {
    (points.iter().map(|p| p.0).sum::<f64>() / 3.0, points.iter().map(|p| p.1).sum::<f64>() / 3.0)
}

twice! { Symbolic tables_of_pairs(coord (vec![(0.0, 1.0), (2.0, 3.0)]) ([(0.0, 0.0), (1.0, 0.5), (2.0, 3.0)])):
fn f(a: Coord, track: Vec<(f64, f64)>, corners: [(f64, f64); 3]) -> f64 {
    let (x, y) = centre(&corners);
    a * length(&track) + length(&corners) * x - y + length(&[(0.0, 1.0), (1.0, 1.0)])
} }

fn interpolate<D: Dual>(table: &[(f64, f64)], x: Real<D>) -> Real<D> {
    let (x0, y0) = table[0];
    let (x1, y1) = table[1];
    (x - x0) * ((y1 - y0) / (x1 - x0)) + y0
}

#[constraint]
pub fn through_a_table(a: Coord, table: Vec<(f64, f64)>) -> f64 {
    interpolate(&table, a.sin()) + interpolate(&[(0.0, 1.0), (1.0, 3.0)], a * a)
}

#[test]
fn a_helper_of_a_table_and_a_coordinate() {
    let constraint = through_a_table(kin::check::any_coord(), vec![(0.0, 2.0), (1.0, 5.0)]);
    assert_eq!(constraint.route(), Route::Symbolic);
    assert!(
        (kin::extend::terms(&constraint, &[0.5], &[], 0.0).c[0]
            - (3.0 * 0.5_f64.sin() + 2.0 + 0.5 + 1.0))
            .abs()
            < 1e-15
    );
    kin::check::derivatives(constraint);
}

#[derive(Clone, Copy)]
pub struct Complex<T> {
    pub re: T,
    pub im: T,
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>> Complex<T> {
    pub fn new(re: T, im: T) -> Self {
        Complex { re, im }
    }

    fn norm_squared(self) -> T {
        self.re * self.re + self.im * self.im
    }

    fn scale(self, k: T) -> Self {
        Complex { re: self.re * k, im: self.im * k }
    }
}

impl<T: Add<Output = T>> Add for Complex<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Complex { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<T: Copy + Sub<Output = T> + Add<Output = T> + Mul<Output = T>> Mul for Complex<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Complex {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

twice! { Symbolic complex_loop(coord coord (2.0)): fn f(a: Coord, b: Coord, k: f64) -> (f64, f64) {
    let first = Complex { re: a.cos(), im: a.sin() };
    let second = Complex { re: k * b.cos(), im: k * b.sin() };
    let sum = first * second + first;
    (sum.re - 1.0, sum.im + first.re)
} }

twice! { Symbolic complex_by_constructor(coord coord (2.0)): fn f(a: Coord, b: Coord, k: f64) -> (f64, f64) {
    let z = Complex::new(a.cos(), a.sin());
    let w = Complex::new(k, b);
    let product = z * w;
    (product.norm_squared() - 1.0, z.scale(b).im)
} }

#[derive(Clone, Copy)]
pub struct Gear {
    pub teeth: f64,
    pub module: f64,
}

twice! { Symbolic a_struct_of_parameters(coord (12.0)): fn f(a: Coord, teeth: f64) -> f64 {
    let gear = Gear { teeth, module: 0.5 };
    let other = Gear { teeth: 24.0, ..gear };
    a * gear.teeth * gear.module - other.teeth * other.module
} }

twice! { Symbolic a_struct_inside(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    #[derive(Clone, Copy)]
    struct Polar { r: f64, phi: f64 }
    impl Polar {
        fn new(r: f64, phi: f64) -> Self {
            Self { r, phi }
        }
        fn x(&self) -> f64 {
            self.r * self.phi.cos()
        }
        fn turn(&mut self, by: f64) {
            self.phi += by;
        }
    }
    impl std::ops::Add for Polar {
        type Output = Polar;
        fn add(self, other: Polar) -> Polar {
            Polar { r: self.r + other.r, phi: self.phi + other.phi }
        }
    }
    let mut p = Polar::new(a, b);
    p.turn(0.5);
    let sum = p + Polar { r: 1.0, phi: a };
    sum.x() + p.x()
} }

twice! { Symbolic const_generics_inside(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    fn mean<const N: usize>(all: [f64; N]) -> f64 {
        all.iter().sum::<f64>() / N as f64
    }
    fn polynomial<const N: usize>(c: &[f64; N], x: f64) -> f64 {
        let mut sum = 0.0;
        for k in (0..N).rev() {
            sum = sum * x + c[k];
        }
        sum
    }
    mean([a, b, a * b]) - mean::<2>([a, 1.0]) + polynomial(&[1.0, 2.0, 3.0], b)
} }

twice! { Symbolic integers_inside(coord): fn f(a: Coord) -> f64 {
    fn chebyshev(n: usize, x: f64) -> f64 {
        match n {
            0 => 1.0,
            1 => x,
            _ => 2.0 * x * chebyshev(n - 1, x) - chebyshev(n - 2, x),
        }
    }
    fn sign(k: i32) -> f64 {
        if k % 2 == 0 { 1.0 } else { -1.0 }
    }
    chebyshev(4, a) + sign(3) * a - sign(2)
} }

twice! { Symbolic bounds_inside(coord coord): fn f(a: Coord, b: Coord) -> (f64, f64) {
    fn blend<T: Add<Output = T> + Mul<Output = T> + Copy>(x: T, y: T, w: T) -> T {
        x * w + y * w
    }
    fn largest<T>(x: T, y: T) -> T
    where
        T: PartialOrd,
    {
        if x > y { x } else { y }
    }
    (blend(a, b, 0.5) - largest(a, b), blend(2.0, b, a))
} }

twice! { Symbolic through_nalgebra(spatial spatial (vec3(1.0, 0.5, 0.0))): fn f(i: Spatial, j: Spatial, u: Vec3) -> (Vec3, f64) {
    let p = Vector3::new(i.r.x, i.r.y, i.r.z);
    let back: Vec3 = p.into();
    let q: Vector3<f64> = j.point(u).into();
    let d = Vec3::from(p) - Vec3::from(q);
    (back - j.r, d.norm_squared() - p.dot(&q))
} }

#[derive(Clone)]
pub struct Frame {
    pub array: [f64; 2],
    pub pair: (f64, f64),
    pub vector: Vec2,
}

fn frame() -> Frame {
    Frame { array: [1.0, 2.0], pair: (0.5, 0.25), vector: vec2(3.0, -1.0) }
}

twice! { Symbolic vectors_from_fields(planar (frame())): fn f(i: Planar, frame: Frame) -> Vec2 {
    let v: Vec2 = frame.vector;
    i.point(Vec2::from(frame.array)) - Vec2::from(frame.pair) + v
} }

twice! { Symbolic vectors_from_fields_in_a_dual_body(planar (frame()) (2)): fn f(i: Planar, frame: Frame, n: usize) -> Vec2 {
    let x = i.r.x;
    let y = i.r.y;
    Vec2::from([x, y]) + Vec2::from((y, x)) * n as f64 - Vec2::from(frame.array)
} }

twice! { Symbolic optional_branches(coord (2.0)): fn f(a: Coord, k: f64) -> f64 {
    let limit = if a > 0.5 { Some(k * a) } else { None };
    let other = match limit {
        Some(x) if x > 2.0 => Some(2.0),
        Some(x) => Some(x),
        None => None,
    };
    if let Some(x) = other { a * x } else { a.cos() }
} }

twice! { Symbolic assigned_later(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    let (x, y);
    if a > b {
        x = a;
        y = b.sin();
    } else {
        x = b;
        y = a.sin();
    }
    let z;
    z = x * y;
    z + x
} }

twice! { Symbolic methods_by_their_paths(planar spatial (vec2(1.0, 0.5)) (vec3(0.0, 1.0, 0.5))):
fn f(i: Planar, s: Spatial, u: Vec2, h: Vec3) -> (Vec2, f64) {
    (Planar::point(&i, u) - Vec2::perp(u), Vec3::dot(Spatial::direction(&s, h), h) + f64::sin(i.theta))
} }

fn height<T: Copy + Mul<Output = T> + Add<Output = T>>(body: &PlanarState<T>, x: T) -> T {
    body.r.y * body.cos + x * body.sin
}

fn plain_height(body: PlanarState, x: f64) -> f64 {
    body.r.y * 2.0 + x
}

#[constraint]
pub fn of_a_state(i: Planar, j: Planar, k: f64) -> f64 {
    height(&i, k) - height(&j, i.theta)
}

#[test]
fn a_state_handed_to_a_helper() {
    let constraint = of_a_state(kin::check::any_planar(), kin::check::any_planar(), 2.0);
    assert_eq!(constraint.route(), Route::Symbolic);
    let c = kin::extend::terms(&constraint, &[1.0, 2.0, 0.0, 3.0, 4.0, 0.0], &[], 0.0).c[0];
    assert_eq!(c, 2.0 - 4.0);
    assert_eq!(plain_height(PlanarState::new([0.0, 1.0, 0.0]), 1.0), 3.0);
    kin::check::derivatives(constraint);
}

fn by_parts<D: Dual>(n: u32, k: i32, x: Real<D>) -> Real<D> {
    let order = x.total_cmp(&Real::from(0.5));
    if order.is_lt() { Real::from(n) * x } else { Real::from(k) + x * x }
}

#[constraint]
pub fn real_from_integers(a: Coord) -> f64 {
    by_parts(2, -3, a)
}

#[test]
fn a_real_is_made_of_integers_and_has_an_order() {
    kin::check::derivatives(real_from_integers(kin::check::any_coord()));
    assert_eq!(
        kin::extend::terms(&real_from_integers(kin::check::any_coord()), &[1.0], &[], 0.0).c[0],
        -2.0
    );
}
