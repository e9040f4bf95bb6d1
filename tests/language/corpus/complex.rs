//! Loops by complex numbers, and other planes of numbers: dual quaternions, split forms,
//! polynomials.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use kin::prelude::*;

use crate::twice;

/// A complex number over any number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct C<T> {
    pub re: T,
    pub im: T,
}

impl<T: Add<Output = T>> Add for C<T> {
    type Output = C<T>;
    fn add(self, o: C<T>) -> C<T> {
        C { re: self.re + o.re, im: self.im + o.im }
    }
}

impl<T: Sub<Output = T>> Sub for C<T> {
    type Output = C<T>;
    fn sub(self, o: C<T>) -> C<T> {
        C { re: self.re - o.re, im: self.im - o.im }
    }
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>> Mul for C<T> {
    type Output = C<T>;
    fn mul(self, o: C<T>) -> C<T> {
        C { re: self.re * o.re - self.im * o.im, im: self.re * o.im + self.im * o.re }
    }
}

impl<T> Div for C<T>
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T> + Div<Output = T>,
{
    type Output = C<T>;
    fn div(self, o: C<T>) -> C<T> {
        let n = o.re * o.re + o.im * o.im;
        C { re: (self.re * o.re + self.im * o.im) / n, im: (self.im * o.re - self.re * o.im) / n }
    }
}

impl<T: Neg<Output = T>> Neg for C<T> {
    type Output = C<T>;
    fn neg(self) -> C<T> {
        C { re: -self.re, im: -self.im }
    }
}

twice! { Symbolic six_bar_by_complex_numbers(coords): fn f(q: [Coord; 4]) -> [f64; 4] {
    let turned = |length: f64, angle: f64| C { re: length * angle.cos(), im: length * angle.sin() };
    let [a, b, c, d] = q;
    let coupler = turned(1.0, a) + turned(2.2, b);
    let first = coupler - turned(1.8, c) - C { re: 2.5, im: 0.0 };
    let second = turned(1.0, a) + turned(0.8, b + 0.4) + turned(1.1, d) - C { re: 0.5, im: 1.0 };
    [first.re, first.im, second.re, second.im]
} }

twice! { Symbolic quotients_of_complex_numbers(planar coord): fn f(i: Planar, k: Coord) -> (f64, f64) {
    let z = C { re: i.r.x, im: i.r.y };
    let w = C { re: 3.0 + k, im: i.theta };
    let ratio = z / w + -z;
    (ratio.re - 0.1, ratio.im)
} }

twice! { Symbolic joukowski(coord coord coord): fn f(phi: Coord, x: Coord, y: Coord) -> Vec2 {
    let one = C { re: 1.0, im: 0.0 };
    let z = C { re: -0.1 + 1.15 * phi.cos(), im: 0.05 + 1.15 * phi.sin() };
    let w = z + one / z;
    vec2(x - w.re, y - w.im)
} }

twice! { Symbolic complex_polynomial(coord coord): fn f(x: Coord, y: Coord) -> (f64, f64) {
    let coefficients = [C { re: 1.0, im: 0.5 }, C { re: -0.5, im: 0.0 }, C { re: 0.0, im: 1.0 }, C { re: 0.25, im: 0.0 }];
    let z = C { re: x, im: y };
    let mut sum = C { re: 0.0, im: 0.0 };
    for c in coefficients.iter().rev() {
        sum = sum * z + *c;
    }
    (sum.re, sum.im)
} }

twice! { Symbolic roots_of_unity(coord coord (5)): fn f(x: Coord, y: Coord, _sides: usize) -> f64 {
    const SIDES: usize = 5;
    let mut product = C { re: 1.0, im: 0.0 };
    for k in 0..SIDES {
        let phi = std::f64::consts::TAU * k as f64 / SIDES as f64;
        product = product * C { re: x - phi.cos(), im: y - phi.sin() };
    }
    product.re - product.im - 0.5
} }

twice! { Symbolic moebius(coords): fn f(q: [Coord; 4]) -> (f64, f64) {
    #[derive(Clone, Copy)]
    struct Z(f64, f64);
    impl Z {
        const I: Z = Z(0.0, 1.0);
        fn over(self, Z(c, d): Z) -> Z {
            let n = c * c + d * d;
            Z((self.0 * c + self.1 * d) / n, (self.1 * c - self.0 * d) / n)
        }
        fn norm(&self) -> f64 {
            self.0.hypot(self.1)
        }
    }
    let z = Z(q[0], q[1]);
    let w = Z(z.0 - Z::I.0, z.1 - Z::I.1).over(Z(z.0 + 3.0, z.1 + Z::I.1));
    (w.0 - q[2], w.norm() - q[3])
} }

twice! { Symbolic square_root_of_a_complex_number(coord coord): fn f(x: Coord, y: Coord) -> (f64, f64) {
    let r = (x * x + y * y).sqrt();
    let re = (0.5 * (r + x)).sqrt();
    let im = (0.5 * (r - x)).sqrt() * if y < 0.0 { -1.0 } else { 1.0 };
    (re - 0.5, im + 0.1 * x)
} }

/// a + ε b with ε² = 0.
#[derive(Clone, Copy)]
pub struct Screw<T>(pub T, pub T);

impl<T: Copy + Add<Output = T> + Mul<Output = T>> Mul for Screw<T> {
    type Output = Screw<T>;
    fn mul(self, o: Screw<T>) -> Screw<T> {
        Screw(self.0 * o.0, self.0 * o.1 + self.1 * o.0)
    }
}

impl<T: Copy + AddAssign> AddAssign for Screw<T> {
    fn add_assign(&mut self, o: Screw<T>) {
        self.0 += o.0;
        self.1 += o.1;
    }
}

twice! { Symbolic spherical_four_bar_by_dual_angles(coord coord): fn f(a: Coord, s: Coord) -> (f64, f64) {
    let cosine = Screw(a.cos(), -s * a.sin());
    let sine = Screw(a.sin(), s * a.cos());
    let mut sum = cosine * cosine;
    sum += sine * Screw(0.5, 0.1);
    (sum.0 - 0.7, sum.1)
} }

twice! { Symbolic dual_quaternion_of_a_screw(coord coord): fn f(phi: Coord, s: Coord) -> [f64; 4] {
    let (sin, cos) = (0.5 * phi).sin_cos();
    let real = [cos, 0.0, 0.0, sin];
    let dual = [-0.5 * s * sin, 0.0, 0.0, 0.5 * s * cos];
    let unit: f64 = real.iter().zip(dual.iter()).map(|(a, b)| a * b).sum();
    [real[0] - 0.9, real[3] - dual[0], dual[3] - 0.2, unit + s - 0.1]
} }

twice! { Symbolic tangent_half_angle(coord coord): fn f(u: Coord, v: Coord) -> (f64, f64) {
    let half = |t: f64| ((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
    let (ca, sa) = half(u);
    let (cb, sb) = half(v);
    (1.5 * ca + cb - 1.0, 1.5 * sa + sb - 0.75)
} }

twice! { Symbolic resultant_of_two_quadratics(coords): fn f(q: [Coord; 3]) -> f64 {
    let a = [1.0, q[0], q[1]];
    let b = [2.0, q[2], -1.0];
    let sylvester = [
        [a[0], a[1], a[2], 0.0],
        [0.0, a[0], a[1], a[2]],
        [b[0], b[1], b[2], 0.0],
        [0.0, b[0], b[1], b[2]],
    ];
    fn det<const N: usize>(m: [[f64; N]; N]) -> f64 {
        let mut sum = 0.0;
        for i in 0..N {
            for j in 0..N {
                sum += if i == j { m[i][j] * m[i][j] } else { 0.5 * m[i][j] };
            }
        }
        sum
    }
    det(sylvester) - 12.0
} }

twice! { Symbolic cardano(coord coord): fn f(p: Coord, x: Coord) -> f64 {
    let p = 1.0 + p * p;
    let r = 0.5;
    let d = (r * r / 4.0 + p * p * p / 27.0).sqrt();
    let root = (d - r / 2.0).cbrt() - (d + r / 2.0).cbrt();
    x - root
} }
