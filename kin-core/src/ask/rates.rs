//! The derivatives q̇, q̈ and q⃛ that the equations determine at one pose.

use crate::ask::diagnosis::explain::EXPLAIN;
use crate::outcome::error::Result;
use crate::solve::redundant;
use crate::system::System;

impl System {
    /// Returns q̇ at a position q, from C_q q̇ = −C_t. Errors: a list has the wrong length; a value
    /// is not finite; the position is singular.
    pub fn velocity(&self, q: &[f64], t: f64) -> Result<Vec<f64>> {
        let rhs: Vec<f64> = self.c_t(q, t)?.into_iter().map(|x| -x).collect();
        let qd = self.solved(q, t, &rhs)?;
        self.check(&qd, "velocities")?;
        Ok(qd)
    }

    /// Returns q̈ at a position q and velocity q̇, from C_q q̈ = Q_d. Errors: a list has the wrong
    /// length; a value is not finite; the position is singular.
    pub fn acceleration(&self, q: &[f64], qd: &[f64], t: f64) -> Result<Vec<f64>> {
        let q_d = self.acceleration_rhs(q, qd, t)?;
        let qdd = self.solved(q, t, &q_d)?;
        self.check(&qdd, "accelerations")?;
        Ok(qdd)
    }

    /// Returns q⃛ at a position q, velocity q̇ and acceleration q̈, from C_q q⃛ = −g‴(0).
    ///
    /// Errors: those of [`System::jerk_rhs`]; the position is singular.
    pub fn jerk(&self, q: &[f64], qd: &[f64], qdd: &[f64], t: f64) -> Result<Vec<f64>> {
        let rhs = self.jerk_rhs(q, qd, qdd, t)?;
        let qddd = self.solved(q, t, &rhs)?;
        self.check(&qddd, "jerk")?;
        Ok(qddd)
    }

    /// Returns C_q⁻¹ times the right side, with the sizes of that point. With redundant equations
    /// it is the least-squares solution.
    fn solved(&self, q: &[f64], t: f64, rhs: &[f64]) -> Result<Vec<f64>> {
        if self.is_redundant() {
            return redundant::solved(self, q, t, rhs, EXPLAIN);
        }
        let mut linear = self.linearized(q, t)?;
        if !linear.factor() {
            return Err(self.singular(t, q, None));
        }
        linear.rhs_mut().copy_from_slice(rhs);
        linear.solve();
        Ok(linear.solution().to_vec())
    }
}
