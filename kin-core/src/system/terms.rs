//! What the equations of a system are at one pose: C, C_q, C_t, Q_d, and the rates that follow from them.

use nalgebra::DMatrix;

use super::evaluate::{Bad, Instant, finite};
use super::{System, scale, time};
use crate::linear::Linear;
use crate::model::error::Result;
use crate::solve::motion::{Motion, Series};
use crate::solve::newton::redundant;

impl System {
    /// The 2-norm condition number of C_q at each time of a motion of this system, rows and columns measured as the solver does, so that
    /// it does not depend on units; estimated from below, seldom by more than 2. Infinite where C_q is singular.   \[-\]
    ///
    /// Errors: a motion of another system.
    pub fn condition(&self, motion: &Motion) -> Result<Series> {
        let values = (0..motion.len()).map(|k| self.condition_at(motion.q(k), motion.times()[k])).collect::<Result<_>>()?;
        Ok(Series::new("condition number", "-", motion.clock(), values))
    }

    /// The smallest singular value of C_q at each time of a motion of this system, measured as in [`System::condition`]: how near the
    /// mechanism is to a singular position; estimated from above, seldom by more than 2. Zero where C_q is singular.   \[-\]
    ///
    /// Errors: a motion of another system.
    pub fn smallest_singular_value(&self, motion: &Motion) -> Result<Series> {
        let values = (0..motion.len()).map(|k| Ok(self.singular_values_at(motion.q(k), motion.times()[k])?[1])).collect::<Result<_>>()?;
        Ok(Series::new("smallest singular value", "-", motion.clock(), values))
    }

    fn condition_at(&self, q: &[f64], t: f64) -> Result<f64> {
        let [largest, smallest] = self.singular_values_at(q, t)?;
        let condition = largest / smallest;
        Ok(if condition.is_finite() { condition } else { f64::INFINITY })
    }

    /// The largest and the smallest singular value.
    fn singular_values_at(&self, q: &[f64], t: f64) -> Result<[f64; 2]> {
        if redundant::is_redundant(self) {
            return Ok(self.singular_values_of_all_rows(self.jacobian(q, t)?, q, t));
        }
        let mut linear = self.linearized(q, t)?;
        Ok(if linear.factor() { linear.singular_values() } else { [1.0, 0.0] })
    }

    /// The same where there are more rows than columns.
    fn singular_values_of_all_rows(&self, mut c_q: DMatrix<f64>, q: &[f64], t: f64) -> [f64; 2] {
        let measures = self.model().measure(q, t);
        c_q.column_iter_mut().zip(&measures.sizes).for_each(|(mut column, size)| column *= *size);
        c_q.row_iter_mut().zip(&measures.norms).for_each(|(mut row, norm)| row /= *norm);
        let singular = c_q.singular_values();
        [singular.max(), singular.min()]
    }

    /// C(q, t), in the unit of each row. Errors: wrong length, not finite.
    pub fn residual(&self, q: &[f64], t: f64) -> Result<Vec<f64>> {
        let instant = self.instant(q, t)?;
        let mut c = vec![0.0; self.n_equations()];
        self.finite(self.equations.residual(q, &instant, &mut c), &instant)?;
        Ok(c)
    }

    /// C_q(q, t), m × n. Errors: wrong length, not finite.
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

    /// C_t(q, t), in the unit of each row a second. Errors: wrong length, not finite.
    pub fn c_t(&self, q: &[f64], t: f64) -> Result<Vec<f64>> {
        let instant = self.instant(q, t)?;
        let mut rhs = vec![0.0; self.n_equations()];
        self.equations.velocity_rhs(&instant, &mut rhs);
        self.finite(finite(&rhs, "C_t"), &instant)?;
        Ok(rhs.into_iter().map(|x| 0.0 - x).collect())
    }

    /// Q_d = −(C_q q̇)_q q̇ − 2 C_qt q̇ − C_tt, in the unit of each row a second squared. Errors: wrong length, not finite.
    pub fn acceleration_rhs(&self, q: &[f64], qd: &[f64], t: f64) -> Result<Vec<f64>> {
        let mut instant = self.instant(q, t)?;
        self.check(qd, "velocities")?;
        self.equations.set_rates(qd, &mut instant);
        let mut q_d = vec![0.0; self.n_equations()];
        self.equations.acceleration_rhs(&instant, &mut q_d);
        self.finite(finite(&q_d, "Q_d"), &instant)?;
        Ok(q_d)
    }

