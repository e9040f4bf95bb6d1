//! Derivatives of q, q̇ and q̈ by parameters: one solve with the factors of C_q for each order.

use super::along::Prepared;
use super::solver::SlopeSolver;
use super::{smooth, variation};
use crate::model::error::{Error, Result};
use crate::solve::motion::Motion;
use crate::system::System;

/// Derivatives of a motion by some parameters, at fixed times.
pub struct Sensitivities<'a> {
    pub(super) system: &'a System,
    pub(super) motion: &'a Motion,
    all: Vec<Sensitivity>,
    compiled: usize,
}

/// Derivatives of q, q̇ and q̈ by one parameter, at each time of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    name: String,
    n: usize,
    orders: [Vec<f64>; 3],
}

impl System {
    /// How a motion of this system changes with parameters (their names are those of
    /// [`System::parameters`]): the derivatives of q, q̇ and q̈ by each of them at fixed times,
    /// exact and without differences. From C(q(t, p), t, p) = 0 and its first two derivatives by
    /// time,
    ///
    /// ```text
    /// C_q q_p = −C_p      C_q q̇_p = −Ċ_p − Ċ_q q_p      C_q q̈_p = −C̈_p − 2 Ċ_q q̇_p − C̈_q q_p
    /// ```
    ///
    /// (Haug, *Computer Aided Kinematics and Dynamics*, 1989, has the first; the others are its
    /// derivatives.)
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
    /// Errors, each by name: a name that is no parameter; a parameter on which nothing depends;
    /// constraints on the dual route or by hand, and laws whose derivative is not known; a
    /// redundant mechanism that closes at one value of the parameter only; a motion with a singular
    /// position, or with a kink or a break of a law at one of its times; a motion of another
    /// system.
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
        // Not numbers until they are written.
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
    /// Those by each parameter, in the order in which they were asked for.
    pub fn all(&self) -> &[Sensitivity] {
        &self.all
    }

    /// At how many times they come from a tape of the whole mechanism over several times at once;
    /// at the others from a walk over the equations, one time after the other: along motions of a
    /// few times, where the mechanism is redundant or near a singular position, and on machines
    /// without lanes.
    pub fn compiled(&self) -> usize {
        self.compiled
    }

    /// That by one parameter. Errors: a name that was not asked for.
    pub fn by(&self, name: &str) -> Result<&Sensitivity> {
        self.all.iter().find(|one| one.name == name).ok_or_else(|| Error::UnknownName {
            what: "parameter among those that were asked for",
            name: name.to_string(),
            known: self.all.iter().map(|one| one.name.clone()).collect(),
        })
    }
}

impl Sensitivity {
    /// The parameter.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// ∂q/∂p at time k, in the order of the coordinates; empty beyond the last time.   \[unit of q
    /// a unit of p\]
    pub fn q(&self, k: usize) -> &[f64] {
        self.row(0, k)
    }

    /// ∂q̇/∂p at time k; empty beyond the last time.   \[unit of q̇ a unit of p\]
    pub fn qd(&self, k: usize) -> &[f64] {
        self.row(1, k)
    }

    /// ∂q̈/∂p at time k; empty beyond the last time.   \[unit of q̈ a unit of p\]
    pub fn qdd(&self, k: usize) -> &[f64] {
        self.row(2, k)
    }

    fn row(&self, order: usize, k: usize) -> &[f64] {
        let first = k.saturating_mul(self.n);
        self.orders[order].get(first..first.saturating_add(self.n)).unwrap_or_default()
    }
}
