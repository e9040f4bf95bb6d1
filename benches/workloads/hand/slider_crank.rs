//! W2: loop closure of the offset slider-crank. The second row has one unknown, the first then the
//! other.

use super::{Equations, largest, sweep};
use crate::sweep::Table;

pub const L2: f64 = 1.0;
pub const L3: f64 = 3.5;
pub const H: f64 = 0.2;
pub const OMEGA: f64 = 10.0;

/// θ3 and x at the start, where the crank lies along the x-axis.
pub fn start() -> [f64; 2] {
    let theta3 = (H / L3).asin();
    [theta3, L2 + L3 * theta3.cos()]
}

pub fn run(steps: usize, dt: f64) -> Table {
    // The lengths are numbers of the model, known at run time only, as the library's are.
    let [l2, l3, h, omega] = std::hint::black_box([L2, L3, H, OMEGA]);
    sweep(
        Solver { l2, l3, h, omega, x: 0.0, y: 0.0, a: 0.0, b: 0.0, c: [0.0; 2] },
        start(),
        dt,
        steps,
    )
}

struct Solver {
    l2: f64,
    l3: f64,
    h: f64,
    omega: f64,
    /// The crank as a vector.
    x: f64,
    y: f64,
    /// The coupler as a vector.
    a: f64,
    b: f64,
    c: [f64; 2],
}

impl Equations<2> for Solver {
    fn set_time(&mut self, t: f64) {
        let (s, c) = (self.omega * t).sin_cos();
        (self.x, self.y) = (self.l2 * c, self.l2 * s);
    }

    fn residual(&mut self, q: &[f64; 2]) -> f64 {
        let (s, c) = q[0].sin_cos();
        (self.a, self.b) = (self.l3 * c, self.l3 * s);
        self.c = [self.x + self.a - q[1], self.y + self.b - self.h];
        largest(&self.c)
    }

    fn correct(&mut self, q: &mut [f64; 2]) {
        let turn = -self.c[1] / self.a;
        q[0] += turn;
        q[1] += self.c[0] - self.b * turn;
    }

    fn velocity(&mut self, _: &[f64; 2]) -> [f64; 2] {
        let turn = -self.omega * self.x / self.a;
        [turn, -self.omega * self.y - self.b * turn]
    }

    fn acceleration(&mut self, _: &[f64; 2], qd: &[f64; 2]) -> [f64; 2] {
        let w2 = self.omega * self.omega;
        let w3 = qd[0] * qd[0];
        let turn = (w2 * self.y + w3 * self.b) / self.a;
        [turn, -self.b * turn - (w2 * self.x + w3 * self.a)]
    }
}
