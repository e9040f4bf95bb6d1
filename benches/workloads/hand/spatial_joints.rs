//! W6, spatial joints: `linearize` (C and C_q) and `right_side` (Q_d).
//!
//! All comes from one bilinear form: with w = e0 u + e × u and r = e · u, A u = 2 (e0 w + r e) − u.
//! Along the motion, with v and s made of ė in the same way, (A u)′ = 2 (e0 v + s e + ė0 w + r ė)
//! and (A u)″ = 4 (ė0 v
//! + s ė).

use std::sync::atomic::{Ordering, compiler_fence};

pub type V = [f64; 3];
type P = [f64; 4];

/// One joint between spatial bodies i and j; q = (R_i, p_i, R_j, p_j).
pub trait Spatial<const M: usize, const E: usize> {
    fn new(p: &[f64]) -> Self;
    fn linearize(&self, q: &[f64; 14], c: &mut [f64; M], c_q: &mut [f64; E]);
    fn right_side(&self, q: &[f64; 14], qd: &[f64; 14], q_d: &mut [f64; M]);
}

/// The whole batch: C, values of C_q, Q_d for each state.
pub fn batch<J: Spatial<M, E>, const M: usize, const E: usize>(
    states: &[f64],
    p: &[f64],
    output: &mut [f64],
) {
    let joint = J::new(p);
    for (state, out) in states.as_chunks::<28>().0.iter().zip(output.chunks_exact_mut(2 * M + E)) {
        let (Some((q, [qd])), Some((c, rest))) =
            (state.as_chunks().0.split_first(), out.split_first_chunk_mut())
        else {
            return;
        };
        let Some((c_q, q_d)) = rest.split_first_chunk_mut() else { return };
        let Some(q_d) = q_d.first_chunk_mut() else { return };
        joint.linearize(q, c, c_q);
        joint.right_side(q, qd, q_d);
    }
}

/// R_i − R_j
#[inline(always)]
fn apart(q: &[f64; 14]) -> V {
    [q[0] - q[7], q[1] - q[8], q[2] - q[9]]
}

#[inline(always)]
fn euler(q: &[f64; 14]) -> (P, P) {
    ([q[3], q[4], q[5], q[6]], [q[10], q[11], q[12], q[13]])
}

#[inline(always)]
fn times(factor: f64, p: &P) -> P {
    p.map(|e| factor * e)
}

#[inline(always)]
pub fn dot(a: &V, b: &V) -> f64 {
    fma(a[2], b[2], fma(a[1], b[1], a[0] * b[0]))
}

/// a b + c in one instruction where there is one; without, a call that takes a hundred would do it.
#[inline(always)]
fn fma(a: f64, b: f64, c: f64) -> f64 {
    if cfg!(target_feature = "fma") { a.mul_add(b, c) } else { a * b + c }
}

/// ∂(A u)/∂p by rows, and A u + u, both times `f`, from p and d = 2 f p.
#[inline(always)]
pub fn turn(p: &P, d: &P, u: &V) -> ([P; 3], V) {
    let p01 = d[0] * u[0];
    let p02 = d[0] * u[1];
    let p03 = d[0] * u[2];
    let r = fma(d[3], u[2], fma(d[2], u[1], d[1] * u[0]));
    let j12 = fma(d[1], u[1], p03);
    let j13 = fma(d[1], u[2], -p02);
    let j21 = fma(d[2], u[0], -p03);
    let j23 = fma(d[2], u[2], p01);
    let j31 = fma(d[3], u[0], p02);
    let j32 = fma(d[3], u[1], -p01);
    // 2 w + 2 e0 u, the column of e0, is what the other columns are not symmetric by.
    let j = [
        [j23 - j32, fma(d[1], u[0], r), j12, j13],
        [j31 - j13, j21, fma(d[2], u[1], r), j23],
        [j12 - j21, j31, j32, fma(d[3], u[2], r)],
    ];
    let w = [fma(-d[3], u[1], j23), fma(-d[1], u[2], j31), fma(-d[2], u[0], j12)];
    (j, [fma(p[0], w[0], p[1] * r), fma(p[0], w[1], p[2] * r), fma(p[0], w[2], p[3] * r)])
}

/// Jᵀ y
#[inline(always)]
fn apply(j: &[P; 3], y: &V) -> P {
    let at = |k: usize| fma(j[2][k], y[2], fma(j[1][k], y[1], j[0][k] * y[0]));
    [at(0), at(1), at(2), at(3)]
}

