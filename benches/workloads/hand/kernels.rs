//! W8: the constraints of users by hand, cut into `linearize` (C, and C_q by rows) and `right_side`
//! (Q_d).
//!
//! A bare coordinate comes as its value, sine and cosine, a body as its coordinates.

use super::spatial_joints::{V, dot, motion, rotation, turn};

/// One constraint: C, the entries of C_q by rows, and Q_d.
pub trait Kernel {
    fn linearize(&self, states: &[f64], c: &mut [f64], c_q: &mut [f64]);
    fn right_side(&self, states: &[f64], qd: &[f64], q_d: &mut [f64]);
}

/// The value of coordinate k.
#[inline(always)]
fn coord(states: &[f64], k: usize) -> f64 {
    states[3 * k]
}

/// y = S(x), S a spline of cubic pieces.
pub struct Spline {
    pub knots: [f64; 21],
    pub pieces: [[f64; 4]; 20],
}

impl Spline {
    #[inline(always)]
    fn piece(&self, x: f64) -> (f64, &[f64; 4]) {
        let mut k = 0;
        while k < 19 && x >= self.knots[k + 1] {
            k += 1;
        }
        (x - self.knots[k], &self.pieces[k])
    }
}

impl Kernel for Spline {
    #[inline(never)]
    fn linearize(&self, states: &[f64], c: &mut [f64], c_q: &mut [f64]) {
        let (s, [a, b, d, e]) = self.piece(coord(states, 0));
        c[0] = coord(states, 1) - (a + s * (b + s * (d + s * e)));
        c_q[0] = -(b + s * (2.0 * d + s * (3.0 * e)));
        c_q[1] = 1.0;
    }

    #[inline(never)]
    fn right_side(&self, states: &[f64], qd: &[f64], q_d: &mut [f64]) {
        let (s, [_, _, d, e]) = self.piece(coord(states, 0));
        q_d[0] = (2.0 * d + 6.0 * e * s) * (qd[0] * qd[0]);
    }
}

/// The same of N pieces whose knots are known to be in order: the piece is found by halving.
pub struct Table<const N: usize> {
    knots: [f64; N],
    pieces: [[f64; 4]; N],
}

impl<const N: usize> Table<N> {
    pub fn new() -> Self {
        let of = |k: usize| [37 * k % 101, 53 * k % 103, 29 * k % 97, 41 * k % 89];
        Table {
            knots: std::array::from_fn(|k| 2.0 * k as f64 / N as f64 - 1.0),
            pieces: std::array::from_fn(|k| of(k).map(|c| c as f64 / 50.0 - 1.0)),
        }
    }

    #[inline(always)]
    fn piece(&self, x: f64) -> (f64, &[f64; 4]) {
        let k = self.knots[1..].partition_point(|knot| x >= *knot);
        (x - self.knots[k], &self.pieces[k])
    }
}

impl<const N: usize> Kernel for Table<N> {
    #[inline(never)]
    fn linearize(&self, states: &[f64], c: &mut [f64], c_q: &mut [f64]) {
        let (s, [a, b, d, e]) = self.piece(coord(states, 0));
        c[0] = coord(states, 1) - (a + s * (b + s * (d + s * e)));
        c_q[0] = -(b + s * (2.0 * d + s * (3.0 * e)));
        c_q[1] = 1.0;
    }

    #[inline(never)]
    fn right_side(&self, states: &[f64], qd: &[f64], q_d: &mut [f64]) {
        let (s, [_, _, d, e]) = self.piece(coord(states, 0));
        q_d[0] = (2.0 * d + 6.0 * e * s) * (qd[0] * qd[0]);
    }
}

/// The length of an open belt around wheels of radii r and s at a distance of x + 4.
pub struct Belt {
    pub r: f64,
    pub s: f64,
    pub length: f64,
}

impl Kernel for Belt {
    #[inline(never)]
    fn linearize(&self, states: &[f64], c: &mut [f64], c_q: &mut [f64]) {
        let distance = coord(states, 0) + 4.0;
        let sine = (self.r - self.s) / distance;
        let angle = sine.asin();
        let cosine = (1.0 - sine * sine).sqrt();
        let around = std::f64::consts::PI * (self.r + self.s) + 2.0 * angle * (self.r - self.s);
        c[0] = 2.0 * distance * cosine + around - self.length;
        c_q[0] = 2.0 * cosine;
    }

    #[inline(never)]
    fn right_side(&self, states: &[f64], qd: &[f64], q_d: &mut [f64]) {
        let distance = coord(states, 0) + 4.0;
        let sine = (self.r - self.s) / distance;
        let cosine = (1.0 - sine * sine).sqrt();
        q_d[0] = -2.0 * sine * sine / (distance * cosine) * (qd[0] * qd[0]);
    }
}

/// A planar arm of five links by angles from link to link, its tip at a point.
pub struct Arm {
    pub lengths: [f64; 5],
    pub target: [f64; 2],
}

impl Kernel for Arm {
    #[inline(never)]
    fn linearize(&self, states: &[f64], c: &mut [f64], c_q: &mut [f64]) {
        let mut links = [(0.0, 0.0); 5];
        let mut angle = 0.0;
        for (k, link) in links.iter_mut().enumerate() {
            angle += coord(states, k);
            let (sin, cos) = angle.sin_cos();
            *link = (self.lengths[k] * cos, self.lengths[k] * sin);
        }
        let mut x = 0.0;
        let mut y = 0.0;
        for k in (0..5).rev() {
            (x, y) = (x + links[k].0, y + links[k].1);
            (c_q[k], c_q[5 + k]) = (-y, x);
        }
        (c[0], c[1]) = (x - self.target[0], y - self.target[1]);
    }

