//! The constraints themselves at a time that a program has computed: by their own kernels, with parameters as
//! they are now.

use crate::solve::motion::Motion;
use crate::solve::newton::Newton;
use crate::solve::newton::run::Run;

/// How far the sum of a row may be off, of the sum of the sizes of its terms.   \[-\]
const OFF: f64 = 1e-9;

/// A row whose terms are small is held to this share of the largest row's.   \[-\]
const SMALL: f64 = 0.01;

/// Of each row the sum of its terms, and of their sizes.
#[derive(Default)]
pub(super) struct Sums {
    sums: Vec<f64>,
    sizes: Vec<f64>,
}

impl Run<'_> {
    /// True if C = 0, C_q q̇ = −C_t, C_q q̈ = Q_d and, if the motion has q⃛, C_q q⃛ = −g‴(0) at the last time
    /// of the motion; `allowed` is how far each row may be off. The position in hand is that time's then:
    /// [`Run::go_on`] makes it another one.
    pub(super) fn holds(&mut self, motion: &Motion, allowed: &[f64], room: &mut Sums) -> bool {
        let Some(last) = motion.len().checked_sub(1) else { return true };
        self.stepper_mut().is_some_and(|stepper| {
            let newton = &mut stepper.newton;
            newton.q.copy_from_slice(motion.q(last));
            let rates = [motion.qd(last), motion.qdd(last), motion.qddd(last)];
            let holds = holds(newton, motion.times()[last], rates, (allowed, room));
            // The sizes that were measured there count from now on, or never.
            if holds {
                newton.linear.confirm()
            } else {
                newton.linear.revoke()
            }
            holds
        })
    }
}

fn holds(
    newton: &mut Newton<'_>,
    t: f64,
    [qd, qdd, qddd]: [&[f64]; 3],
    (allowed, room): (&[f64], &mut Sums),
) -> bool {
    let equations = newton.system.equations();
    if newton.linearize(t).is_err() {
        return false;
    }
    // The last correction has been made since C was looked at.
    let met = newton.c.iter().zip(allowed).all(|(c, allowed)| c.abs() <= 2.0 * allowed);
    equations.velocity_rhs(&newton.instant, newton.linear.rhs_mut());
    let moves = is_solution(newton, qd, room);
    equations.set_rates(qd, &mut newton.instant);
    equations.acceleration_rhs(&newton.instant, newton.linear.rhs_mut());
    let follows = is_solution(newton, qdd, room);
    if !(met && moves && follows) {
        return false;
    }
    if qddd.is_empty() {
        return true;
    }
    let known = equations.jerk_rhs(qdd, &mut newton.instant, newton.linear.rhs_mut()).is_ok();
    known && is_solution(newton, qddd, room)
}

/// True if x solves C_q x = b, where b is the right side in hand.
fn is_solution(newton: &mut Newton<'_>, x: &[f64], Sums { sums, sizes }: &mut Sums) -> bool {
    let b = newton.linear.rhs_mut();
    sums.clear();
    sums.extend(b.iter().map(|b| -b));
    sizes.clear();
    sizes.extend(b.iter().map(|b| b.abs()));
    for (entry, value) in newton.system.equations().entries.iter().zip(newton.linear.values()) {
        if let Some((row, column)) = *entry {
            sums[row] += value * x[column];
            sizes[row] += (value * x[column]).abs();
        }
    }
    let most = sizes.iter().copied().fold(0.0, f64::max);
    sums.iter().zip(sizes.iter()).all(|(sum, size)| sum.abs() <= OFF * (size + SMALL * most))
}
