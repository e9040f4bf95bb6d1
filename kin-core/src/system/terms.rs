//! Returns the terms of a system's equations at one pose: C, C_q, C_t, Q_d.

use nalgebra::DMatrix;

use super::evaluate::{Bad, Instant, finite};
use super::{System, scale, time};
use crate::linear::Linear;
use crate::outcome::error::Result;

impl System {
    /// Returns C(q, t), in the unit of each row.
    ///
    /// Errors: q has the wrong length; a value is not finite.
    pub fn residual(&self, q: &[f64], t: f64) -> Result<Vec<f64>> {
        let instant = self.instant(q, t)?;
        let mut c = vec![0.0; self.n_equations()];
        self.finite(self.equations.residual(q, &instant, &mut c), &instant)?;
        Ok(c)
    }

    /// Returns the Jacobian C_q(q, t), m × n.
    ///
    /// Errors: q has the wrong length; a value is not finite.
    pub fn jacobian(&self, q: &[f64], t: f64) -> Result<DMatrix<f64>> {
        let mut values = vec![0.0; self.equations.entries.len()];
        self.linearize(q, &self.instant(q, t)?, &mut values)?;
        let mut c_q = DMatrix::zeros(self.n_equations(), self.n_coordinates());
        for (entry, value) in self.equations.entries.iter().zip(values) {
            if let Some(place) = *entry {
                c_q[place] += value;
            }
        }
        Ok(c_q)
    }

    /// Returns C_t(q, t), in the unit of each row per second.
    ///
    /// Errors: q has the wrong length; a value is not finite.
    pub fn c_t(&self, q: &[f64], t: f64) -> Result<Vec<f64>> {
        let instant = self.instant(q, t)?;
        let mut rhs = vec![0.0; self.n_equations()];
        self.equations.velocity_rhs(&instant, &mut rhs);
        self.finite(finite(&rhs, "C_t"), &instant)?;
        Ok(rhs.into_iter().map(|x| 0.0 - x).collect())
    }

    /// Returns Q_d = −(C_q q̇)_q q̇ − 2 C_qt q̇ − C_tt, in the unit of each row per second squared.
    ///
    /// Errors: a list has the wrong length; a value is not finite.
    pub fn acceleration_rhs(&self, q: &[f64], qd: &[f64], t: f64) -> Result<Vec<f64>> {
        let mut instant = self.instant(q, t)?;
        self.check(qd, "velocities")?;
        self.equations.set_rates(qd, &mut instant);
        let mut q_d = vec![0.0; self.n_equations()];
        self.equations.acceleration_rhs(&instant, &mut q_d);
        self.finite(finite(&q_d, "Q_d"), &instant)?;
        Ok(q_d)
    }

    /// Returns −g‴(0) with g(s) = C(q + s q̇ + ½ s² q̈, t + s): the right side of C_q q⃛, in the
    /// unit of each row per second cubed.
    ///
    /// Errors: a list has the wrong length; a value is not finite; a hand-written constraint does
    /// not implement [`crate::Constraint::jerk_rhs`].
    pub fn jerk_rhs(&self, q: &[f64], qd: &[f64], qdd: &[f64], t: f64) -> Result<Vec<f64>> {
        let instant = self.instant(q, t)?;
        self.check(qd, "velocities")?;
        self.check(qdd, "accelerations")?;
        let rhs = self.model().jerk_rhs(q, t, qd, qdd)?;
        rhs.map_err(|bad| self.equations.not_finite(bad, &self.layout, &instant))
    }

    /// Returns the instant at q and t, or an error for invalid arguments.
    fn instant(&self, q: &[f64], t: f64) -> Result<Instant> {
        self.check(q, "coordinates")?;
        Ok(self.equations.instant_at(time(t)?, q))
    }

    /// Writes the values of C_q at an instant.
    fn linearize(&self, q: &[f64], instant: &Instant, values: &mut [f64]) -> Result<()> {
        let mut c = vec![0.0; self.n_equations()];
        self.equations.set_constants(values);
        self.equations.linearize(q, instant, &mut c, values);
        self.finite(self.equations.finite(&c, values), instant)
    }

    fn finite(&self, result: std::result::Result<(), Bad>, instant: &Instant) -> Result<()> {
        result.map_err(|bad| self.equations.not_finite(bad, &self.layout, instant))
    }

    /// Returns C_q(q, t) with the sizes of this point, ready to be factored.
    pub(crate) fn linearized(&self, q: &[f64], t: f64) -> Result<Linear> {
        let instant = self.instant(q, t)?;
        let mut linear = self.linear();
        linear.forget();
        self.linearize(q, &instant, linear.values_mut())?;
        let sizes =
            scale::sizes(&self.layout, &self.equations, linear.values(), (q, t), &self.links);
        linear.set_sizes(&sizes);
        linear.measure();
        Ok(linear)
    }
}
