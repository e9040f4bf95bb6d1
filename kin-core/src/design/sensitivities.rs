//! Differentiates q, q̇ and q̈ by parameters, with one solve for each order with the factors of
//! C_q.

use super::along::Prepared;
use super::solver::SlopeSolver;
use super::{smooth, variation};
use crate::outcome::error::{Error, Result};
use crate::solve::motion::Motion;
use crate::system::System;

/// The derivatives of a motion by some parameters, at fixed times.
pub struct Sensitivities<'a> {
    pub(super) system: &'a System,
    pub(super) motion: &'a Motion,
    all: Vec<Sensitivity>,
    compiled: usize,
}

/// The derivatives of q, q̇ and q̈ by one parameter, at each time of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    name: String,
    n: usize,
    orders: [Vec<f64>; 3],
}

impl System {
    /// Returns the exact derivatives of q, q̇ and q̈ of a motion by each parameter, at fixed times.
    ///
    /// The names are those of [`System::parameters`]. Kin uses no finite differences: C(q(t, p), t,
    /// p) = 0 and its first two time derivatives give
    ///
    /// ```text
    /// C_q q_p = −C_p      C_q q̇_p = −Ċ_p − Ċ_q q_p      C_q q̈_p = −C̈_p − 2 Ċ_q q̇_p − C̈_q q_p
    /// ```
    ///
    /// (Haug, *Computer Aided Kinematics and Dynamics*, 1989, contains the first; the others are
    /// its derivatives.)
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("crank");
    /// let crank = m.link("crank", 1.0)?;
    /// m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start()))?;
    /// m.add("motor", drive_angle(crank, Law::ramp(3.0)))?;
    /// let system = m.build()?;
    /// let motion = system.run([0.0, 0.5])?;
    /// let by_rate = system.sensitivities(&motion, ["motor.law.rate"])?;
    /// assert_eq!(by_rate.all()[0].q(1)[2], 0.5); // θ = ω t
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Errors, each of which names the cause:
    ///
    /// * no parameter has the name, or no equation depends on the parameter;
    /// * the mechanism has constraints on the dual route, hand-written constraints, or laws with an
    ///   unknown derivative;
    /// * the mechanism is redundant and closes at one value of the parameter only;
    /// * the motion has a singular position, or a kink or a break of a law at one of its times;
    /// * the motion belongs to another system.
    pub fn sensitivities<'a>(
        &'a self,
        motion: &'a Motion,
        names: impl IntoIterator<Item = impl AsRef<str>>,
    ) -> Result<Sensitivities<'a>> {
        self.own_as_it_is(motion)?;
        let names: Vec<String> = names.into_iter().map(|name| name.as_ref().to_string()).collect();
        smooth::check(self, motion, names.first().map_or("", String::as_str))?;
        let mut prepared = Prepared::new(self, &names)?;
        let n = self.n_coordinates();
        // NaN until they are written.
        let list = || vec![f64::NAN; n * motion.len()];
        let empty =
            |name: &String| Sensitivity { name: name.clone(), n, orders: [list(), list(), list()] };
        let mut all: Vec<Sensitivity> = names.iter().map(empty).collect();
        let lists =
            all.iter_mut().flat_map(|one| one.orders.iter_mut().map(Vec::as_mut_slice)).collect();
        let left = variation::pays(motion).then(|| variation::forward(&prepared, motion, lists));
        let left = left.flatten().unwrap_or_else(|| (0..motion.len()).collect());
        let compiled = motion.len() - left.len();
        let mut solver = SlopeSolver::new(self);
        for k in left {
            let t = motion.times()[k];
            let orders = [motion.q(k), motion.qd(k), motion.qdd(k)];
            let along = prepared.at(t, orders);
            solver.go_to(t, orders)?;
            for (name, one) in all.iter_mut().enumerate() {
                let orders = solver.forward(&prepared, &along, (name, &one.name))?;
                for (all, own) in one.orders.iter_mut().zip(orders) {
                    all[k * n..][..n].copy_from_slice(&own);
                }
            }
        }
        Ok(Sensitivities { system: self, motion, all, compiled })
    }
}

impl Sensitivities<'_> {
    /// Returns the derivatives by each parameter, in the order of the names.
    pub fn all(&self) -> &[Sensitivity] {
        &self.all
    }

    /// Returns the number of times that a tape of the whole mechanism has computed, several times
    /// at once.
    ///
    /// Kin computes the other times one after the other: for motions of a few times, for redundant
    /// mechanisms, near singular positions, and on machines without SIMD.
    pub fn compiled(&self) -> usize {
        self.compiled
    }

    /// Returns the derivatives by one parameter.
    ///
    /// Errors: the program did not request the derivatives by this name.
    pub fn by(&self, name: &str) -> Result<&Sensitivity> {
        self.all.iter().find(|one| one.name == name).ok_or_else(|| Error::UnknownName {
            what: "parameter among the requested ones",
            name: name.to_string(),
            known: self.all.iter().map(|one| one.name.clone()).collect(),
        })
    }
}

impl Sensitivity {
    /// Returns the name of the parameter.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns ∂q/∂p at time k, in the order of the coordinates. \[unit of q per unit of p\]
    ///
    /// The slice is empty if k is beyond the last time.
    pub fn q(&self, k: usize) -> &[f64] {
        self.row(0, k)
    }

    /// Returns ∂q̇/∂p at time k. \[unit of q̇ per unit of p\]
    ///
    /// The slice is empty if k is beyond the last time.
    pub fn qd(&self, k: usize) -> &[f64] {
        self.row(1, k)
    }

    /// Returns ∂q̈/∂p at time k. \[unit of q̈ per unit of p\]
    ///
    /// The slice is empty if k is beyond the last time.
    pub fn qdd(&self, k: usize) -> &[f64] {
        self.row(2, k)
    }

    fn row(&self, order: usize, k: usize) -> &[f64] {
        let first = k.saturating_mul(self.n);
        self.orders[order].get(first..first.saturating_add(self.n)).unwrap_or_default()
    }
}