/// Keeps the compiler from gathering all writes at the end of a function, which costs a spill and a
/// reload each.
#[inline(always)]
fn in_order() {
    compiler_fence(Ordering::SeqCst);
}

/// x + Jᵀ y
#[inline(always)]
fn plus_apply(x: &P, j: &[P; 3], y: &V) -> P {
    let at = |k: usize| fma(j[2][k], y[2], fma(j[1][k], y[1], fma(j[0][k], y[0], x[k])));
    [at(0), at(1), at(2), at(3)]
}

/// A u, from p and d = 2 p.
#[inline(always)]
fn turned(p: &P, d: &P, u: &V) -> V {
    plus_whole(&[-u[0], -u[1], -u[2]], p, &half(d, u))
}

/// w = e0 u + e × u and r = e · u
#[inline(always)]
fn half(p: &P, u: &V) -> (V, f64) {
    let w = [
        fma(-p[3], u[1], fma(p[2], u[2], p[0] * u[0])),
        fma(-p[1], u[2], fma(p[3], u[0], p[0] * u[1])),
        fma(-p[2], u[0], fma(p[1], u[1], p[0] * u[2])),
    ];
    (w, fma(p[3], u[2], fma(p[2], u[1], p[1] * u[0])))
}

/// The same for Aᵀ, of two pairs, added.
#[inline(always)]
fn half_back((p, u): (&P, &V), (o, v): (&P, &V)) -> (V, f64) {
    let first =
        |k: usize, a: usize, b: usize| fma(p[b + 1], u[a], fma(-p[a + 1], u[b], p[0] * u[k]));
    let both = |k: usize, a: usize, b: usize| {
        fma(o[b + 1], v[a], fma(-o[a + 1], v[b], fma(o[0], v[k], first(k, a, b))))
    };
    let r = fma(p[3], u[2], fma(p[2], u[1], p[1] * u[0]));
    (
        [both(0, 1, 2), both(1, 2, 0), both(2, 0, 1)],
        fma(o[3], v[2], fma(o[2], v[1], fma(o[1], v[0], r))),
    )
}

/// e0 w + r e
#[inline(always)]
fn whole(p: &P, w: &(V, f64)) -> V {
    let (w, r) = w;
    [fma(p[0], w[0], r * p[1]), fma(p[0], w[1], r * p[2]), fma(p[0], w[2], r * p[3])]
}

/// x + e0 w + r e
#[inline(always)]
fn plus_whole(x: &V, p: &P, (w, r): &(V, f64)) -> V {
    [
        fma(p[0], w[0], fma(*r, p[1], x[0])),
        fma(p[0], w[1], fma(*r, p[2], x[1])),
        fma(p[0], w[2], fma(*r, p[3], x[2])),
    ]
}

/// (A u)″ / 4
#[inline(always)]
fn second(pd: &P, u: &V) -> V {
    whole(pd, &half(pd, u))
}

/// A u, (A u)′ and (A u)″ / 2, from p, ṗ and d = 2 p.
#[inline(always)]
pub fn motion(p: &P, pd: &P, u: &V) -> (V, V, V) {
    let w = half(&times(2.0, p), u);
    let v = half(&times(2.0, pd), u);
    let x = plus_whole(&[-u[0], -u[1], -u[2]], p, &w);
    (x, plus_whole(&whole(p, &v), pd, &w), whole(pd, &v))
}

/// The vectors of a joint that holds two points together: u_i, u_j and u_j − u_i.
struct Points {
    i: V,
    j: V,
    apart: V,
}

impl Points {
    fn new(p: &[f64]) -> Self {
        let i = v(p, 0);
        let j = v(p, 3);
        Points { i, j, apart: [j[0] - i[0], j[1] - i[1], j[2] - i[2]] }
    }

    /// d = R_i + A_i u_i − R_j − A_j u_j and its rows, from p and d = 2 p_i, −2 p_j.
    #[inline(always)]
    fn linearize(&self, q: &[f64; 14], (p, d): (&P, &P), (o, e): (&P, &P)) -> (V, [f64; 30]) {
        let (a, x) = turn(p, d, &self.i);
        let (b, y) = turn(o, e, &self.j);
        let r = apart(q);
        let c = [
            r[0] + x[0] + y[0] + self.apart[0],
            r[1] + x[1] + y[1] + self.apart[1],
            r[2] + x[2] + y[2] + self.apart[2],
        ];
        let [a0, a1, a2] = a;
        let [b0, b1, b2] = b;
        let c_q = [
            1.0, a0[0], a0[1], a0[2], a0[3], -1.0, b0[0], b0[1], b0[2], b0[3], //
            1.0, a1[0], a1[1], a1[2], a1[3], -1.0, b1[0], b1[1], b1[2], b1[3], //
            1.0, a2[0], a2[1], a2[2], a2[3], -1.0, b2[0], b2[1], b2[2], b2[3],
        ];
        (c, c_q)
    }

