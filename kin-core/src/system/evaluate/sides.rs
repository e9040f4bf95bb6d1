//! Evaluates the right sides of a whole system, for velocities, accelerations and the jerk.

use super::linear::Side;
use super::{Block, Equations, Instant};
use crate::model::state::At;
use crate::outcome::error::Error;
use crate::outcome::error::surface::Surface;

impl Equations {
    /// Evaluates −C_t and does not check whether it is finite.
    pub(crate) fn velocity_rhs(&self, instant: &Instant, rhs: &mut [f64]) {
        rhs.fill(0.0);
        for block in self.asked.c_t.iter().map(|&k| &self.blocks[k]) {
            block.constraint.velocity_rhs(&self.at(block, instant), &mut rhs[block.rows.range()]);
        }
        self.linear.write_side(Side::Velocity, &instant.timed, 1.0, rhs);
    }

    /// Evaluates Q_d and does not check whether it is finite.
    pub(crate) fn acceleration_rhs(&self, instant: &Instant, q_d: &mut [f64]) {
        self.second_order(instant, 1.0, q_d);
    }

    /// Evaluates −[(C_q v)_q v + 2 ṫ C_qt v + ṫ² C_tt] along the velocities v of the instant and
    /// does not check whether it is finite.
    pub(crate) fn second_order(&self, instant: &Instant, t_dot: f64, rhs: &mut [f64]) {
        rhs.fill(0.0);
        let mut at = At::new(instant.t, &instant.states, &[]);
        for block in self.asked.q_d.iter().map(|&k| &self.blocks[k]) {
            self.show(block, instant, &mut at);
            block.constraint.acceleration_rhs(
                &at,
                &self.rates(block, &instant.rates),
                t_dot,
                &mut rhs[block.rows.range()],
            );
        }
        self.linear.write_side(Side::Acceleration, &instant.timed, t_dot * t_dot, rhs);
    }

    /// Evaluates −g‴(0) with g(s) = C(q + s q̇ + ½ s² q̈, t + s) and does not check whether it is
    /// finite.
    ///
    /// Errors: the first row of a constraint that does not know it.
    pub(crate) fn jerk_rhs(
        &self,
        qdd: &[f64],
        instant: &mut Instant,
        rhs: &mut [f64],
    ) -> Result<(), usize> {
        instant.second_rates.resize(instant.rates.len(), 0.0);
        self.plan.set_rates(qdd, &mut instant.second_rates);
        rhs.fill(0.0);
        // A constraint without second derivatives has no third ones.
        let linear = self.asked.linear.iter().map(|linear| &linear.block);
        for block in self.asked.q_d.iter().chain(linear).map(|&k| &self.blocks[k]) {
            let [qd, qdd] =
                [&instant.rates, &instant.second_rates].map(|rates| self.rates(block, rates));
            if !block.constraint.jerk_rhs(
                &self.at(block, instant),
                &qd,
                &qdd,
                &mut rhs[block.rows.range()],
            ) {
                return Err(block.rows().start);
            }
        }
        Ok(())
    }

    /// Returns measure k of a constraint with its first three derivatives, from rows of q, q̇, q̈
    /// and q⃛ (or nothing).
    pub(crate) fn measure(
        &self,
        block: &Block,
        k: usize,
        t: f64,
        [q, qd, qdd, qddd]: [&[f64]; 4],
    ) -> [f64; 4] {
        let instant = self.instant_at(t, q);
        let still = vec![0.0; q.len()];
        let rates = [qd, qdd, if qddd.is_empty() { &still } else { qddd }].map(|rates| {
            let mut all = self.plan.no_rates();
            self.plan.set_rates(rates, &mut all);
            all
        });
        let rates = [&rates[0], &rates[1], &rates[2]].map(|all| self.rates(block, all));
        block.constraint.measure(k, &self.at(block, &instant), &rates)
    }

    /// Builds the error for a constraint that does not know its part of the jerk, from one of its
    /// rows.
    pub(crate) fn no_jerk(&self, row: usize) -> Error {
        let reason = format!(
            "Kin does not know how to compute the jerk of this constraint. To avoid this error, {}",
            Surface::chosen().no_jerk()
        );
        let [constraint, kind] = match self.block_of(row) {
            Some((block, _)) => [block.name.clone(), block.constraint.facts().kind.to_string()],
            None => Default::default(),
        };
        Error::InvalidConstraint { constraint, kind, reason }
    }
}
