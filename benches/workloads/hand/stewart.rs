//! W5: the Stewart platform, with a 7×7 LU factorisation with partial pivoting.

use std::f64::consts::{FRAC_PI_3, FRAC_PI_4, PI};

use super::spatial_joints::{V, dot, motion, turn};
use super::{Equations, largest, sweep};
use crate::sweep::Table;

/// One leg: its pin on the base, its pin in the platform, its length at the start and the phase of
/// its motor.
#[derive(Clone, Copy, Debug)]
pub struct Leg {
    pub base: V,
    pub u: V,
    pub l0: f64,
    pub phase: f64,
}

impl Leg {
    /// L and its derivatives at time t.
    #[inline(always)]
    pub fn length(&self, t: f64) -> [f64; 3] {
        let (s, c) = (PI * t + self.phase).sin_cos();
        [self.l0 + 0.1 * (s - self.phase.sin()), 0.1 * PI * c, -0.1 * PI * PI * s]
    }
}

pub const START: [f64; 7] = [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0];

/// The six legs.
pub fn legs() -> [Leg; 6] {
    std::array::from_fn(|i| {
        let pair = 2.0 * PI * (i / 2) as f64 / 3.0;
        let side = if i % 2 == 0 { -1.0 } else { 1.0 };
        let alpha = pair + side * PI / 12.0;
        let beta = pair + side * FRAC_PI_4;
        let base = [alpha.cos(), alpha.sin(), 0.0];
        let u = [0.5 * beta.cos(), 0.5 * beta.sin(), 0.0];
        let l = [u[0] - base[0], u[1] - base[1], 1.0];
        Leg { base, u, l0: dot(&l, &l).sqrt(), phase: i as f64 * FRAC_PI_3 }
    })
}

pub fn run(steps: usize, dt: f64) -> Table {
    let solver = Solver {
        legs: legs(),
        lengths: [[0.0; 3]; 6],
        l: [[0.0; 3]; 6],
        c: [0.0; 7],
        factors: Factors::default(),
    };
    sweep(solver, START, dt, steps)
}

struct Solver {
    legs: [Leg; 6],
    /// L², and half of its first and second derivative.
    lengths: [[f64; 3]; 6],
    /// The legs as vectors.
    l: [V; 6],
    c: [f64; 7],
    factors: Factors,
}

/// L U = P A; each row of the matrix with its reciprocal pivot apart.
#[derive(Default)]
struct Factors {
    a: [[f64; 7]; 7],
    reciprocals: [f64; 7],
    rows: [usize; 7],
}

impl Factors {
    fn factor(&mut self) {
        self.rows = [0, 1, 2, 3, 4, 5, 6];
        for k in 0..7 {
            let mut best = k;
            for i in k + 1..7 {
                if self.a[i][k].abs() > self.a[best][k].abs() {
                    best = i;
                }
            }
            self.a.swap(k, best);
            self.rows.swap(k, best);
            let pivot = self.a[k];
            let reciprocal = 1.0 / pivot[k];
            self.reciprocals[k] = reciprocal;
            for row in &mut self.a[k + 1..] {
                let l = row[k] * reciprocal;
                row[k] = l;
                for j in k + 1..7 {
                    row[j] -= l * pivot[j];
                }
            }
        }
    }

    fn solve(&self, b: &[f64; 7]) -> [f64; 7] {
        let mut x = self.rows.map(|row| b[row]);
        for k in 1..7 {
            for j in 0..k {
                x[k] -= self.a[k][j] * x[j];
            }
        }
        for k in (0..7).rev() {
            for j in k + 1..7 {
                x[k] -= self.a[k][j] * x[j];
            }
            x[k] *= self.reciprocals[k];
        }
        x
    }
}

impl Solver {
    /// C_q at q, factored.
    fn factor(&mut self, q: &[f64; 7]) {
        let p = [q[3], q[4], q[5], q[6]];
        let d = [4.0 * q[3], 4.0 * q[4], 4.0 * q[5], 4.0 * q[6]];
        for ((row, leg), l) in self.factors.a.iter_mut().zip(&self.legs).zip(&self.l) {
            // Rows of |l|², from twice ∂(A u)/∂p.
            let ([a, b, c], _) = turn(&p, &d, &leg.u);
            let by = |k: usize| a[k] * l[0] + b[k] * l[1] + c[k] * l[2];
            *row = [2.0 * l[0], 2.0 * l[1], 2.0 * l[2], by(0), by(1), by(2), by(3)];
        }
        self.factors.a[6] = [0.0, 0.0, 0.0, 2.0 * q[3], 2.0 * q[4], 2.0 * q[5], 2.0 * q[6]];
        self.factors.factor();
    }
}

impl Equations<7> for Solver {
    fn set_time(&mut self, t: f64) {
        for (lengths, leg) in self.lengths.iter_mut().zip(&self.legs) {
            let [l, l1, l2] = leg.length(t);
            *lengths = [l * l, l * l1, l1 * l1 + l * l2];
        }
    }

    fn residual(&mut self, q: &[f64; 7]) -> f64 {
        let turns = super::spatial_joints::rotation(&[q[3], q[4], q[5], q[6]]);
        for (k, leg) in self.legs.iter().enumerate() {
            let l: V = std::array::from_fn(|i| q[i] + dot(&turns[i], &leg.u) - leg.base[i]);
            self.c[k] = dot(&l, &l) - self.lengths[k][0];
            self.l[k] = l;
        }
        self.c[6] = q[3] * q[3] + q[4] * q[4] + q[5] * q[5] + q[6] * q[6] - 1.0;
        largest(&self.c)
    }

    fn correct(&mut self, q: &mut [f64; 7]) {
        self.factor(q);
        let dq = self.factors.solve(&self.c);
        q.iter_mut().zip(dq).for_each(|(q, dq)| *q -= dq);
    }

    fn velocity(&mut self, q: &[f64; 7]) -> [f64; 7] {
        self.factor(q);
        let mut rhs = [0.0; 7];
        rhs.iter_mut().zip(&self.lengths).for_each(|(rhs, lengths)| *rhs = 2.0 * lengths[1]);
        self.factors.solve(&rhs)
    }

    fn acceleration(&mut self, q: &[f64; 7], qd: &[f64; 7]) -> [f64; 7] {
        let p = [q[3], q[4], q[5], q[6]];
        let pd = [qd[3], qd[4], qd[5], qd[6]];
        let mut rhs = [0.0; 7];
        for (k, leg) in self.legs.iter().enumerate() {
            let (_, x1, x2) = motion(&p, &pd, &leg.u);
            let l1 = [qd[0] + x1[0], qd[1] + x1[1], qd[2] + x1[2]];
            rhs[k] = 2.0 * (self.lengths[k][2] - dot(&l1, &l1) - 2.0 * dot(&self.l[k], &x2));
        }
        rhs[6] = -2.0 * (pd[0] * pd[0] + pd[1] * pd[1] + pd[2] * pd[2] + pd[3] * pd[3]);
        self.factors.solve(&rhs)
    }
}