    #[inline(always)]
    fn right_side(&self, pd: &P, od: &P) -> V {
        let a = second(pd, &self.i);
        let b = second(od, &self.j);
        [4.0 * (b[0] - a[0]), 4.0 * (b[1] - a[1]), 4.0 * (b[2] - a[2])]
    }
}

fn v(p: &[f64], k: usize) -> V {
    [p[k], p[k + 1], p[k + 2]]
}

pub struct Spherical(Points);

impl Spatial<3, 30> for Spherical {
    fn new(p: &[f64]) -> Self {
        Spherical(Points::new(p))
    }

    #[inline(never)]
    fn linearize(&self, q: &[f64; 14], c: &mut [f64; 3], c_q: &mut [f64; 30]) {
        let (p, o) = euler(q);
        (*c, *c_q) = self.0.linearize(q, (&p, &times(2.0, &p)), (&o, &times(-2.0, &o)));
    }

    #[inline(never)]
    fn right_side(&self, _: &[f64; 14], qd: &[f64; 14], q_d: &mut [f64; 3]) {
        let (pd, od) = euler(qd);
        *q_d = self.0.right_side(&pd, &od);
    }
}

pub struct Universal {
    points: Points,
    x: V,
    y: V,
}

impl Spatial<4, 38> for Universal {
    fn new(p: &[f64]) -> Self {
        Universal { points: Points::new(p), x: v(p, 6), y: v(p, 9) }
    }

    #[inline(never)]
    fn linearize(&self, q: &[f64; 14], c: &mut [f64; 4], c_q: &mut [f64; 38]) {
        let (p, o) = euler(q);
        let d = times(2.0, &p);
        let e = times(-2.0, &o);
        let (points, rows) = self.points.linearize(q, (&p, &d), (&o, &e));
        c_q[..30].copy_from_slice(&rows);
        // With −A_j y in hand, the minus of both factors cancels where p_j's columns are made.
        let (jx, x) = turn(&p, &d, &self.x);
        let (jy, y) = turn(&o, &e, &self.y);
        let x = [self.x[0] - x[0], self.x[1] - x[1], self.x[2] - x[2]];
        let y = [-self.y[0] - y[0], -self.y[1] - y[1], -self.y[2] - y[2]];
        *c = [points[0], points[1], points[2], -dot(&x, &y)];
        c_q[30..34].copy_from_slice(&apply(&jx, &y));
        c_q[34..].copy_from_slice(&apply(&jy, &x));
    }

    #[inline(never)]
    fn right_side(&self, q: &[f64; 14], qd: &[f64; 14], q_d: &mut [f64; 4]) {
        let (p, o) = euler(q);
        let (pd, od) = euler(qd);
        let d = self.points.right_side(&pd, &od);
        let (x, x1, x2) = motion(&p, &pd, &self.x);
        let (y, y1, y2) = motion(&o, &od, &self.y);
        *q_d = [d[0], d[1], d[2], -2.0 * (dot(&x2, &y) + dot(&x1, &y1) + dot(&x, &y2))];
    }
}

pub struct Cylindrical {
    points: Points,
    x1: V,
    x2: V,
    w: V,
}

/// A
#[inline(always)]
pub fn rotation(p: &P) -> [V; 3] {
    let d = times(2.0, p);
    let s = fma(d[0], p[0], -1.0);
    let a01 = d[0] * p[1];
    let a02 = d[0] * p[2];
    let a03 = d[0] * p[3];
    [
        [fma(d[1], p[1], s), fma(d[1], p[2], -a03), fma(d[1], p[3], a02)],
        [fma(d[1], p[2], a03), fma(d[2], p[2], s), fma(d[2], p[3], -a01)],
        [fma(d[1], p[3], -a02), fma(d[2], p[3], a01), fma(d[3], p[3], s)],
    ]
}

