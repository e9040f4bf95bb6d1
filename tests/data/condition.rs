//! How far rounding alone may take the numbers of a run apart at a position: the condition of its
//! equations there.

use kin::nalgebra::{DMatrix, DVector};
use kin::prelude::*;

/// Rounding is made so many times larger before its effect is measured by a central difference, so
/// that rounding of the difference itself does not count.
const LARGER: f64 = 100.0;

/// The condition of the equations of a system at one time of a motion.
pub struct Condition<'a> {
    system: &'a System,
    t: f64,
    /// q, q̇, q̈ and, if the motion has it, q⃛.
    rows: Vec<&'a [f64]>,
    c_q: DMatrix<f64>,
    /// C_q⁻¹.
    inverse: DMatrix<f64>,
    /// Rounding of each equation for each order: ε (|C_q| |x| + |C_t| |t|), where x is the largest
    /// coordinate of its unit in the whole motion for q, and the row itself for derivatives.
    rounding: Vec<Vec<f64>>,
}

impl<'a> Condition<'a> {
    /// `None` if C_q has no inverse, or more equations than coordinates.
    pub fn at(system: &'a System, motion: &'a Motion, k: usize) -> Option<Self> {
        let t = motion.times()[k];
        let q = motion.q(k);
        let c_q = system.jacobian(q, t).ok()?;
        let inverse = c_q.is_square().then(|| c_q.clone().try_inverse())??;
        let mut rows = vec![q, motion.qd(k), motion.qdd(k)];
        if motion.has_jerk() {
            rows.push(motion.qddd(k));
        }
        let with_t = system.c_t(q, t).ok()?;
        let sizes = sizes(motion);
        let rounding = (0..rows.len()).map(|order| {
            let x = if order == 0 { &sizes } else { rows[order] };
            let own = |i: usize| -> f64 {
                let by_q = c_q.row(i).iter().zip(x).map(|(c, x)| (c * x).abs()).sum::<f64>();
                let by_t = if order == 0 { (with_t[i] * t).abs() } else { 0.0 };
                f64::EPSILON * (by_q + by_t)
            };
            (0..c_q.nrows()).map(own).collect()
        });
        let rounding = rounding.collect();
        Some(Condition { system, t, rows, c_q, inverse, rounding })
    }

    /// By how much rounding may take the numbers of an order apart in two runs: to first order
    /// 2 Σ |∂x/∂C_i| r_i over equations i and the orders up to this one, where r_i is the rounding
    /// of equation i.
    ///
    /// An error r_i of an equation moves q by C_q⁻¹ e_i r_i, which grows as C_q gets singular, and
    /// q̇ = −C_q(q)⁻¹ C_t(q), q̈ and q⃛ follow q.
    pub fn apart(&self, order: usize) -> Option<Vec<f64>> {
        let n = self.c_q.ncols();
        let mut sum = vec![0.0; n];
        for source in 0..=order {
            for (i, r) in self.rounding[source].iter().enumerate() {
                let off: DVector<f64> = self.inverse.column(i) * (r * LARGER);
                let [up, down] = [1.0, -1.0].map(|sign| self.moved(order, source, &(&off * sign)));
                let (up, down) = (up?, down?);
                for (sum, (a, b)) in sum.iter_mut().zip(up.iter().zip(&down)) {
                    *sum += (a - b).abs() / LARGER;
                }
            }
        }
        Some(sum)
    }

    /// The row of an order, after the row of another order was moved by so much.
    fn moved(&self, order: usize, source: usize, off: &DVector<f64>) -> Option<Vec<f64>> {
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for level in 0..=order {
            let mut row = match level {
                0 => self.rows[0].to_vec(),
                1 => self.system.velocity(&rows[0], self.t).ok()?,
                2 => self.system.acceleration(&rows[0], &rows[1], self.t).ok()?,
                _ => self.system.jerk(&rows[0], &rows[1], &rows[2], self.t).ok()?,
            };
            if level == source {
                row.iter_mut().zip(off).for_each(|(x, off)| *x += off);
            }
            rows.push(row);
        }
        rows.pop()
    }
}

/// The largest coordinate of each one's unit in a motion; of angles and numbers at least 1.
fn sizes(motion: &Motion) -> Vec<f64> {
    let units = motion.units();
    let mut largest = vec![0.0_f64; units.len()];
    for k in 0..motion.len() {
        largest.iter_mut().zip(motion.q(k)).for_each(|(most, q)| *most = most.max(q.abs()));
    }
    let of_unit = |unit: &String| {
        let least = if unit == "m" { 0.0 } else { 1.0 };
        let own = units.iter().zip(&largest).filter(|(own, _)| *own == unit);
        own.fold(least, |most: f64, (_, q)| most.max(*q))
    };
    units.iter().map(of_unit).collect()
}
