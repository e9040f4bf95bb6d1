//! W6, spatial joints: `linearize` (C and C_q) and `right_side` (Q_d).
//!
//! All comes from one bilinear form: with w = e0 u + e × u and r = e · u, A u = 2 (e0 w + r e) − u. Along the motion, with v and s made of
//! ė in the same way, (A u)′ = 2 (e0 v + s e + ė0 w + r ė) and (A u)″ = 4 (ė0 v + s ė).

pub type V = [f64; 3];
type P = [f64; 4];

/// One joint between spatial bodies i and j; q = (R_i, p_i, R_j, p_j).
pub trait Spatial<const M: usize, const E: usize> {
    fn new(p: &[f64]) -> Self;
    fn linearize(&self, q: &[f64; 14], c: &mut [f64; M], c_q: &mut [f64; E]);
    fn right_side(&self, q: &[f64; 14], qd: &[f64; 14], q_d: &mut [f64; M]);
}

/// The whole batch: C, values of C_q, Q_d for each state.
pub fn batch<J: Spatial<M, E>, const M: usize, const E: usize>(states: &[f64], p: &[f64], output: &mut [f64]) {
    let joint = J::new(p);
    for (state, out) in states.as_chunks::<28>().0.iter().zip(output.chunks_exact_mut(2 * M + E)) {
        let (Some((q, [qd])), Some((c, rest))) = (state.as_chunks().0.split_first(), out.split_first_chunk_mut()) else { return };
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
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// ∂(A u)/∂p by rows, and A u + u, both times `f`, from p and d = 2 f p.
#[inline(always)]
pub fn turn(p: &P, d: &P, u: &V) -> ([P; 3], V) {
    let (p01, p02, p03) = (d[0] * u[0], d[0] * u[1], d[0] * u[2]);
    let (p11, p12, p13) = (d[1] * u[0], d[1] * u[1], d[1] * u[2]);
    let (p21, p22, p23) = (d[2] * u[0], d[2] * u[1], d[2] * u[2]);
    let (p31, p32, p33) = (d[3] * u[0], d[3] * u[1], d[3] * u[2]);
    let r = p11 + p22 + p33;
    let (j12, j13, j21) = (p12 + p03, p13 - p02, p21 - p03);
    let (j23, j31, j32) = (p23 + p01, p31 + p02, p32 - p01);
    // 2 w + 2 e0 u, the column of e0, is what the other columns are not symmetric by.
    let j = [[j23 - j32, r + p11, j12, j13], [j31 - j13, j21, r + p22, j23], [j12 - j21, j31, j32, r + p33]];
    let value = [p[0] * (j23 - p32) + p[1] * r, p[0] * (j31 - p13) + p[2] * r, p[0] * (j12 - p21) + p[3] * r];
    (j, value)
}

/// Jᵀ y
#[inline(always)]
fn apply(j: &[P; 3], y: &V) -> P {
    [
        j[0][0] * y[0] + j[1][0] * y[1] + j[2][0] * y[2],
        j[0][1] * y[0] + j[1][1] * y[1] + j[2][1] * y[2],
        j[0][2] * y[0] + j[1][2] * y[1] + j[2][2] * y[2],
        j[0][3] * y[0] + j[1][3] * y[1] + j[2][3] * y[2],
    ]
}

/// w = e0 u + e × u and r = e · u
#[inline(always)]
fn half(p: &P, u: &V) -> (V, f64) {
    let w = [p[0] * u[0] + p[2] * u[2] - p[3] * u[1], p[0] * u[1] + p[3] * u[0] - p[1] * u[2], p[0] * u[2] + p[1] * u[1] - p[2] * u[0]];
    (w, p[1] * u[0] + p[2] * u[1] + p[3] * u[2])
}

/// e0 w + r e
#[inline(always)]
fn whole(p: &P, (w, r): &(V, f64)) -> V {
    [p[0] * w[0] + r * p[1], p[0] * w[1] + r * p[2], p[0] * w[2] + r * p[3]]
}

/// (A u)″ / 4
#[inline(always)]
fn second(pd: &P, u: &V) -> V {
    whole(pd, &half(pd, u))
}

/// A u, (A u)′ and (A u)″ / 2, from p, ṗ and d = 2 p.
#[inline(always)]
pub fn motion(p: &P, pd: &P, u: &V) -> (V, V, V) {
    let (w, v) = (half(&times(2.0, p), u), half(&times(2.0, pd), u));
    let (x, by_p, by_pd, x2) = (whole(p, &w), whole(p, &v), whole(pd, &w), whole(pd, &v));
    let x1 = [by_p[0] + by_pd[0], by_p[1] + by_pd[1], by_p[2] + by_pd[2]];
    ([x[0] - u[0], x[1] - u[1], x[2] - u[2]], x1, x2)
}

/// What holds two points together: u_i, u_j and u_j − u_i.
struct Points {
    i: V,
    j: V,
    apart: V,
}

impl Points {
    fn new(p: &[f64]) -> Self {
        let (i, j) = (v(p, 0), v(p, 3));
        Points { i, j, apart: [j[0] - i[0], j[1] - i[1], j[2] - i[2]] }
    }

    /// d = R_i + A_i u_i − R_j − A_j u_j and its rows, from p and d = 2 p_i, −2 p_j.
    #[inline(always)]
    fn linearize(&self, q: &[f64; 14], (p, d): (&P, &P), (o, e): (&P, &P)) -> (V, [f64; 30]) {
        let ((a, x), (b, y)) = (turn(p, d, &self.i), turn(o, e, &self.j));
        let r = apart(q);
        let c = [r[0] + x[0] + y[0] + self.apart[0], r[1] + x[1] + y[1] + self.apart[1], r[2] + x[2] + y[2] + self.apart[2]];
        let ([a0, a1, a2], [b0, b1, b2]) = (a, b);
        let c_q = [
            1.0, a0[0], a0[1], a0[2], a0[3], -1.0, b0[0], b0[1], b0[2], b0[3], //
            1.0, a1[0], a1[1], a1[2], a1[3], -1.0, b1[0], b1[1], b1[2], b1[3], //
            1.0, a2[0], a2[1], a2[2], a2[3], -1.0, b2[0], b2[1], b2[2], b2[3],
        ];
        (c, c_q)
    }

    #[inline(always)]
    fn right_side(&self, pd: &P, od: &P) -> V {
        let (a, b) = (second(pd, &self.i), second(od, &self.j));
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
        let (d, e) = (times(2.0, &p), times(-2.0, &o));
        let (points, rows) = self.points.linearize(q, (&p, &d), (&o, &e));
        c_q[..30].copy_from_slice(&rows);
        // With −A_j y in hand, the minus of both factors cancels where p_j's columns are made.
        let ((jx, x), (jy, y)) = (turn(&p, &d, &self.x), turn(&o, &e, &self.y));
        let x = [self.x[0] - x[0], self.x[1] - x[1], self.x[2] - x[2]];
        let y = [-self.y[0] - y[0], -self.y[1] - y[1], -self.y[2] - y[2]];
        *c = [points[0], points[1], points[2], -dot(&x, &y)];
        c_q[30..34].copy_from_slice(&apply(&jx, &y));
        c_q[34..].copy_from_slice(&apply(&jy, &x));
    }

    #[inline(never)]
    fn right_side(&self, q: &[f64; 14], qd: &[f64; 14], q_d: &mut [f64; 4]) {
        let ((p, o), (pd, od)) = (euler(q), euler(qd));
        let d = self.points.right_side(&pd, &od);
        let ((x, x1, x2), (y, y1, y2)) = (motion(&p, &pd, &self.x), motion(&o, &od, &self.y));
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
    let s = d[0] * p[0] - 1.0;
    let (a01, a02, a03) = (d[0] * p[1], d[0] * p[2], d[0] * p[3]);
    let (a12, a13, a23) = (d[1] * p[2], d[1] * p[3], d[2] * p[3]);
    [[s + d[1] * p[1], a12 - a03, a13 + a02], [a12 + a03, s + d[2] * p[2], a23 - a01], [a13 - a02, a23 + a01, s + d[3] * p[3]]]
}

/// A with its first and half its second derivative along the motion.
#[inline(always)]
fn rotations(p: &P, pd: &P) -> [[V; 3]; 3] {
    let (d, dd) = (times(2.0, p), times(2.0, pd));
    let s = d[0] * dd[0];
    let (b01, b02, b03) = (d[0] * pd[1] + d[1] * pd[0], d[0] * pd[2] + d[2] * pd[0], d[0] * pd[3] + d[3] * pd[0]);
    let (b12, b13, b23) = (d[1] * pd[2] + d[2] * pd[1], d[1] * pd[3] + d[3] * pd[1], d[2] * pd[3] + d[3] * pd[2]);
    let b = [[s + d[1] * dd[1], b12 - b03, b13 + b02], [b12 + b03, s + d[2] * dd[2], b23 - b01], [b13 - b02, b23 + b01, s + d[3] * dd[3]]];
    let s = dd[0] * pd[0];
    let (c01, c02, c03) = (dd[0] * pd[1], dd[0] * pd[2], dd[0] * pd[3]);
    let (c12, c13, c23) = (dd[1] * pd[2], dd[1] * pd[3], dd[2] * pd[3]);
    let c =
        [[s + dd[1] * pd[1], c12 - c03, c13 + c02], [c12 + c03, s + dd[2] * pd[2], c23 - c01], [c13 - c02, c23 + c01, s + dd[3] * pd[3]]];
    [rotation(p), b, c]
}

/// A u
#[inline(always)]
fn product(a: &[V; 3], u: &V) -> V {
    [dot(&a[0], u), dot(&a[1], u), dot(&a[2], u)]
}

/// Half of (Aᵀ w)″, of which a dot product with a vector fixed in the body is half of its second derivative with w.
#[inline(always)]
fn second_in_body([a, a1, a2]: &[[V; 3]; 3], (w, w1, w2): (&V, &V, &V)) -> V {
    let column = |k: usize| {
        let (by_w, by_w1) = (a2[0][k] * w[0] + a2[1][k] * w[1] + a2[2][k] * w[2], a1[0][k] * w1[0] + a1[1][k] * w1[1] + a1[2][k] * w1[2]);
        by_w + by_w1 + a[0][k] * w2[0] + a[1][k] * w2[1] + a[2][k] * w2[2]
    };
    [column(0), column(1), column(2)]
}

impl Spatial<4, 44> for Cylindrical {
    fn new(p: &[f64]) -> Self {
        Cylindrical { points: Points::new(p), x1: v(p, 6), x2: v(p, 9), w: v(p, 12) }
    }

    #[inline(never)]
    fn linearize(&self, q: &[f64; 14], c: &mut [f64; 4], c_q: &mut [f64; 44]) {
        let (p, o) = euler(q);
        let (d, e) = (times(2.0, &p), times(-2.0, &o));
        let ((ja, a), (jb, b)) = (turn(&p, &d, &self.points.i), turn(&o, &e, &self.points.j));
        let (r, fixed) = (apart(q), &self.points.apart);
        let between = [r[0] + a[0] + b[0] + fixed[0], r[1] + a[1] + b[1] + fixed[1], r[2] + a[2] + b[2] + fixed[2]];
        let (jw, w) = turn(&o, &e, &self.w);
        let w = [-self.w[0] - w[0], -self.w[1] - w[1], -self.w[2] - w[2]];
        for (k, u) in [&self.x1, &self.x2].into_iter().enumerate() {
            let (jx, x) = turn(&p, &d, u);
            let (x, minus) = ([x[0] - u[0], x[1] - u[1], x[2] - u[2]], [u[0] - x[0], u[1] - x[1], u[2] - x[2]]);
            c[k] = dot(&x, &w);
            c[2 + k] = dot(&x, &between);
            c_q[8 * k..8 * k + 4].copy_from_slice(&apply(&jx, &w));
            c_q[8 * k + 4..8 * k + 8].copy_from_slice(&apply(&jw, &minus));
            let (by_x, by_a, by_b) = (apply(&jx, &between), apply(&ja, &x), apply(&jb, &x));
            let row = [
                x[0],
                x[1],
                x[2],
                by_x[0] + by_a[0],
                by_x[1] + by_a[1],
                by_x[2] + by_a[2],
                by_x[3] + by_a[3], //
                minus[0],
                minus[1],
                minus[2],
                by_b[0],
                by_b[1],
                by_b[2],
                by_b[3],
            ];
            c_q[16 + 14 * k..30 + 14 * k].copy_from_slice(&row);
        }
    }

    #[inline(never)]
    fn right_side(&self, q: &[f64; 14], qd: &[f64; 14], q_d: &mut [f64; 4]) {
        let ((p, o), (pd, od)) = (euler(q), euler(qd));
        let turns = rotations(&p, &pd);
        let u = &self.points.i;
        let (a, a1, a2) = (product(&turns[0], u), product(&turns[1], u), product(&turns[2], u));
        let ((b, b1, b2), (w, w1, w2)) = (motion(&o, &od, &self.points.j), motion(&o, &od, &self.w));
        let (r, rd) = (apart(q), apart(qd));
        let d = [r[0] + a[0] - b[0], r[1] + a[1] - b[1], r[2] + a[2] - b[2]];
        let d1 = [rd[0] + a1[0] - b1[0], rd[1] + a1[1] - b1[1], rd[2] + a1[2] - b1[2]];
        let d2 = [a2[0] - b2[0], a2[1] - b2[1], a2[2] - b2[2]];
        // Seen from body i both rows are dot products with the same moving vector.
        let (w, d) = (second_in_body(&turns, (&w, &w1, &w2)), second_in_body(&turns, (&d, &d1, &d2)));
        *q_d = [-2.0 * dot(&self.x1, &w), -2.0 * dot(&self.x2, &w), -2.0 * dot(&self.x1, &d), -2.0 * dot(&self.x2, &d)];
    }
}
