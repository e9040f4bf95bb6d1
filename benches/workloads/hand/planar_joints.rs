//! W6, planar joints: `linearize` (C and C_q) and `right_side` (Q_d) from sines and cosines that
//! are evaluated once.

/// One joint between planar bodies i and j; q = (x_i, y_i, θ_i, x_j, y_j, θ_j).
pub trait Planar {
    fn new(p: &[f64]) -> Self;
    fn linearize(&self, q: &[f64; 6], turns: &Turns, c: &mut [f64; 2], c_q: &mut [f64; 8]);
    fn right_side(&self, q: &[f64; 6], qd: &[f64; 6], turns: &Turns, q_d: &mut [f64; 2]);
}

/// sin θ and cos θ of both bodies.
pub struct Turns {
    si: f64,
    ci: f64,
    sj: f64,
    cj: f64,
}

/// A joint fixed in both bodies by points: global components of a local vector.
#[inline(always)]
fn turned(s: f64, c: f64, u: &[f64; 2]) -> (f64, f64) {
    (c * u[0] - s * u[1], s * u[0] + c * u[1])
}

/// The whole batch: C, values of C_q, Q_d for each state.
pub fn batch<J: Planar>(states: &[f64], p: &[f64], output: &mut [f64]) {
    let joint = J::new(p);
    for (state, out) in states.as_chunks::<12>().0.iter().zip(output.as_chunks_mut::<12>().0) {
        let (Some((q, [qd])), Some((c, rest))) = (split(state), out.split_first_chunk_mut()) else {
            return;
        };
        let Some((c_q, q_d)) = rest.split_first_chunk_mut() else { return };
        let Some(q_d) = q_d.first_chunk_mut() else { return };
        let (si, ci) = q[2].sin_cos();
        let (sj, cj) = q[5].sin_cos();
        let turns = Turns { si, ci, sj, cj };
        joint.linearize(q, &turns, c, c_q);
        joint.right_side(q, qd, &turns, q_d);
    }
}

/// q and q̇ of one state.
#[inline(always)]
fn split(state: &[f64; 12]) -> Option<(&[f64; 6], &[[f64; 6]])> {
    state.as_chunks().0.split_first()
}

pub struct Revolute {
    i: [f64; 2],
    j: [f64; 2],
}

impl Planar for Revolute {
    fn new(p: &[f64]) -> Self {
        Revolute { i: [p[0], p[1]], j: [p[2], p[3]] }
    }

    #[inline(never)]
    fn linearize(&self, q: &[f64; 6], turns: &Turns, c: &mut [f64; 2], c_q: &mut [f64; 8]) {
        let (ax, ay) = turned(turns.si, turns.ci, &self.i);
        let (bx, by) = turned(turns.sj, turns.cj, &self.j);
        *c = [q[0] + ax - q[3] - bx, q[1] + ay - q[4] - by];
        *c_q = [1.0, -ay, -1.0, by, 1.0, ax, -1.0, -bx];
    }

    #[inline(never)]
    fn right_side(&self, _: &[f64; 6], qd: &[f64; 6], turns: &Turns, q_d: &mut [f64; 2]) {
        let (ax, ay) = turned(turns.si, turns.ci, &self.i);
        let (bx, by) = turned(turns.sj, turns.cj, &self.j);
        let wi = qd[2] * qd[2];
        let wj = qd[5] * qd[5];
        *q_d = [wi * ax - wj * bx, wi * ay - wj * by];
    }
}

pub struct Prismatic {
    j: [f64; 2],
    h: [f64; 2],
    theta0: f64,
    /// h · s_i, which turning does not change.
    h_i: f64,
}

impl Planar for Prismatic {
    fn new(p: &[f64]) -> Self {
        Prismatic { j: [p[2], p[3]], h: [p[4], p[5]], theta0: p[6], h_i: p[4] * p[0] + p[5] * p[1] }
    }

    #[inline(never)]
    fn linearize(&self, q: &[f64; 6], turns: &Turns, c: &mut [f64; 2], c_q: &mut [f64; 8]) {
        let (hx, hy) = turned(turns.si, turns.ci, &self.h);
        let (bx, by) = turned(turns.sj, turns.cj, &self.j);
        // d = s + a with a the attachment in body i: h · a is constant, so only s = R_i − R_j − b
        // matters.
        let sx = q[0] - q[3] - bx;
        let sy = q[1] - q[4] - by;
        *c = [q[2] - q[5] - self.theta0, hx * sx + hy * sy + self.h_i];
        *c_q = [1.0, -1.0, hx, hy, hx * sy - hy * sx, -hx, -hy, hx * by - hy * bx];
    }

    #[inline(never)]
    fn right_side(&self, q: &[f64; 6], qd: &[f64; 6], turns: &Turns, q_d: &mut [f64; 2]) {
        let (hx, hy) = turned(turns.si, turns.ci, &self.h);
        let (bx, by) = turned(turns.sj, turns.cj, &self.j);
        let sx = q[0] - q[3] - bx;
        let sy = q[1] - q[4] - by;
        let vx = qd[0] - qd[3] + qd[5] * by;
        let vy = qd[1] - qd[4] - qd[5] * bx;
        // −(h″ · s + 2 h′ · s′ + h · s″) with h″ = −w_i² h and s″ = w_j² b
        let wi = qd[2];
        let wj = qd[5];
        let fx = wi * (wi * sx - 2.0 * vy) - wj * (wj * bx);
        let fy = wi * (wi * sy + 2.0 * vx) - wj * (wj * by);
        *q_d = [0.0, hx * fx + hy * fy];
    }
}
