//! W6 written by hand, as an engineer with time to spare would: states first, then `linearize` (C and C_q) and `right_side` (Q_d), for each
//! joint. Named scalars, everything shared that can be.

/// One planar joint: M rows, E entries of C_q.
pub trait Planar<const M: usize, const E: usize> {
    fn new(p: &[f64]) -> Self;
    fn linearize(&self, i: &Body2, j: &Body2, c: &mut [f64; M], c_q: &mut [f64; E]);
    fn right_side(&self, i: &Body2, j: &Body2, q_d: &mut [f64; M]);
}

/// A planar body's coordinates, sine, cosine and rates.
pub struct Body2 {
    x: f64,
    y: f64,
    theta: f64,
    s: f64,
    c: f64,
    xd: f64,
    yd: f64,
    w: f64,
}

impl Body2 {
    #[inline(always)]
    fn new(q: &[f64], qd: &[f64]) -> Self {
        let (s, c) = q[2].sin_cos();
        Body2 { x: q[0], y: q[1], theta: q[2], s, c, xd: qd[0], yd: qd[1], w: qd[2] }
    }
}

/// The whole batch: C, values of C_q, Q_d for each state.
pub fn planar<J: Planar<M, E>, const M: usize, const E: usize>((states, p): (&[f64], &[f64]), output: &mut [f64]) {
    let joint = J::new(p);
    for (state, out) in states.as_chunks::<12>().0.iter().zip(output.chunks_exact_mut(2 * M + E)) {
        let (i, j) = (Body2::new(&state[..3], &state[6..9]), Body2::new(&state[3..6], &state[9..]));
        let (c, rest) = out.split_at_mut(M);
        let (c_q, q_d) = rest.split_at_mut(E);
        let (Ok(c), Ok(c_q), Ok(q_d)) = (c.try_into(), c_q.try_into(), q_d.try_into()) else { return };
        joint.linearize(&i, &j, c, c_q);
        joint.right_side(&i, &j, q_d);
    }
}

pub struct Revolute {
    ix: f64,
    iy: f64,
    jx: f64,
    jy: f64,
}

impl Planar<2, 8> for Revolute {
    fn new(p: &[f64]) -> Self {
        Revolute { ix: p[0], iy: p[1], jx: p[2], jy: p[3] }
    }

    #[inline(never)]
    fn linearize(&self, i: &Body2, j: &Body2, c: &mut [f64; 2], c_q: &mut [f64; 8]) {
        let (ax, ay) = (i.c * self.ix - i.s * self.iy, i.s * self.ix + i.c * self.iy);
        let (bx, by) = (j.c * self.jx - j.s * self.jy, j.s * self.jx + j.c * self.jy);
        *c = [i.x + ax - j.x - bx, i.y + ay - j.y - by];
        *c_q = [1.0, -ay, -1.0, by, 1.0, ax, -1.0, -bx];
    }

    #[inline(never)]
    fn right_side(&self, i: &Body2, j: &Body2, q_d: &mut [f64; 2]) {
        let (ax, ay) = (i.c * self.ix - i.s * self.iy, i.s * self.ix + i.c * self.iy);
        let (bx, by) = (j.c * self.jx - j.s * self.jy, j.s * self.jx + j.c * self.jy);
        let (wi, wj) = (i.w * i.w, j.w * j.w);
        *q_d = [wi * ax - wj * bx, wi * ay - wj * by];
    }
}

pub struct Prismatic {
    ix: f64,
    iy: f64,
    jx: f64,
    jy: f64,
    hx: f64,
    hy: f64,
    theta0: f64,
}

impl Planar<2, 8> for Prismatic {
    fn new(p: &[f64]) -> Self {
        Prismatic { ix: p[0], iy: p[1], jx: p[2], jy: p[3], hx: p[4], hy: p[5], theta0: p[6] }
    }

    #[inline(never)]
    fn linearize(&self, i: &Body2, j: &Body2, c: &mut [f64; 2], c_q: &mut [f64; 8]) {
        let (hx, hy) = (i.c * self.hx - i.s * self.hy, i.s * self.hx + i.c * self.hy);
        let (ax, ay) = (i.c * self.ix - i.s * self.iy, i.s * self.ix + i.c * self.iy);
        let (bx, by) = (j.c * self.jx - j.s * self.jy, j.s * self.jx + j.c * self.jy);
        let (rx, ry) = (i.x - j.x - bx, i.y - j.y - by);
        let (dx, dy) = (rx + ax, ry + ay);
        *c = [i.theta - j.theta - self.theta0, hx * dx + hy * dy];
        // h' · d + h · a' with h' = (−hy, hx), a' = (−ay, ax): the parts in a cancel.
        *c_q = [1.0, -1.0, hx, hy, hx * ry - hy * rx, -hx, -hy, hx * by - hy * bx];
    }

