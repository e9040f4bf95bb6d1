//! Rotations in space: quaternions, rotation vectors, Euler angles, Cayley's parameters.

use std::ops::{Mul, Neg};

use kin::prelude::*;

use crate::twice;

/// A quaternion over any number.
#[derive(Clone, Copy, Debug)]
pub struct Quat<T> {
    pub w: T,
    pub v: [T; 3],
}

impl<T: Copy + Neg<Output = T>> Quat<T> {
    pub fn conj(self) -> Self {
        Quat { w: self.w, v: [-self.v[0], -self.v[1], -self.v[2]] }
    }
}

impl<T> Mul for Quat<T>
where
    T: Copy + Mul<Output = T> + std::ops::Add<Output = T> + std::ops::Sub<Output = T>,
{
    type Output = Quat<T>;

    fn mul(self, o: Self) -> Self {
        let [a, b, c] = self.v;
        let [d, e, f] = o.v;
        Quat {
            w: self.w * o.w - a * d - b * e - c * f,
            v: [
                self.w * d + a * o.w + b * f - c * e,
                self.w * e - a * f + b * o.w + c * d,
                self.w * f + a * e - b * d + c * o.w,
            ],
        }
    }
}

twice! { Symbolic quaternion_of_the_module(spatial spatial): fn f(i: Spatial, j: Spatial) -> [f64; 3] {
    let p = Quat { w: i.p.e0, v: [i.p.e1, i.p.e2, i.p.e3] };
    let r = Quat { w: j.p.e0, v: [j.p.e1, j.p.e2, j.p.e3] };
    (p.conj() * r).v
} }

twice! { Symbolic logarithm_of_a_quaternion(spatial): fn f(i: Spatial) -> [f64; 3] {
    let q = [i.p.e0, i.p.e1, i.p.e2, i.p.e3];
    let n = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [w, x, y, z] = q.map(|x| x / n);
    let s = (x * x + y * y + z * z).sqrt();
    let k = if s < 1e-9 { 2.0 } else { 2.0 * s.atan2(w) / s };
    [k * x - 0.1, k * y, k * z + 0.2]
} }

twice! { Symbolic exponential_of_a_rotation_vector(coord coord coord): fn f(a: Coord, b: Coord, c: Coord) -> [f64; 4] {
    let w = vec3(a, b, c);
    let angle2 = w.norm_squared();
    let (half_cos, sinc) = if angle2 < 1e-8 {
        (1.0 - angle2 / 8.0, 0.5 - angle2 / 48.0)
    } else {
        let angle = angle2.sqrt();
        ((0.5 * angle).cos(), (0.5 * angle).sin() / angle)
    };
    [half_cos - 0.9, sinc * w.x, sinc * w.y, sinc * w.z]
} }

twice! { Symbolic cardan_angles(spatial coord coord coord): fn f(i: Spatial, roll: Coord, pitch: Coord, yaw: Coord) -> [f64; 3] {
    let m = i.a();
    [m[(2, 1)] - roll.sin() * pitch.cos(), m[(2, 0)] + pitch.sin(), m.m21 - yaw.sin() * pitch.cos()]
} }

twice! { Symbolic euler_angles_by_three_matrices(coord coord coord): fn f(phi: Coord, theta: Coord, psi: Coord) -> Vec3 {
    let about_z = |a: f64| Mat3::from_rows([vec3(a.cos(), -a.sin(), 0.0), vec3(a.sin(), a.cos(), 0.0), vec3(0.0, 0.0, 1.0)]);
    let about_x = |a: f64| Mat3::from_rows([vec3(1.0, 0.0, 0.0), vec3(0.0, a.cos(), -a.sin()), vec3(0.0, a.sin(), a.cos())]);
    let a = about_z(phi) * about_x(theta) * about_z(psi);
    a * vec3(1.0, 2.0, 3.0) - vec3(3.0, 2.0, 1.0)
} }

twice! { Symbolic cayley(coord coord coord): fn f(x: Coord, y: Coord, z: Coord) -> [f64; 3] {
    let s = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    let n = 1.0 + x * x + y * y + z * z;
    let v = [1.0, 0.0, -1.0];
    let times = |m: &[[f64; 3]; 3], v: &[f64; 3]| -> [f64; 3] {
        let mut out = [0.0; 3];
        for (row, out) in m.iter().zip(out.iter_mut()) {
            *out = row.iter().zip(v).map(|(a, b)| a * b).sum();
        }
        out
    };
    let sv = times(&s, &v);
    let ssv = times(&s, &sv);
    std::array::from_fn(|k| v[k] + 2.0 / n * (sv[k] + ssv[k]) - 0.5)
} }

twice! { Symbolic constant_velocity_joint(spatial spatial): fn f(i: Spatial, j: Spatial) -> f64 {
    let [fi, gi] = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0)].map(|u| i.direction(u));
    let [fj, gj] = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0)].map(|u| j.direction(u));
    fi.dot(gj) - gi.dot(fj)
} }

