//! Checks a time of the compiled program with the constraints themselves: their kernels and their
//! present parameters.

use crate::solve::motion::Motion;
use crate::solve::run::Run;
use crate::system::evaluate::{Equations, Instant};

/// The permitted sum of a row, as a share of the sum of the magnitudes of its terms. \[-\]
const OFF: f64 = 1e-9;

/// A row with small terms is compared with this share of the largest row. \[-\]
const SMALL: f64 = 0.01;

/// For each row the sum of its terms, and the sum of their magnitudes.
#[derive(Default)]
pub(super) struct Sums {
    sums: Vec<f64>,
    sizes: Vec<f64>,
}

impl Run<'_> {
    /// Returns true if C = 0, C_q q̇ = −C_t, C_q q̈ = Q_d and, if the motion has q⃛, C_q q⃛ =
    /// −g‴(0) hold at the last time of the motion. `allowed` is the allowance of each row.
    /// Afterwards the present position is that time; [`Run::go_on`] changes it.
    pub(super) fn holds(&mut self, motion: &Motion, allowed: &[f64], room: &mut Sums) -> bool {
        let Some(last) = motion.len().checked_sub(1) else { return true };
        self.stepper_mut().is_some_and(|stepper| {
            let newton = &mut stepper.newton;
            newton.q.copy_from_slice(motion.q(last));
            let rates = [motion.qd(last), motion.qdd(last), motion.qddd(last)];
            let holds = newton.linearize(motion.times()[last]).is_ok() && {
                let (values, rhs) = newton.linear.values_and_rhs();
                let equations = newton.system.equations();
                let look =
                    Look { equations, instant: &mut newton.instant, c: &newton.c, values, rhs };
                holds(look, rates, (allowed, room))
            };
            // The sizes measured there are used from now on, or not at all.
            if holds {
                newton.linear.confirm()
            } else {
                newton.linear.revoke()
            }
            holds
        })
    }
}

/// The constraints at a point: the instant, C and C_q, and a buffer for a right side.
pub(super) struct Look<'n> {
    pub equations: &'n Equations,
    pub instant: &'n mut Instant,
    pub c: &'n [f64],
    pub values: &'n [f64],
    pub rhs: &'n mut [f64],
}

/// Returns true if C = 0, C_q q̇ = −C_t, C_q q̈ = Q_d and, unless it is empty, C_q q⃛ = −g‴(0) hold
/// at that point.
pub(super) fn holds(
    Look { equations, instant, c, values, rhs }: Look<'_>,
    [qd, qdd, qddd]: [&[f64]; 3],
    (allowed, room): (&[f64], &mut Sums),
) -> bool {
    // The last correction came after this evaluation of C.
    let met = c.iter().zip(allowed).all(|(c, allowed)| c.abs() <= 2.0 * allowed);
    equations.velocity_rhs(instant, rhs);
    let mut is_solution = |x: &[f64], rhs: &[f64]| is_solution(equations, (values, x, rhs), room);
    let moves = is_solution(qd, rhs);
    equations.set_rates(qd, instant);
    equations.acceleration_rhs(instant, rhs);
    let follows = is_solution(qdd, rhs);
    if !(met && moves && follows) {
        return false;
    }
    if qddd.is_empty() {
        return true;
    }
    equations.jerk_rhs(qdd, instant, rhs).is_ok() && is_solution(qddd, rhs)
}

/// Returns true if x solves C_q x = b, from the values of C_q.
fn is_solution(
    equations: &Equations,
    (values, x, b): (&[f64], &[f64], &[f64]),
    Sums { sums, sizes }: &mut Sums,
) -> bool {
    sums.clear();
    sums.extend(b.iter().map(|b| -b));
    sizes.clear();
    sizes.extend(b.iter().map(|b| b.abs()));
    for (entry, value) in equations.entries.iter().zip(values) {
        if let Some((row, column)) = *entry {
            sums[row] += value * x[column];
            sizes[row] += (value * x[column]).abs();
        }
    }
    let most = sizes.iter().copied().fold(0.0, f64::max);
    sums.iter().zip(sizes.iter()).all(|(sum, size)| sum.abs() <= OFF * (size + SMALL * most))
}
