//! "Spherical", "Cylindrical" and "Universal Joint Constraint", derived by hand for Euler
//! parameters, A = (2 e0² − 1) I + 2 e eᵀ + 2 e0 ẽ.

use kin::check::any_spatial;
use kin::prelude::*;
use nalgebra::{DMatrix, DVector, Matrix3x4, Vector3, Vector4};

use crate::support::*;

type V3 = Vector3<f64>;

/// One body: R, p and their rates.
#[derive(Clone, Copy)]
struct Body {
    r: V3,
    p: Vector4<f64>,
    v: V3,
    pd: Vector4<f64>,
}

impl Body {
    fn new(q: &[f64], qd: &[f64]) -> Self {
        let r = V3::from_column_slice(&q[..3]);
        let v = V3::from_column_slice(&qd[..3]);
        Body {
            r,
            p: Vector4::from_column_slice(&q[3..]),
            v,
            pd: Vector4::from_column_slice(&qd[3..]),
        }
    }

    /// A u = (2 e0² − 1) u + 2 e (e · u) + 2 e0 e × u
    fn turned(&self, u: V3) -> V3 {
        let e0 = self.p[0];
        let e = V3::new(self.p[1], self.p[2], self.p[3]);
        (2.0 * e0 * e0 - 1.0) * u + 2.0 * e.dot(&u) * e + 2.0 * e0 * e.cross(&u)
    }

    /// ∂(A u)/∂p = [4 e0 u + 2 e × u,  2 (e · u) I + 2 e uᵀ − 2 e0 ũ]
    fn slope(&self, u: V3) -> Matrix3x4<f64> {
        let e0 = self.p[0];
        let e = V3::new(self.p[1], self.p[2], self.p[3]);
        let by_e = 2.0 * e.dot(&u) * nalgebra::Matrix3::identity() + 2.0 * e * u.transpose()
            - 2.0 * e0 * u.cross_matrix();
        let mut all = Matrix3x4::zeros();
        all.set_column(0, &(4.0 * e0 * u + 2.0 * e.cross(&u)));
        all.fixed_columns_mut::<3>(1).copy_from(&by_e);
        all
    }

    /// d(A u)/dt along ṗ
    fn rate(&self, u: V3) -> V3 {
        self.slope(u) * self.pd
    }

    /// ((A u)_p ṗ)_p ṗ = 4 ė0² u + 4 ė (ė · u) + 4 ė0 ė × u
    fn second(&self, u: V3) -> V3 {
        let d0 = self.pd[0];
        let d = V3::new(self.pd[1], self.pd[2], self.pd[3]);
        4.0 * d0 * d0 * u + 4.0 * d.dot(&u) * d + 4.0 * d0 * d.cross(&u)
    }
}

/// Rows of a joint as they come: C, C_q by bodies i and j, (C_q q̇)_q q̇.
struct Rows {
    c: Vec<f64>,
    c_q: Vec<[f64; 14]>,
    quadratic: Vec<f64>,
}

impl Rows {
    fn new() -> Self {
        Rows { c: vec![], c_q: vec![], quadratic: vec![] }
    }

    /// r_Pi − r_Pj: \[I, (A_i ū_i)_p, −I, −(A_j ū_j)_p\]
    fn point(&mut self, i: Body, j: Body, u_i: V3, u_j: V3) {
        let c = i.r + i.turned(u_i) - j.r - j.turned(u_j);
        let quadratic = i.second(u_i) - j.second(u_j);
        let by_i = i.slope(u_i);
        let by_j = j.slope(u_j);
        for k in 0..3 {
            let mut row = [0.0; 14];
            (row[k], row[7 + k]) = (1.0, -1.0);
            (0..4).for_each(|n| (row[3 + n], row[10 + n]) = (by_i[(k, n)], -by_j[(k, n)]));
            self.c.push(c[k]);
            self.c_q.push(row);
            self.quadratic.push(quadratic[k]);
        }
    }

    /// h_i · h_j: \[0, h_jᵀ (A_i h̄_i)_p, 0, h_iᵀ (A_j h̄_j)_p\]
    fn dot_1(&mut self, i: Body, j: Body, h_i: V3, h_j: V3) {
        let a = i.turned(h_i);
        let b = j.turned(h_j);
        let by_i = i.slope(h_i).transpose() * b;
        let by_j = j.slope(h_j).transpose() * a;
        let mut row = [0.0; 14];
        (0..4).for_each(|n| (row[3 + n], row[10 + n]) = (by_i[n], by_j[n]));
        self.c.push(a.dot(&b));
        self.c_q.push(row);
        self.quadratic.push(
            i.second(h_i).dot(&b) + 2.0 * i.rate(h_i).dot(&j.rate(h_j)) + a.dot(&j.second(h_j)),
        );
    }