/// Half of (Aᵀ w)″, of which a dot product with a vector fixed in the body is half of its second
/// derivative with w.
#[inline(always)]
fn second_in_body((p, d): (&P, &P), (pd, dd): (&P, &P), (w, w1, w2): (&V, &V, &V)) -> V {
    let x = plus_whole(&[-w2[0], -w2[1], -w2[2]], p, &half_back((dd, w1), (d, w2)));
    plus_whole(&x, pd, &half_back((dd, w), (d, w1)))
}

impl Spatial<4, 44> for Cylindrical {
    fn new(p: &[f64]) -> Self {
        Cylindrical { points: Points::new(p), x1: v(p, 6), x2: v(p, 9), w: v(p, 12) }
    }

    #[inline(never)]
    fn linearize(&self, q: &[f64; 14], c: &mut [f64; 4], c_q: &mut [f64; 44]) {
        let (p, o) = euler(q);
        let d = times(2.0, &p);
        let e = times(-2.0, &o);
        // Each row is written as soon as it is known and each matrix used up before the next one is
        // made: registers are few.
        let x1 = turned(&p, &d, &self.x1);
        let x2 = turned(&p, &d, &self.x2);
        c_q[16..19].copy_from_slice(&x1);
        c_q[30..33].copy_from_slice(&x2);
        let n1 = x1.map(|x| -x);
        let n2 = x2.map(|x| -x);
        c_q[23..26].copy_from_slice(&n1);
        c_q[37..40].copy_from_slice(&n2);
        in_order();
        let (j, w) = turn(&o, &e, &self.w);
        let w = [-self.w[0] - w[0], -self.w[1] - w[1], -self.w[2] - w[2]];
        (c[0], c[1]) = (dot(&x1, &w), dot(&x2, &w));
        c_q[4..8].copy_from_slice(&apply(&j, &n1));
        c_q[12..16].copy_from_slice(&apply(&j, &n2));
        in_order();
        let (j, b) = turn(&o, &e, &self.points.j);
        c_q[26..30].copy_from_slice(&apply(&j, &x1));
        c_q[40..44].copy_from_slice(&apply(&j, &x2));
        in_order();
        let (j, a) = turn(&p, &d, &self.points.i);
        let by_a1 = apply(&j, &x1);
        let by_a2 = apply(&j, &x2);
        let r = apart(q);
        let fixed = &self.points.apart;
        let between = [
            r[0] + fixed[0] + a[0] + b[0],
            r[1] + fixed[1] + a[1] + b[1],
            r[2] + fixed[2] + a[2] + b[2],
        ];
        (c[2], c[3]) = (dot(&x1, &between), dot(&x2, &between));
        in_order();
        let (j, _) = turn(&p, &d, &self.x1);
        c_q[..4].copy_from_slice(&apply(&j, &w));
        c_q[19..23].copy_from_slice(&plus_apply(&by_a1, &j, &between));
        in_order();
        let (j, _) = turn(&p, &d, &self.x2);
        c_q[8..12].copy_from_slice(&apply(&j, &w));
        c_q[33..37].copy_from_slice(&plus_apply(&by_a2, &j, &between));
    }

    #[inline(never)]
    fn right_side(&self, q: &[f64; 14], qd: &[f64; 14], q_d: &mut [f64; 4]) {
        let (p, o) = euler(q);
        let (pd, od) = euler(qd);
        let two = times(2.0, &p);
        let two_d = times(2.0, &pd);
        let (a, a1, a2) = motion(&p, &pd, &self.points.i);
        let (b, b1, b2) = motion(&o, &od, &self.points.j);
        let (w, w1, w2) = motion(&o, &od, &self.w);
        let r = apart(q);
        let rd = apart(qd);
        let d = [r[0] + a[0] - b[0], r[1] + a[1] - b[1], r[2] + a[2] - b[2]];
        let d1 = [rd[0] + a1[0] - b1[0], rd[1] + a1[1] - b1[1], rd[2] + a1[2] - b1[2]];
        let d2 = [a2[0] - b2[0], a2[1] - b2[1], a2[2] - b2[2]];
        // Seen from body i two rows at a time are dot products with the same moving vector.
        let in_body =
            |w: &V, w1: &V, w2: &V| second_in_body((&p, &two), (&pd, &two_d), (w, w1, w2));
        let w = in_body(&w, &w1, &w2);
        let d = in_body(&d, &d1, &d2);
        *q_d = [
            -2.0 * dot(&self.x1, &w),
            -2.0 * dot(&self.x2, &w),
            -2.0 * dot(&self.x1, &d),
            -2.0 * dot(&self.x2, &d),
        ];
    }
}