    #[inline(never)]
    fn right_side(&self, i: &Body2, j: &Body2, q_d: &mut [f64; 2]) {
        let (hx, hy) = (i.c * self.hx - i.s * self.hy, i.s * self.hx + i.c * self.hy);
        let (bx, by) = (j.c * self.jx - j.s * self.jy, j.s * self.jx + j.c * self.jy);
        // h · a is constant, so only s = R_i − R_j − b moves against h.
        let (sx, sy) = (i.x - j.x - bx, i.y - j.y - by);
        let (vx, vy) = (i.xd - j.xd + j.w * by, i.yd - j.yd - j.w * bx);
        let (wi, wj) = (i.w * i.w, j.w * j.w);
        *q_d = [0.0, wi * (hx * sx + hy * sy) - 2.0 * i.w * (hx * vy - hy * vx) - wj * (hx * bx + hy * by)];
    }
}

/// One spatial joint.
pub trait Spatial<const M: usize, const E: usize> {
    fn new(p: &[f64]) -> Self;
    fn linearize(&self, i: &Body3, j: &Body3, c: &mut [f64; M], c_q: &mut [f64; E]);
    fn right_side(&self, i: &Body3, j: &Body3, q_d: &mut [f64; M]);
}

type V = [f64; 3];

/// A spatial body's coordinates, rotation matrix and rates.
pub struct Body3 {
    r: V,
    e: [f64; 4],
    a: [V; 3],
    rd: V,
    ed: [f64; 4],
}

impl Body3 {
    #[inline(always)]
    fn new(q: &[f64], qd: &[f64]) -> Self {
        let e = [q[3], q[4], q[5], q[6]];
        let d: [f64; 4] = std::array::from_fn(|k| 2.0 * e[k]);
        let s = d[0] * e[0] - 1.0;
        let (p01, p02, p03) = (d[0] * e[1], d[0] * e[2], d[0] * e[3]);
        let (p12, p13, p23) = (d[1] * e[2], d[1] * e[3], d[2] * e[3]);
        let a = [
            [s + d[1] * e[1], p12 - p03, p13 + p02],
            [p12 + p03, s + d[2] * e[2], p23 - p01],
            [p13 - p02, p23 + p01, s + d[3] * e[3]],
        ];
        Body3 { r: [q[0], q[1], q[2]], e, a, rd: [qd[0], qd[1], qd[2]], ed: [qd[3], qd[4], qd[5], qd[6]] }
    }

    /// A u
    #[inline(always)]
    fn turn(&self, u: &V) -> V {
        std::array::from_fn(|k| dot(&self.a[k], u))
    }

    /// ∂(A u)/∂e, by rows.
    #[inline(always)]
    fn turn_by_e(&self, u: &V) -> [[f64; 4]; 3] {
        let d: [f64; 4] = std::array::from_fn(|k| 2.0 * self.e[k]);
        let p: [V; 4] = std::array::from_fn(|k| std::array::from_fn(|l| d[k] * u[l]));
        [
            [p[0][0] + p[0][0] + p[2][2] - p[3][1], p[1][0] + p[1][0] + p[2][1] + p[3][2], p[1][1] + p[0][2], p[1][2] - p[0][1]],
            [p[0][1] + p[0][1] + p[3][0] - p[1][2], p[2][0] - p[0][2], p[1][0] + p[2][1] + p[2][1] + p[3][2], p[2][2] + p[0][0]],
            [p[0][2] + p[0][2] + p[1][1] - p[2][0], p[3][0] + p[0][1], p[3][1] - p[0][0], p[1][0] + p[2][1] + p[3][2] + p[3][2]],
        ]
    }

    /// A′ u along ė
    #[inline(always)]
    fn turn_rate(&self, u: &V) -> V {
        let (e, d) = (&self.e, &self.ed);
        let (s, t) = (2.0 * (e[1] * u[0] + e[2] * u[1] + e[3] * u[2]), 2.0 * (d[1] * u[0] + d[2] * u[1] + d[3] * u[2]));
        let (v, w) = (cross(&[e[1], e[2], e[3]], u), cross(&[d[1], d[2], d[3]], u));
        let (f, g, h) = (4.0 * e[0] * d[0], 2.0 * d[0], 2.0 * e[0]);
        std::array::from_fn(|k| f * u[k] + d[k + 1] * s + e[k + 1] * t + g * v[k] + h * w[k])
    }

