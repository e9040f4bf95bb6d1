//! W1: the two-link manipulator. Drivers give both angles, the rest follows link by link.

use super::{Equations, largest, sweep};
use crate::sweep::Table;

/// Lengths, rates and first angles of links 2 and 3.
pub struct TwoLink {
    pub l: [f64; 2],
    pub omega: [f64; 2],
    pub theta0: [f64; 2],
}

pub const TWO_LINK: TwoLink = TwoLink {
    l: [0.2, 0.35],
    omega: [0.5, 0.75],
    theta0: [std::f64::consts::FRAC_PI_6, std::f64::consts::PI / 12.0],
};

impl TwoLink {
    /// The exact positions at time t.
    pub fn position(&self, t: f64) -> [f64; 9] {
        let [a, b] = [0, 1].map(|k| self.theta0[k] + self.omega[k] * t);
        let h = 0.5 * self.l[0];
        let g = 0.5 * self.l[1];
        let x = h * a.cos();
        let y = h * a.sin();
        [0.0, 0.0, 0.0, x, y, a, 2.0 * x + g * b.cos(), 2.0 * y + g * b.sin(), b]
    }
}

pub fn run(steps: usize, dt: f64) -> Table {
    let model = TWO_LINK;
    let q = model.position(0.0);
    let h = model.l.map(|l| 0.5 * l);
    sweep(
        Solver {
            h,
            omega: model.omega,
            theta0: model.theta0,
            asked: [0.0; 2],
            a: [0.0; 2],
            b: [0.0; 2],
            c: [0.0; 9],
        },
        q,
        dt,
        steps,
    )
}

struct Solver {
    /// Half lengths.
    h: [f64; 2],
    omega: [f64; 2],
    theta0: [f64; 2],
    /// The drivers' angles.
    asked: [f64; 2],
    /// Half links as vectors.
    a: [f64; 2],
    b: [f64; 2],
    c: [f64; 9],
}

impl Equations<9> for Solver {
    fn set_time(&mut self, t: f64) {
        self.asked = [self.omega[0] * t + self.theta0[0], self.omega[1] * t + self.theta0[1]];
    }

    fn residual(&mut self, q: &[f64; 9]) -> f64 {
        let (s2, c2) = q[5].sin_cos();
        let (s3, c3) = q[8].sin_cos();
        let a = [self.h[0] * c2, self.h[0] * s2];
        let b = [self.h[1] * c3, self.h[1] * s3];
        self.c = [
            q[0],
            q[1],
            q[2],
            q[0] - q[3] + a[0],
            q[1] - q[4] + a[1],
            q[3] + a[0] - q[6] + b[0],
            q[4] + a[1] - q[7] + b[1],
            q[5] - self.asked[0],
            q[8] - self.asked[1],
        ];
        (self.a, self.b) = (a, b);
        largest(&self.c)
    }

    fn correct(&mut self, q: &mut [f64; 9]) {
        let c = &self.c;
        let a = &self.a;
        let b = &self.b;
        let x2 = a[1] * c[7] - c[0] + c[3];
        let y2 = c[4] - c[1] - a[0] * c[7];
        let x3 = x2 + a[1] * c[7] + b[1] * c[8] + c[5];
        let y3 = y2 - a[0] * c[7] - b[0] * c[8] + c[6];
        let dq = [-c[0], -c[1], -c[2], x2, y2, -c[7], x3, y3, -c[8]];
        q.iter_mut().zip(dq).for_each(|(q, dq)| *q += dq);
    }

    fn velocity(&mut self, _: &[f64; 9]) -> [f64; 9] {
        let [w2, w3] = self.omega;
        let x2 = -w2 * self.a[1];
        let y2 = w2 * self.a[0];
        let x3 = 2.0 * x2 - w3 * self.b[1];
        let y3 = 2.0 * y2 + w3 * self.b[0];
        [0.0, 0.0, 0.0, x2, y2, w2, x3, y3, w3]
    }

    fn acceleration(&mut self, _: &[f64; 9], qd: &[f64; 9]) -> [f64; 9] {
        let w2 = qd[5] * qd[5];
        let w3 = qd[8] * qd[8];
        let x2 = -w2 * self.a[0];
        let y2 = -w2 * self.a[1];
        let x3 = 2.0 * x2 - w3 * self.b[0];
        let y3 = 2.0 * y2 - w3 * self.b[1];
        [0.0, 0.0, 0.0, x2, y2, 0.0, x3, y3, 0.0]
    }
}