    /// q̇ at a position q, from C_q q̇ = −C_t. Errors: wrong length, not finite, singular.
    pub fn velocity(&self, q: &[f64], t: f64) -> Result<Vec<f64>> {
        let rhs: Vec<f64> = self.c_t(q, t)?.into_iter().map(|x| -x).collect();
        let qd = self.solved(q, t, &rhs)?;
        self.check(&qd, "velocities")?;
        Ok(qd)
    }

    /// q̈ at a position q and velocity q̇, from C_q q̈ = Q_d. Errors: wrong length, not finite, singular.
    pub fn acceleration(&self, q: &[f64], qd: &[f64], t: f64) -> Result<Vec<f64>> {
        let q_d = self.acceleration_rhs(q, qd, t)?;
        let qdd = self.solved(q, t, &q_d)?;
        self.check(&qdd, "accelerations")?;
        Ok(qdd)
    }

    /// −g‴(0) with g(s) = C(q + s q̇ + ½ s² q̈, t + s): the right side of C_q q⃛, in the unit of each row a second cubed.
    ///
    /// Errors: wrong length, not finite, a hand-written constraint without [`crate::Constraint::jerk_rhs`].
    pub fn jerk_rhs(&self, q: &[f64], qd: &[f64], qdd: &[f64], t: f64) -> Result<Vec<f64>> {
        let instant = self.instant(q, t)?;
        self.check(qd, "velocities")?;
        self.check(qdd, "accelerations")?;
        let rhs = self.model().jerk_rhs(q, t, qd, qdd)?;
        rhs.map_err(|bad| self.equations.not_finite(bad, &self.layout, &instant))
    }

    /// q⃛ at a position q, velocity q̇ and acceleration q̈, from C_q q⃛ = −g‴(0). Errors: those of [`System::jerk_rhs`], singular.
    pub fn jerk(&self, q: &[f64], qd: &[f64], qdd: &[f64], t: f64) -> Result<Vec<f64>> {
        let rhs = self.jerk_rhs(q, qd, qdd, t)?;
        let qddd = self.solved(q, t, &rhs)?;
        self.check(&qddd, "jerk")?;
        Ok(qddd)
    }

    /// The instant at q and t, if they are well given.
    fn instant(&self, q: &[f64], t: f64) -> Result<Instant> {
        self.check(q, "coordinates")?;
        Ok(self.equations.instant_at(time(t)?, q))
    }

    /// The values of C_q at an instant.
    fn linearize(&self, q: &[f64], instant: &Instant, values: &mut [f64]) -> Result<()> {
        let mut c = vec![0.0; self.n_equations()];
        self.equations.set_constants(values);
        self.equations.linearize(q, instant, &mut c, values);
        self.finite(self.equations.finite(&c, values), instant)
    }

    fn finite(&self, result: std::result::Result<(), Bad>, instant: &Instant) -> Result<()> {
        result.map_err(|bad| self.equations.not_finite(bad, &self.layout, instant))
    }

    /// C_q⁻¹ times the right side, with the sizes of that point; in the sense of least squares where there are more equations.
    fn solved(&self, q: &[f64], t: f64, rhs: &[f64]) -> Result<Vec<f64>> {
        if redundant::is_redundant(self) {
            return redundant::solved(self, q, t, rhs);
        }
        let mut linear = self.linearized(q, t)?;
        if !linear.factor() {
            return Err(self.singular(t, q, None));
        }
        linear.rhs_mut().copy_from_slice(rhs);
        linear.solve();
        Ok(linear.solution().to_vec())
    }

    /// C_q(q, t) with the sizes of that point, ready to be factored.
    fn linearized(&self, q: &[f64], t: f64) -> Result<Linear> {
        let instant = self.instant(q, t)?;
        let mut linear = self.linear();
        linear.forget();
        self.linearize(q, &instant, linear.values_mut())?;
        let sizes = scale::sizes(&self.layout, &self.equations, linear.values(), q, &self.links);
        linear.set_sizes(&sizes);
        linear.measure();
        Ok(linear)
    }
}
