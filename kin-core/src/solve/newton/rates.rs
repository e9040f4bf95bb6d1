//! Computes velocities, accelerations and jerks with the matrix of the last convergence check.

use super::{Failure, Newton};
use crate::numbers::padded;
use crate::system::evaluate::{Bad, JERK_RHS, finite};

impl Newton<'_> {
    /// Solves q̇ from C_q q̇ = −C_t and q̈ from C_q q̈ = Q_d, with the matrix that
    /// [`Newton::solve`] has factored.
    pub(crate) fn rates(&mut self) -> Result<(), Failure> {
        let equations = self.system.equations();
        equations.velocity_rhs(&self.instant, self.linear.rhs_mut());
        self.linear.solve();
        let finite = padded::take(self.qd.whole_mut(), self.linear.whole_solution());
        equations.set_rates(&self.qd, &mut self.instant);
        equations.acceleration_rhs(&self.instant, self.linear.rhs_mut());
        self.linear.solve();
        // A right side that is not finite makes a solution that is not finite.
        if !(padded::take(self.qdd.whole_mut(), self.linear.whole_solution()) && finite) {
            return Err(Failure::NotFinite(self.overflow()));
        }
        if self.options.jerk { self.jerk() } else { Ok(()) }
    }

    /// Solves q⃛ from C_q q⃛ = −g‴(0) with the same factors.
    fn jerk(&mut self) -> Result<(), Failure> {
        let equations = self.system.equations();
        let rhs = self.linear.rhs_mut();
        let known = equations
            .jerk_rhs(&self.qdd, &mut self.instant, rhs)
            .map_err(|row| Bad { row, quantity: JERK_RHS });
        let right_side = known.and_then(|()| finite(rhs, JERK_RHS));
        self.linear.solve();
        if padded::take(self.qddd.whole_mut(), self.linear.whole_solution()) && right_side.is_ok() {
            return Ok(());
        }
        Err(Failure::NotFinite(
            right_side.err().unwrap_or(Bad { row: self.worst().0, quantity: "q'''" }),
        ))
    }

    /// Returns |C_q⁻¹ (C_q v)_q v| in units of the sizes, with the present matrix. It overwrites
    /// the velocities of the instant.
    pub(crate) fn bend(&mut self, v: &[f64]) -> f64 {
        let equations = self.system.equations();
        equations.set_rates(v, &mut self.instant);
        equations.second_order(&self.instant, 0.0, self.linear.rhs_mut());
        self.linear.solve();
        padded::largest_share(self.linear.whole_solution(), self.shares.whole())
    }

    /// Returns the entry of the right sides, or of their solutions, that is not finite.
    fn overflow(&mut self) -> Bad {
        let equations = self.system.equations();
        let own_row = |bad: Bad| Bad { row: self.worst().0, ..bad };
        let qd = finite(&self.qd, "q'").map_err(own_row);
        let qdd = finite(&self.qdd, "q''").map_err(own_row);
        let rhs = self.linear.rhs_mut();
        equations.velocity_rhs(&self.instant, rhs);
        let c_t = finite(rhs, "C_t");
        equations.acceleration_rhs(&self.instant, rhs);
        let q_d = finite(rhs, "Q_d");
        c_t.and(qd).and(q_d).and(qdd).err().unwrap_or(Bad { row: 0, quantity: "q''" })
    }
}