twice! { Symbolic angle_about_an_axis(spatial spatial coord): fn f(i: Spatial, j: Spatial, phi: Coord) -> f64 {
    let u = j.direction(vec3(1.0, 0.0, 0.0));
    let v = i.direction(vec3(1.0, 0.0, 0.0));
    let w = i.direction(vec3(0.0, 1.0, 0.0));
    u.dot(w) * phi.cos() - u.dot(v) * phi.sin()
} }

twice! { Symbolic swing_and_twist(spatial): fn f(i: Spatial) -> (f64, f64) {
    let p = &i.p;
    let twist = 2.0 * p.e3.atan2(p.e0);
    let swing = 2.0 * (p.e1.hypot(p.e2)).atan2(p.e0.hypot(p.e3));
    (twist - 0.3, swing - 0.2)
} }

twice! { Symbolic shortest_way_between(spatial spatial): fn f(i: Spatial, j: Spatial) -> f64 {
    let dot = i.p.e0 * j.p.e0 + i.p.e1 * j.p.e1 + i.p.e2 * j.p.e2 + i.p.e3 * j.p.e3;
    let dot = if dot.is_sign_negative() { -dot } else { dot };
    let size = i.p.norm() * j.p.norm();
    2.0 * (dot / size).min(0.99).acos() - 0.4
} }

twice! { Symbolic slerp(coord coord): fn f(s: Coord, t: Coord) -> [f64; 4] {
    let from = [1.0, 0.0, 0.0, 0.0];
    let to = [0.5_f64.cos(), 0.5_f64.sin() * 0.48, 0.5_f64.sin() * 0.64, 0.5_f64.sin() * 0.6];
    let dot: f64 = from.iter().zip(&to).map(|(a, b)| a * b).sum();
    let omega = dot.acos();
    let ka = ((1.0 - s) * omega).sin() / omega.sin();
    let kb = (s * omega).sin() / omega.sin();
    std::array::from_fn(|k| ka * from[k] + kb * to[k] - t * to[k])
} }

twice! { Symbolic frobenius_distance(spatial (EulerParameters::from_axis_angle(vec3(0.0, 0.0, 1.0), 0.3).rotation())): fn f(i: Spatial, goal: Mat3) -> f64 {
    let d = i.a() - goal;
    let mut sum = 0.0;
    for r in 0..3 {
        for c in 0..3 {
            sum += d[(r, c)].powi(2);
        }
    }
    sum - 0.5
} }

twice! { Symbolic trace_of_a_relative_rotation(spatial spatial): fn f(i: Spatial, j: Spatial) -> f64 {
    let relative = i.a().transpose() * j.a();
    0.5 * (relative.trace() - 1.0) - 0.25_f64.cos()
} }

twice! { Symbolic angular_velocity_of_a_screw(coord time (0.01)): fn f(z: Coord, t: Time, lead: f64) -> f64 {
    let turns = 3.0 * t + 0.5 * (2.0 * t).sin();
    z - lead / std::f64::consts::TAU * turns * std::f64::consts::TAU
} }

twice! { Symbolic three_points_on_a_plane(spatial ([vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(-1.0, -1.0, 0.5)]) (vec3(0.0, 0.6, 0.8))):
fn f(i: Spatial, feet: [Vec3; 3], normal: Vec3) -> [f64; 3] {
    feet.map(|u| i.point(u).dot(normal) - 0.5)
} }

twice! { Symbolic line_through_a_ring(spatial spatial (vec3(0.0, 0.0, 1.0))): fn f(rod: Spatial, ring: Spatial, h: Vec3) -> (f64, f64) {
    let d = ring.r - rod.r;
    let h = rod.direction(h);
    let [across, over] = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0)].map(|u| rod.direction(u));
    let _along = d.dot(h);
    (d.dot(across), d.dot(over))
} }

twice! { Symbolic common_normal_of_two_axes(spatial spatial (0.4)): fn f(i: Spatial, j: Spatial, offset: f64) -> f64 {
    let z = vec3(0.0, 0.0, 1.0);
    let a = i.direction(z);
    let b = j.direction(z);
    let n = a.cross(b);
    (j.r - i.r).dot(n) - offset * n.norm()
} }

twice! { Symbolic plucker_lines_meet(spatial coord): fn f(i: Spatial, s: Coord) -> f64 {
    struct Line {
        direction: Vec3,
        moment: Vec3,
    }
    impl Line {
        fn through(p: Vec3, direction: Vec3) -> Self {
            Line { direction, moment: p.cross(direction) }
        }
        fn reciprocal(&self, other: &Line) -> f64 {
            self.direction.dot(other.moment) + other.direction.dot(self.moment)
        }
    }
    let first = Line::through(i.r, i.direction(vec3(0.0, 0.0, 1.0)));
    let second = Line::through(vec3(s, 0.0, 1.0), vec3(0.0, 1.0, 0.0));
    first.reciprocal(&second)
} }
