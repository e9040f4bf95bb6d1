//! Differentiates a measure by the coordinates on which it depends: y_q with its first two time
//! derivatives.
//!
//! Kin evaluates a measure y along the motions q + a s e_j that begin at the pose of each time. The
//! k-th derivative of y by s, for k up to 3, is a polynomial of degree k in a. The linear
//! coefficient of derivative k + 1 is (k + 1) times derivative k of y_q. The values at two or four
//! numbers a determine this coefficient exactly.

use crate::ask::measure::Measure;
use crate::numbers::random::Random;
use crate::outcome::error::Result;
use crate::solve::motion::{Motion, Quantity};
use crate::system::System;

/// ∂y/∂q_j and its first and second time derivatives, at each time.
pub(super) type Partial = [Vec<f64>; 3];

/// Returns the derivatives by all coordinates on which a measure depends, with their indices.
pub(super) fn partials(
    system: &System,
    motion: &Motion,
    what: &dyn Measure,
) -> Result<Vec<(usize, Partial)>> {
    if let Some(j) = what.coordinate(system) {
        let all = |x: f64| vec![x; motion.len()];
        return Ok(vec![(j, [all(1.0), all(0.0), all(0.0)])]);
    }
    let mut asked = Changed::new(system, motion, what)?;
    let columns = asked.read()?;
    columns.into_iter().map(|j| Ok((j, asked.partial(j)?))).collect()
}

/// A measure along a motion with changed velocities.
struct Changed<'a> {
    system: &'a System,
    what: &'a dyn Measure,
    motion: Motion,
    /// The measure without a change.
    still: Quantity,
    /// The size of changes. Changes as large as the velocities lose the fewest digits.
    size: f64,
}

impl<'a> Changed<'a> {
    fn new(system: &'a System, motion: &Motion, what: &'a dyn Measure) -> Result<Self> {
        let mut own = motion.clone();
        own.qddd = vec![0.0; own.q.len()];
        let largest = |all: &[f64]| all.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let size = largest(&own.qd).max(largest(&own.qdd).sqrt()).max(1.0);
        let size = if size.is_finite() { size } else { 1.0 };
        let still = what.of(system, &own)?;
        Ok(Changed { system, what, motion: own, still, size })
    }

    /// Returns the measure with these changes of velocities.
    fn asked(&mut self, changes: &[(usize, f64)]) -> Result<Quantity> {
        let n = self.motion.names().len();
        let mut before = Vec::with_capacity(changes.len() * self.motion.len());
        for rates in self.motion.qd.chunks_exact_mut(n.max(1)) {
            for (j, change) in changes {
                before.push(rates[*j]);
                rates[*j] += change;
            }
        }
        let asked = self.what.of(self.system, &self.motion);
        let mut before = before.into_iter();
        for rates in self.motion.qd.chunks_exact_mut(n.max(1)) {
            changes.iter().zip(before.by_ref()).for_each(|((j, _), rate)| rates[*j] = rate);
        }
        asked
    }

    /// Returns the coordinates on which the measure depends, by bisection: a half that changes
    /// nothing is excluded at once. Changes are random, so that those of two coordinates do not
    /// cancel.
    fn read(&mut self) -> Result<Vec<usize>> {
        let n = self.motion.names().len();
        let mut open = vec![(0, n)];
        let mut read = Vec::new();
        let mut random = Random::new(1);
        let sizes: Vec<f64> = (0..n).map(|_| self.size * (1.0 + 0.25 * random.number())).collect();
        while let Some((from, to)) = open.pop() {
            let changes: Vec<(usize, f64)> = (from..to).map(|j| (j, sizes[j])).collect();
            let asked = self.asked(&changes)?;
            let found = asked.orders();
            let still = self.still.orders();
            let same = |a: &f64, b: &f64| a.to_bits() == b.to_bits();
            if (1..4).all(|order| found[order].iter().zip(still[order]).all(|(a, b)| same(a, b))) {
                continue;
            }
            if to - from == 1 {
                read.push(from);
                continue;
            }
            let middle = from + (to - from) / 2;
            open.extend([(middle, to), (from, middle)]);
        }
        Ok(read)
    }

    /// Returns the derivatives by coordinate j.
    fn partial(&mut self, j: usize) -> Result<Partial> {
        let h = self.size;
        let mut both = |h: f64| Result::Ok([self.asked(&[(j, h)])?, self.asked(&[(j, -h)])?]);
        let near = both(h)?;
        let far = both(2.0 * h)?;
        let odd = |[plus, minus]: &[Quantity; 2], order: usize, k: usize| {
            0.5 * (plus.orders()[order][k] - minus.orders()[order][k])
        };
        let linear = |order: usize, k: usize| match order {
            1 | 2 => odd(&near, order, k) / h,
            _ => (8.0 * odd(&near, order, k) - odd(&far, order, k)) / (6.0 * h),
        };
        let list = |order: usize| {
            (0..self.motion.len()).map(|k| linear(order, k) / order as f64).collect::<Vec<f64>>()
        };
        Ok([list(1), list(2), list(3)])
    }
}