    /// A″ u / 4 along ė
    #[inline(always)]
    fn turn_second(&self, u: &V) -> V {
        let d = &self.ed;
        let t = d[1] * u[0] + d[2] * u[1] + d[3] * u[2];
        let w = cross(&[d[1], d[2], d[3]], u);
        let f = d[0] * d[0];
        std::array::from_fn(|k| f * u[k] + d[k + 1] * t + d[0] * w[k])
    }
}

#[inline(always)]
fn dot(a: &V, b: &V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: &V, b: &V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn v(p: &[f64], k: usize) -> V {
    [p[k], p[k + 1], p[k + 2]]
}

/// The whole batch: C, values of C_q, Q_d for each state.
pub fn spatial<J: Spatial<M, E>, const M: usize, const E: usize>((states, p): (&[f64], &[f64]), output: &mut [f64]) {
    let joint = J::new(p);
    for (state, out) in states.as_chunks::<28>().0.iter().zip(output.chunks_exact_mut(2 * M + E)) {
        let (i, j) = (Body3::new(&state[..7], &state[14..21]), Body3::new(&state[7..14], &state[21..]));
        let (c, rest) = out.split_at_mut(M);
        let (c_q, q_d) = rest.split_at_mut(E);
        let (Ok(c), Ok(c_q), Ok(q_d)) = (c.try_into(), c_q.try_into(), q_d.try_into()) else { return };
        joint.linearize(&i, &j, c, c_q);
        joint.right_side(&i, &j, q_d);
    }
}

pub struct Spherical {
    u_i: V,
    u_j: V,
}

/// Rows of d = R_i + A_i u_i − R_j − A_j u_j: C and C_q.
#[inline(always)]
fn point_rows(u_i: &V, u_j: &V, i: &Body3, j: &Body3, c: &mut [f64], c_q: &mut [f64]) {
    let (a, b) = (i.turn(u_i), j.turn(u_j));
    let (da, db) = (i.turn_by_e(u_i), j.turn_by_e(u_j));
    for k in 0..3 {
        c[k] = i.r[k] + a[k] - j.r[k] - b[k];
        let row = &mut c_q[10 * k..10 * k + 10];
        row[0] = 1.0;
        row[1..5].copy_from_slice(&da[k]);
        row[5] = -1.0;
        (0..4).for_each(|l| row[6 + l] = -db[k][l]);
    }
}

impl Spatial<3, 30> for Spherical {
    fn new(p: &[f64]) -> Self {
        Spherical { u_i: v(p, 0), u_j: v(p, 3) }
    }

    #[inline(never)]
    fn linearize(&self, i: &Body3, j: &Body3, c: &mut [f64; 3], c_q: &mut [f64; 30]) {
        point_rows(&self.u_i, &self.u_j, i, j, c, c_q);
    }

    #[inline(never)]
    fn right_side(&self, i: &Body3, j: &Body3, q_d: &mut [f64; 3]) {
        let (a, b) = (i.turn_second(&self.u_i), j.turn_second(&self.u_j));
        *q_d = std::array::from_fn(|k| 4.0 * (b[k] - a[k]));
    }
}

pub struct Universal {
    u_i: V,
    u_j: V,
    x: V,
    y: V,
}

/// Jᵀ w for J = ∂(A u)/∂e.
#[inline(always)]
fn apply(j: &[[f64; 4]; 3], w: &V) -> [f64; 4] {
    std::array::from_fn(|k| j[0][k] * w[0] + j[1][k] * w[1] + j[2][k] * w[2])
}

impl Spatial<4, 38> for Universal {
    fn new(p: &[f64]) -> Self {
        Universal { u_i: v(p, 0), u_j: v(p, 3), x: v(p, 6), y: v(p, 9) }
    }

    #[inline(never)]
    fn linearize(&self, i: &Body3, j: &Body3, c: &mut [f64; 4], c_q: &mut [f64; 38]) {
        point_rows(&self.u_i, &self.u_j, i, j, &mut c[..3], &mut c_q[..30]);
        let (x, y) = (i.turn(&self.x), j.turn(&self.y));
        c[3] = dot(&x, &y);
        c_q[30..34].copy_from_slice(&apply(&i.turn_by_e(&self.x), &y));
        c_q[34..].copy_from_slice(&apply(&j.turn_by_e(&self.y), &x));
    }

    #[inline(never)]
    fn right_side(&self, i: &Body3, j: &Body3, q_d: &mut [f64; 4]) {
        let (a, b) = (i.turn_second(&self.u_i), j.turn_second(&self.u_j));
        let (x, y) = (i.turn(&self.x), j.turn(&self.y));
        let (x1, y1) = (i.turn_rate(&self.x), j.turn_rate(&self.y));
        let (x2, y2) = (i.turn_second(&self.x), j.turn_second(&self.y));
        let last = -4.0 * (dot(&x2, &y) + dot(&x, &y2)) - 2.0 * dot(&x1, &y1);
        *q_d = [4.0 * (b[0] - a[0]), 4.0 * (b[1] - a[1]), 4.0 * (b[2] - a[2]), last];
    }
}

pub struct Cylindrical {
    u_i: V,
    u_j: V,
    x1: V,
    x2: V,
    w: V,
}

impl Spatial<4, 44> for Cylindrical {
    fn new(p: &[f64]) -> Self {
        Cylindrical { u_i: v(p, 0), u_j: v(p, 3), x1: v(p, 6), x2: v(p, 9), w: v(p, 12) }
    }

    #[inline(never)]
    fn linearize(&self, i: &Body3, j: &Body3, c: &mut [f64; 4], c_q: &mut [f64; 44]) {
        let (x1, x2, w) = (i.turn(&self.x1), i.turn(&self.x2), j.turn(&self.w));
        let (dx1, dx2, dw) = (i.turn_by_e(&self.x1), i.turn_by_e(&self.x2), j.turn_by_e(&self.w));
        let (a, b) = (i.turn(&self.u_i), j.turn(&self.u_j));
        let (da, db) = (i.turn_by_e(&self.u_i), j.turn_by_e(&self.u_j));
        let d: V = std::array::from_fn(|k| i.r[k] + a[k] - j.r[k] - b[k]);
        *c = [dot(&x1, &w), dot(&x2, &w), dot(&x1, &d), dot(&x2, &d)];
        for (k, (x, dx)) in [(&x1, &dx1), (&x2, &dx2)].into_iter().enumerate() {
            c_q[8 * k..8 * k + 4].copy_from_slice(&apply(dx, &w));
            c_q[8 * k + 4..8 * k + 8].copy_from_slice(&apply(&dw, x));
            let row = &mut c_q[16 + 14 * k..30 + 14 * k];
            let (by_x, by_a, by_b) = (apply(dx, &d), apply(&da, x), apply(&db, x));
            row[..3].copy_from_slice(x);
            (0..4).for_each(|l| row[3 + l] = by_x[l] + by_a[l]);
            (0..3).for_each(|l| row[7 + l] = -x[l]);
            (0..4).for_each(|l| row[10 + l] = -by_b[l]);
        }
    }

    #[inline(never)]
    fn right_side(&self, i: &Body3, j: &Body3, q_d: &mut [f64; 4]) {
        let (a, b) = (i.turn(&self.u_i), j.turn(&self.u_j));
        let (a1, b1) = (i.turn_rate(&self.u_i), j.turn_rate(&self.u_j));
        let (a2, b2) = (i.turn_second(&self.u_i), j.turn_second(&self.u_j));
        let d: V = std::array::from_fn(|k| i.r[k] + a[k] - j.r[k] - b[k]);
        let d1: V = std::array::from_fn(|k| i.rd[k] + a1[k] - j.rd[k] - b1[k]);
        let d2: V = std::array::from_fn(|k| a2[k] - b2[k]);
        let (w, w1, w2) = (j.turn(&self.w), j.turn_rate(&self.w), j.turn_second(&self.w));
        for (k, x) in [&self.x1, &self.x2].into_iter().enumerate() {
            let (x, x1, x2) = (i.turn(x), i.turn_rate(x), i.turn_second(x));
            q_d[k] = -4.0 * (dot(&x2, &w) + dot(&x, &w2)) - 2.0 * dot(&x1, &w1);
            q_d[2 + k] = -4.0 * (dot(&x2, &d) + dot(&x, &d2)) - 2.0 * dot(&x1, &d1);
        }
    }
}
