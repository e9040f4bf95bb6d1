//! The same work written by hand, as an engineer with time to spare would: everything shared that
//! can be, the linear solves eliminated on paper, cut into the same functions as the library's. It
//! is the practical limit that the library is measured against.

pub mod chain;
pub mod four_bar;
pub mod kernels;
pub mod planar_joints;
pub mod slider_crank;
pub mod spatial_joints;
pub mod stewart;
pub mod two_link;

use crate::sweep::Table;

/// A system of n equations, solved by Newton's method with C_q at every iterate.
pub trait Equations<const N: usize> {
    /// Computes the values that depend on t alone.
    fn set_time(&mut self, t: f64);
    /// Sines and cosines, and C, which is kept; max |C_i|.
    fn residual(&mut self, q: &[f64; N]) -> f64;
    /// q += Δq with C_q Δq = −C.
    fn correct(&mut self, q: &mut [f64; N]);
    /// q̇ from C_q q̇ = −C_t, C_q at the last residual's q.
    fn velocity(&mut self, q: &[f64; N]) -> [f64; N];
    /// q̈ from C_q q̈ = Q_d.
    fn acceleration(&mut self, q: &[f64; N], qd: &[f64; N]) -> [f64; N];
}

/// The workloads' protocol from the exact state q at t = 0.
#[inline(always)]
pub fn sweep<E: Equations<N>, const N: usize>(
    mut equations: E,
    mut q: [f64; N],
    dt: f64,
    steps: usize,
) -> Table {
    let mut table = Table::new(N, steps);
    for k in 0..steps {
        equations.set_time(k as f64 * dt);
        let mut left = 50;
        while equations.residual(&q) >= 1e-10 && left > 0 {
            equations.correct(&mut q);
            left -= 1;
        }
        table.iterations += 50 - left;
        let qd = equations.velocity(&q);
        let qdd = equations.acceleration(&q, &qd);
        table.push(&q, &qd, &qdd);
    }
    table
}

/// max |x|; a comparison rather than `f64::max`, which takes three instructions to be right about
/// NaN.
#[inline(always)]
pub fn largest<const N: usize>(numbers: &[f64; N]) -> f64 {
    numbers.iter().fold(0.0, |m, x| if x.abs() > m { x.abs() } else { m })
}
