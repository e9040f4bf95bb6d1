//! Measures how close a mechanism is to a singular position along a motion.

use nalgebra::DMatrix;

use crate::outcome::error::Result;
use crate::solve::motion::{Motion, Series};
use crate::system::System;

impl System {
    /// Returns the 2-norm condition number of C_q at each time of a motion of this system. \[-\]
    ///
    /// Kin scales rows and columns as in the solver, so the number does not depend on units. The
    /// number is an estimate from below; the exact number is rarely more than twice as large. The
    /// number is infinite where C_q is singular.
    ///
    /// Errors: the motion belongs to another system.
    pub fn condition(&self, motion: &Motion) -> Result<Series> {
        let values = (0..motion.len())
            .map(|k| self.condition_at(motion.q(k), motion.times()[k]))
            .collect::<Result<_>>()?;
        Ok(Series::new("condition number", "-", motion.clock(), values))
    }

    /// Returns the smallest singular value of C_q at each time of a motion of this system, scaled
    /// as in [`System::condition`]. \[-\]
    ///
    /// The value shows how close the mechanism is to a singular position. The value is an estimate
    /// from above, rarely more than twice the exact value. The value is zero where C_q is singular.
    ///
    /// Errors: the motion belongs to another system.
    pub fn smallest_singular_value(&self, motion: &Motion) -> Result<Series> {
        let values = (0..motion.len())
            .map(|k| Ok(self.singular_values_at(motion.q(k), motion.times()[k])?[1]))
            .collect::<Result<_>>()?;
        Ok(Series::new("smallest singular value", "-", motion.clock(), values))
    }

    fn condition_at(&self, q: &[f64], t: f64) -> Result<f64> {
        let [largest, smallest] = self.singular_values_at(q, t)?;
        let condition = largest / smallest;
        Ok(if condition.is_finite() { condition } else { f64::INFINITY })
    }

    /// Returns the largest and the smallest singular value.
    fn singular_values_at(&self, q: &[f64], t: f64) -> Result<[f64; 2]> {
        if self.is_redundant() {
            return Ok(self.singular_values_of_all_rows(self.jacobian(q, t)?, q, t));
        }
        let mut linear = self.linearized(q, t)?;
        Ok(if linear.factor() { linear.singular_values() } else { [1.0, 0.0] })
    }

    /// Returns the singular values if there are more rows than columns.
    fn singular_values_of_all_rows(&self, mut c_q: DMatrix<f64>, q: &[f64], t: f64) -> [f64; 2] {
        let measures = self.model().measure(q, t);
        c_q.column_iter_mut().zip(&measures.sizes).for_each(|(mut column, size)| column *= *size);
        c_q.row_iter_mut().zip(&measures.norms).for_each(|(mut row, norm)| row /= *norm);
        let singular = c_q.singular_values();
        [singular.max(), singular.min()]
    }
}