    #[inline(never)]
    fn right_side(&self, states: &[f64], qd: &[f64], q_d: &mut [f64]) {
        let mut angle = 0.0;
        let mut rate = 0.0;
        let mut x = 0.0;
        let mut y = 0.0;
        for (k, (length, own)) in self.lengths.iter().zip(qd).enumerate() {
            angle += coord(states, k);
            rate += own;
            let (sin, cos) = angle.sin_cos();
            let pull = length * rate * rate;
            (x, y) = (x + pull * cos, y + pull * sin);
        }
        (q_d[0], q_d[1]) = (x, y);
    }
}

/// Six revolute joints by Denavit–Hartenberg parameters, the tip at a point: the geometric
/// Jacobian, and the accelerations of the links from the base outwards.
pub struct Chain {
    /// a, d, cos α, sin α of each link.
    pub links: [[f64; 4]; 6],
    pub target: V,
}

/// A rotation by columns.
type Axes = [V; 3];

impl Chain {
    /// The axes of link k behind those of the link before, and the vector from that to its origin.
    #[inline(always)]
    fn step(&self, k: usize, [x, y, z]: &Axes, states: &[f64]) -> (Axes, V) {
        let [a, d, ca, sa] = self.links[k];
        let s = states[3 * k + 1];
        let c = states[3 * k + 2];
        let turned: V = std::array::from_fn(|i| c * x[i] + s * y[i]);
        let across: V = std::array::from_fn(|i| c * y[i] - s * x[i]);
        let arm = std::array::from_fn(|i| a * turned[i] + d * z[i]);
        let axes = [
            turned,
            std::array::from_fn(|i| ca * across[i] + sa * z[i]),
            std::array::from_fn(|i| ca * z[i] - sa * across[i]),
        ];
        (axes, arm)
    }
}

const START: Axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

#[inline(always)]
fn cross(a: &V, b: &V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn plus(a: &V, b: &V) -> V {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

impl Kernel for Chain {
    #[inline(never)]
    fn linearize(&self, states: &[f64], c: &mut [f64], c_q: &mut [f64]) {
        let mut axes = START;
        let mut joints = [([0.0; 3], [0.0; 3]); 6];
        for (k, joint) in joints.iter_mut().enumerate() {
            let z = axes[2];
            let arm;
            (axes, arm) = self.step(k, &axes, states);
            *joint = (z, arm);
        }
        let mut lever = [0.0; 3];
        // The first joint turns about z: its column has no third entry.
        let Some((rows, last)) = c_q.split_first_chunk_mut::<12>() else { return };
        for (k, (z, arm)) in joints.iter().enumerate().rev() {
            lever = plus(&lever, arm);
            let column = cross(z, &lever);
            (rows[k], rows[6 + k]) = (column[0], column[1]);
            if k > 0 {
                last[k - 1] = column[2];
            }
        }
        (0..3).for_each(|i| c[i] = lever[i] - self.target[i]);
    }

    #[inline(never)]
    fn right_side(&self, states: &[f64], qd: &[f64], q_d: &mut [f64]) {
        let mut axes = START;
        let mut spin = [0.0; 3];
        let mut turn = [0.0; 3];
        let mut tip = [0.0; 3];
        for (k, rate) in qd.iter().enumerate().take(6) {
            let z = axes[2];
            let own = z.map(|z| rate * z);
            turn = plus(&turn, &cross(&spin, &own));
            spin = plus(&spin, &own);
            let arm;
            (axes, arm) = self.step(k, &axes, states);
            let inward = cross(&spin, &cross(&spin, &arm));
            tip = plus(&tip, &plus(&cross(&turn, &arm), &inward));
        }
        (0..3).for_each(|i| q_d[i] = -tip[i]);
    }
}

/// A platform on six legs, each of a length of its own: |r + A u − b|² = l².
pub struct Platform {
    pub pins: [V; 6],
    pub bases: [V; 6],
}

impl Kernel for Platform {
    #[inline(never)]
    fn linearize(&self, states: &[f64], c: &mut [f64], c_q: &mut [f64]) {
        let p = [states[3], states[4], states[5], states[6]];
        let doubled = p.map(|e| 2.0 * e);
        let rows =
            c.iter_mut().zip(c_q.as_chunks_mut::<8>().0).zip(self.pins.iter().zip(&self.bases));
        for (k, ((c, row), (pin, base))) in rows.enumerate() {
            let ([a, b, e], turned) = turn(&p, &doubled, pin);
            let l: V = std::array::from_fn(|i| states[i] + turned[i] - pin[i] - base[i]);
            let length = states[7 + 3 * k];
            *c = dot(&l, &l) - length * length;
            let l = l.map(|x| 2.0 * x);
            let by = |k: usize| dot(&[a[k], b[k], e[k]], &l);
            *row = [l[0], l[1], l[2], by(0), by(1), by(2), by(3), -2.0 * length];
        }
    }

    #[inline(never)]
    fn right_side(&self, states: &[f64], qd: &[f64], q_d: &mut [f64]) {
        let p = [states[3], states[4], states[5], states[6]];
        let pd = [qd[3], qd[4], qd[5], qd[6]];
        let axes = rotation(&p);
        for (k, (pin, base)) in self.pins.iter().zip(&self.bases).enumerate() {
            let l: V = std::array::from_fn(|i| states[i] + dot(&axes[i], pin) - base[i]);
            let (_, x1, x2) = motion(&p, &pd, pin);
            let l1 = [qd[0] + x1[0], qd[1] + x1[1], qd[2] + x1[2]];
            let length_rate = qd[7 + k];
            q_d[k] = 2.0 * (length_rate * length_rate - dot(&l1, &l1) - 2.0 * dot(&l, &x2));
        }
    }
}
