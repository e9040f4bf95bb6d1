//! W3 and W7: the four-bar in absolute coordinates. What is left after elimination are two
//! equations for the coupler and the rocker.

use super::{Equations, largest, sweep};
use crate::sweep::Table;

/// Crank, coupler, rocker, distance of the ground pins, angular velocity of the crank.
#[derive(Clone, Copy, Debug)]
pub struct FourBar {
    pub a: f64,
    pub b: f64,
    pub c: f64,
    pub d: f64,
    pub omega: f64,
}

impl FourBar {
    /// The open branch at the crank's angle θ2, angles of coupler and rocker in (−π, π].
    pub fn position(&self, theta2: f64) -> [f64; 9] {
        let FourBar { a, b, c, d, .. } = *self;
        let ax = a * theta2.cos();
        let ay = a * theta2.sin();
        let distance = (d - ax).hypot(ay);
        let e = (b * b - c * c + distance * distance) / (2.0 * distance);
        let h = (b * b - e * e).sqrt();
        let x = ax + (e * (d - ax) + h * ay) / distance;
        let y = ay + (h * (d - ax) - e * ay) / distance;
        let theta3 = (y - ay).atan2(x - ax);
        let theta4 = y.atan2(x - d);
        [
            0.5 * ax,
            0.5 * ay,
            theta2,
            0.5 * (ax + x),
            0.5 * (ay + y),
            theta3,
            0.5 * (x + d),
            0.5 * y,
            theta4,
        ]
    }
}

pub fn run(model: &FourBar, steps: usize, dt: f64) -> Table {
    let solver = Solver {
        h: [0.5 * model.a, 0.5 * model.b, 0.5 * model.c],
        d: model.d,
        omega: model.omega,
        asked: 0.0,
        e: [[0.0; 2]; 3],
        c: [0.0; 9],
        reciprocal: 0.0,
    };
    sweep(solver, model.position(0.0), dt, steps)
}

struct Solver {
    /// Half lengths.
    h: [f64; 3],
    d: f64,
    omega: f64,
    /// The driver's angle.
    asked: f64,
    /// Half links as vectors.
    e: [[f64; 2]; 3],
    c: [f64; 9],
    /// Of the determinant left after elimination; one division serves velocity and acceleration.
    reciprocal: f64,
}

impl Solver {
    /// 1 / (e3 × e4), the determinant of what is left.
    fn reciprocal(&self) -> f64 {
        let [_, b, c] = &self.e;
        1.0 / (b[0] * c[1] - b[1] * c[0])
    }

    /// Turns of coupler and rocker with u n3 − v n4 = g, where n is e turned by 90°.
    fn turns(&self, g: [f64; 2], reciprocal: f64) -> (f64, f64) {
        let [_, b, c] = &self.e;
        ((g[0] * c[0] + g[1] * c[1]) * reciprocal, (g[0] * b[0] + g[1] * b[1]) * reciprocal)
    }

    /// All nine unknowns from the turns, for rows 1, 2 and 4 with right sides −r.
    fn all(&self, r: [[f64; 2]; 3], turn: [f64; 3]) -> [f64; 9] {
        let [a, b, c] = &self.e;
        let ax = -a[1] * turn[0];
        let ay = a[0] * turn[0];
        let x2 = ax - r[0][0];
        let y2 = ay - r[0][1];
        let x3 = x2 + ax - b[1] * turn[1] + r[1][0];
        let y3 = y2 + ay + b[0] * turn[1] + r[1][1];
        [
            x2,
            y2,
            turn[0],
            x3,
            y3,
            turn[1],
            -c[1] * turn[2] - r[2][0],
            c[0] * turn[2] - r[2][1],
            turn[2],
        ]
    }
}

impl Equations<9> for Solver {
    fn set_time(&mut self, t: f64) {
        self.asked = self.omega * t;
    }

    fn residual(&mut self, q: &[f64; 9]) -> f64 {
        let half = |h: f64, theta: f64| {
            let (s, c) = theta.sin_cos();
            [h * c, h * s]
        };
        let a = half(self.h[0], q[2]);
        let b = half(self.h[1], q[5]);
        let c = half(self.h[2], q[8]);
        self.c = [
            q[0] - a[0],
            q[1] - a[1],
            q[0] + a[0] - q[3] + b[0],
            q[1] + a[1] - q[4] + b[1],
            q[3] + b[0] - q[6] - c[0],
            q[4] + b[1] - q[7] - c[1],
            q[6] - c[0] - self.d,
            q[7] - c[1],
            q[2] - self.asked,
        ];
        self.e = [a, b, c];
        largest(&self.c)
    }

    fn correct(&mut self, q: &mut [f64; 9]) {
        let c = &self.c;
        let a = &self.e[0];
        let turn = -c[8];
        let g = [
            0.5 * (c[0] - c[2] - c[4] - c[6]) + a[1] * turn,
            0.5 * (c[1] - c[3] - c[5] - c[7]) - a[0] * turn,
        ];
        let (u, v) = self.turns(g, self.reciprocal());
        let dq = self.all([[c[0], c[1]], [c[2], c[3]], [c[6], c[7]]], [turn, u, v]);
        q.iter_mut().zip(dq).for_each(|(q, dq)| *q += dq);
    }

    fn velocity(&mut self, _: &[f64; 9]) -> [f64; 9] {
        let w = self.omega;
        let a = &self.e[0];
        let reciprocal = self.reciprocal();
        let (u, v) = self.turns([w * a[1], -w * a[0]], reciprocal);
        let qd = self.all([[0.0; 2]; 3], [w, u, v]);
        self.reciprocal = reciprocal;
        qd
    }

    fn acceleration(&mut self, _: &[f64; 9], qd: &[f64; 9]) -> [f64; 9] {
        let scaled = |e: &[f64; 2], w: f64| [w * w * e[0], w * w * e[1]];
        let [a, b, c] =
            [scaled(&self.e[0], qd[2]), scaled(&self.e[1], qd[5]), scaled(&self.e[2], qd[8])];
        let (u, v) = self.turns([a[0] + b[0] - c[0], a[1] + b[1] - c[1]], self.reciprocal);
        // Row by row −Q_d; the crank does not accelerate.
        self.all([a, [-a[0] - b[0], -a[1] - b[1]], c], [0.0, u, v])
    }
}