    /// h_i · s, s = r_Pi − r_Pj: \[h_iᵀ, sᵀ (A_i h̄_i)_p + h_iᵀ (A_i ū_i)_p, −h_iᵀ, −h_iᵀ (A_j
    /// ū_j)_p\]
    fn dot_2(&mut self, i: Body, j: Body, h_i: V3, u_i: V3, u_j: V3) {
        let h = i.turned(h_i);
        let s = i.r + i.turned(u_i) - j.r - j.turned(u_j);
        let by_i = i.slope(h_i).transpose() * s + i.slope(u_i).transpose() * h;
        let by_j = j.slope(u_j).transpose() * h;
        let mut row = [0.0; 14];
        (0..3).for_each(|n| (row[n], row[7 + n]) = (h[n], -h[n]));
        (0..4).for_each(|n| (row[3 + n], row[10 + n]) = (by_i[n], -by_j[n]));
        let s_rate = i.v + i.rate(u_i) - j.v - j.rate(u_j);
        self.c.push(h.dot(&s));
        self.c_q.push(row);
        self.quadratic.push(
            i.second(h_i).dot(&s)
                + 2.0 * i.rate(h_i).dot(&s_rate)
                + h.dot(&(i.second(u_i) - j.second(u_j))),
        );
    }

    fn hand(self, qd: &[f64]) -> Hand {
        let m = self.c.len();
        let mut hand = Hand::new(m, 14);
        hand.c = column(&self.c);
        hand.c_q = DMatrix::from_row_slice(m, 14, &self.c_q.concat());
        hand.c_q_qd = &hand.c_q * DVector::from_row_slice(qd);
        hand.c_qqd_qd = column(&self.quadratic);
        hand.q_d = -column(&self.quadratic);
        hand
    }
}

/// Coordinates of two bodies, p of length one; rates of any kind.
fn bodies(random: &mut Random) -> ([f64; 14], [f64; 14]) {
    let (mut q, qd): ([f64; 14], [f64; 14]) = (random.array(2.0), random.array(2.0));
    for first in [3, 10] {
        let norm = q[first..first + 4].iter().map(|e| e * e).sum::<f64>().sqrt();
        q[first..first + 4].iter_mut().for_each(|e| *e /= norm);
    }
    (q, qd)
}

fn vector(random: &mut Random) -> V3 {
    V3::from(random.array::<3>(2.0))
}

fn own(v: V3) -> Vec3 {
    vec3(v.x, v.y, v.z)
}

#[test]
fn spherical_terms_are_the_lectures() {
    let mut random = Random::new(21);
    let mut comparison = Comparison::of("spherical");
    for _ in 0..STATES / 4 {
        let (q, qd) = bodies(&mut random);
        let u_i = vector(&mut random);
        let u_j = vector(&mut random);
        let mut rows = Rows::new();
        rows.point(Body::new(&q[..7], &qd[..7]), Body::new(&q[7..], &qd[7..]), u_i, u_j);
        let joint = spatial::spherical(any_spatial(), any_spatial(), own(u_i), own(u_j));
        comparison.check(&joint, &q, &qd, 0.0, &rows.hand(&qd));
    }
}

#[test]
fn universal_terms_are_the_lectures() {
    let mut random = Random::new(22);
    let mut comparison = Comparison::of("universal");
    for _ in 0..STATES / 4 {
        let (q, qd) = bodies(&mut random);
        let u_i = vector(&mut random);
        let u_j = vector(&mut random);
        let h_i = vector(&mut random);
        let h_j = vector(&mut random);
        let i = Body::new(&q[..7], &qd[..7]);
        let j = Body::new(&q[7..], &qd[7..]);
        let mut rows = Rows::new();
        rows.point(i, j, u_i, u_j);
        rows.dot_1(i, j, h_i, h_j);
        let joint = spatial::universal(
            any_spatial(),
            any_spatial(),
            own(u_i),
            own(u_j),
            own(h_i),
            own(h_j),
        );
        comparison.check(&joint, &q, &qd, 0.0, &rows.hand(&qd));
    }
}

#[test]
fn cylindrical_terms_are_the_lectures() {
    let mut random = Random::new(23);
    let mut comparison = Comparison::of("cylindrical");
    for _ in 0..STATES / 4 {
        let (q, qd) = bodies(&mut random);
        let u_i = vector(&mut random);
        let u_j = vector(&mut random);
        let h_i = vector(&mut random);
        let h_j = vector(&mut random);
        let i = Body::new(&q[..7], &qd[..7]);
        let j = Body::new(&q[7..], &qd[7..]);
        let axis = Axis::along(own(h_i));
        let f = V3::new(axis.f.x, axis.f.y, axis.f.z);
        let g = V3::new(axis.g.x, axis.g.y, axis.g.z);
        // f and g are across the axis: h_i × h_j = 0 and h_i × s = 0 in these two directions
        assert!(
            f.dot(&h_i).abs() < 1e-14
                && g.dot(&h_i).abs() < 1e-14
                && (f.cross(&g) - h_i.normalize()).norm() < 1e-14
        );
        let mut rows = Rows::new();
        rows.dot_1(i, j, f, h_j);
        rows.dot_1(i, j, g, h_j);
        rows.dot_2(i, j, f, u_i, u_j);
        rows.dot_2(i, j, g, u_i, u_j);
        let joint =
            spatial::cylindrical(any_spatial(), any_spatial(), own(u_i), own(u_j), axis, own(h_j));
        comparison.check(&joint, &q, &qd, 0.0, &rows.hand(&qd));
    }
}
