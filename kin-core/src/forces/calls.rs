//! The forces of a motion, and what can be asked of them by name.

use super::acting::{Beside, Laid, Now, scatter};
use super::balance::{Balance, Energy, Powers};
use super::body::{self, Moved};
use super::effort::{self, Drive};
use super::friction::{Frictions, Rub};
use super::growth;
use super::multipliers::{Multipliers, Solver};
use super::reaction::{Reaction, Source};
use super::sharing::Sharing;
use crate::model::error::{Error, Result};
use crate::model::layout::Kind;
use crate::solve::motion::Motion;
use crate::system::System;

/// The forces of a motion: of each constraint the force and torque that it puts on its bodies, of each driver
/// what it must give, of each load what it does; energies, and the balance of powers.
pub struct Forces<'a> {
    pub(super) system: &'a System,
    pub(super) motion: &'a Motion,
    /// λ, time by time.
    pub(super) multipliers: Vec<Multipliers>,
    pub(super) loads: Vec<(&'a str, Laid<'a>)>,
    pub(super) frictions: Frictions,
    energy: Energy,
    balance: Balance,
}

impl System {
    /// Names of its loads, in the order of adding.
    pub fn load_names(&self) -> Vec<&str> {
        self.loads.loads.iter().map(|(name, _)| name.as_str()).collect()
    }

    /// The forces of a motion of this system: C_qᵀ λ = Q_e + Q_v − M q̈, one transposed solve a time with the
    /// matrix that the motion was computed with. Masses are given by [`crate::Mechanism::mass`], weight by
    /// [`crate::Mechanism::gravity`], other loads by [`crate::Mechanism::load`].
    ///
    /// Errors: a mechanism in which nothing has mass and nothing acts; a motion of another system; a singular
    /// position, where forces have no bound; a load that is not finite; a mechanism that is jammed by
    /// friction ([`crate::Jammed`]), friction on a force that is not unique.
    pub fn forces<'a>(&'a self, motion: &'a Motion) -> Result<Forces<'a>> {
        self.forces_with(motion, &Sharing::NotGiven)
    }

    /// The same, where redundant constraints share forces by a rule.
    ///
    /// Errors: those of [`System::forces`]; equations that cannot be left out, by name.
    pub fn forces_with<'a>(&'a self, motion: &'a Motion, sharing: &Sharing) -> Result<Forces<'a>> {
        self.own(motion)?;
        if self.loads.is_empty() {
            return Err(Error::InvalidParameters {
                constraint: self.name().to_string(),
                kind: "forces".to_string(),
                reason: "nothing has mass and nothing acts; give masses by `m.mass(…)`, loads by `m.load(…)`"
                    .to_string(),
            });
        }
        let (loads, points) = (Laid::all(self), Beside::points(self));
        let frictions = Frictions::new(self)?;
        let (mut solver, mut multipliers) = (Solver::new(self), Vec::with_capacity(motion.len()));
        let mut powers = Powers::new(motion.len());
        let mut sum = Sum::new(self, &loads, &points);
        for (k, &t) in motion.times().iter().enumerate() {
            let now = Now { t, q: motion.q(k), qd: motion.qd(k), qdd: motion.qdd(k) };
            let mut at = sum.at(now)?;
            let found = solver.solve(now, &sum.by_q);
            let mut found = found.map_err(|error| {
                growth::explained(self, motion, t, error, &mut |now| sum.generalised(now))
            })?;
            self.are_finite(&found.lambda, t)?;
            frictions.add(&solver, now, &mut found)?;
            self.are_finite(&found.lambda, t)?;
            at.drives = solver.power(&found.lambda);
            at.take_friction(&found.rubs);
            powers.push(at);
            multipliers.push(found);
        }
        let (energy, balance) = powers.energy_and_balance(motion);
        let mut forces = Forces { system: self, motion, multipliers, loads, frictions, energy, balance };
        forces.share(sharing)?;
        Ok(forces)
    }

    /// An error that names the first equation whose λ is no finite number.
    fn are_finite(&self, lambda: &[f64], t: f64) -> Result<()> {
        match lambda.iter().position(|x| !x.is_finite()) {
            Some(bad) => Err(not_finite(self, &self.equations().equation(bad), t, lambda[bad])),
            None => Ok(()),
        }
    }
}

/// Generalised forces of everything but constraints, and their powers.
pub(super) struct Sum<'a> {
    system: &'a System,
    loads: &'a [(&'a str, Laid<'a>)],
    points: &'a [(&'a str, Beside<'a>, f64)],
    /// Q_e + Q_v − M q̈.
    by_q: Vec<f64>,
    /// Those of one load.
    own: Vec<f64>,
}

/// Energies and powers at one time.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct At {
    pub kinetic: f64,
    pub potential: f64,
    /// dT/dt, by differentiating T.
    pub rate: f64,
    pub drives: f64,
    pub loads: f64,
    pub weight: f64,
    pub friction: f64,
    /// The largest power of any of the forces on any coordinate.
    pub largest: f64,
}

impl At {
    fn take_friction(&mut self, rubs: &[Rub]) {
        for power in rubs.iter().map(|rub| rub.amount * rub.rate) {
            self.friction += power;
            self.raise(power);
        }
    }

    fn raise(&mut self, power: f64) {
        self.largest = self.largest.max(power.abs());
    }
}

impl<'a> Sum<'a> {
    pub(super) fn new(
        system: &'a System,
        loads: &'a [(&'a str, Laid<'a>)],
        points: &'a [(&'a str, Beside<'a>, f64)],
    ) -> Self {
        Sum { system, loads, points, by_q: Vec::new(), own: Vec::new() }
    }

    /// Q_e + Q_v − M q̈ at one time. Errors: a load that is not finite.
    pub(super) fn generalised(&mut self, now: Now<'_>) -> Result<Vec<f64>> {
        self.at(now)?;
        Ok(self.by_q.clone())
    }

    /// All of it at one time. Errors: a load that is not finite.
    fn at(&mut self, now: Now<'_>) -> Result<At> {
        let mut at = At::default();
        self.by_q.clear();
        self.by_q.resize(now.q.len(), 0.0);
        self.bodies(now, &mut at);
        self.weigh_points(now, &mut at)?;
        for (name, load) in self.loads {
            let (own, qd) = (&mut self.own, now.qd);
            own.clear();
            own.resize(qd.len(), 0.0);
            load.add(now, own);
            if let Some(bad) = own.iter().find(|x| !x.is_finite()) {
                return Err(not_finite(self.system, name, now.t, *bad));
            }
            for power in own.iter().zip(qd).map(|(q, qd)| q * qd) {
                at.loads += power;
                at.raise(power);
            }
            at.potential += load.energy(now);
            self.by_q.iter_mut().zip(own.iter()).for_each(|(all, own)| *all += own);
        }
        Ok(at)
    }

    fn bodies(&mut self, now: Now<'_>, at: &mut At) {
        let loads = &self.system.loads;
        for (item, solid) in &loads.solids {
            let Some(item) = self.system.layout().items.get(*item) else { continue };
            match item.kind {
                Kind::Planar => {
                    let Some(moved) = moved::<3>(now, item.first) else { continue };
                    self.take(item.first, &body::planar(solid, loads.gravity, moved), now, at)
                }
                Kind::Spatial => {
                    let Some(moved) = moved::<7>(now, item.first) else { continue };
                    self.take(item.first, &body::spatial(solid, loads.gravity, moved), now, at)
                }
                Kind::Angle | Kind::Length => {}
            }
        }
    }

    fn take<const N: usize>(&mut self, first: usize, body: &body::Body<N>, now: Now<'_>, at: &mut At) {
        for k in 0..N {
            self.by_q[first + k] += body.weight[k] - body.inertial[k];
            let rate = now.qd[first + k];
            at.weight += body.weight[k] * rate;
            at.raise(body.weight[k] * rate);
            at.raise(body.inertial[k] * rate);
        }
        at.kinetic += body.kinetic[0];
        at.rate += body.kinetic[1];
        at.potential += body.potential;
    }

    /// Points with mass: Q = −m r_qᵀ (r̈ − g).
    fn weigh_points(&mut self, now: Now<'_>, at: &mut At) -> Result<()> {
        let gravity = self.system.loads.gravity;
        for (name, point, mass) in self.points {
            let valued = point.valued(now);
            let of = |values: &[f64], f: &dyn Fn(usize, f64) -> f64| -> f64 {
                values.iter().enumerate().map(|(k, x)| f(k, *x)).sum()
            };
            let force: Vec<f64> =
                valued.second.iter().zip(gravity).map(|(second, g)| mass * (g - second)).collect();
            if let Some(bad) = force.iter().find(|x| !x.is_finite()) {
                return Err(not_finite(self.system, name, now.t, *bad));
            }
            scatter(&point.columns, &point.along(&valued, &force), &mut self.by_q);
            at.kinetic += 0.5 * mass * of(&valued.rate, &|_, v| v * v);
            at.rate += mass * of(&valued.rate, &|k, v| v * valued.second[k]);
            at.weight += mass * of(&valued.rate, &|k, v| v * gravity[k]);
            at.potential -= mass * of(&valued.c, &|k, r| r * gravity[k]);
            force.iter().zip(&valued.rate).for_each(|(f, v)| at.raise(f * v));
        }
        Ok(())
    }
}

/// The coordinates of a body from number `first` on.
fn moved<const N: usize>(now: Now<'_>, first: usize) -> Option<Moved<'_, N>> {
    let [q, qd, qdd] = [now.q, now.qd, now.qdd].map(|all| all.get(first..)?.first_chunk());
    Some(Moved { q: q?, qd: qd?, qdd: qdd? })
}

fn not_finite(system: &System, name: &str, t: f64, value: f64) -> Error {
    Error::OutputNotFinite {
        output: format!("force of `{name}`"),
        t,
        units: system.unit_words().clone(),
        value,
    }
}

impl<'a> Forces<'a> {
    /// The motion that they belong to.
    pub fn motion(&self) -> &'a Motion {
        self.motion
    }

    /// The name of the mechanism.
    pub(crate) fn mechanism_name(&self) -> &str {
        self.system.name()
    }

    /// Force and torque of a constraint on its bodies; of a driver too.
    ///
    /// Errors: a name that no constraint has.
    pub fn reaction(&self, constraint: &str) -> Result<Reaction<'_>> {
        Ok(Reaction::new(self, constraint, vec![Source::Constraint(self.block(constraint)?)]))
    }

    /// Force and torque of several constraints together, about a body's origin: of redundant ones the sum can
    /// be unique where none of them is.
    ///
    /// Errors: a name that no constraint has; no name at all.
    pub fn sum(&self, constraints: impl IntoIterator<Item = impl AsRef<str>>) -> Result<Reaction<'_>> {
        let names: Vec<String> = constraints.into_iter().map(|name| name.as_ref().to_string()).collect();
        let sources: Result<Vec<Source>> =
            names.iter().map(|name| Ok(Source::Constraint(self.block(name)?))).collect();
        if names.is_empty() {
            return Err(Error::EmptyName { what: "sum of constraints" });
        }
        Ok(Reaction::new(self, &names.join(" + "), sources?))
    }

    /// Force and torque of all constraints, drivers among them, on the ground: asked on a planar or spatial
    /// body that is the ground, the shaking force, and the shaking moment about the origin. Friction in
    /// joints is in it, loads between a body and the ground are not.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # fn main() -> kin::Result<()> {
    /// # let mut m = Mechanism::new("arm");
    /// # let arm = m.link("arm", 0.5)?;
    /// # m.mass(arm, 1.2, vec2(0.1, 0.0), 0.03)?;
    /// # m.add("O", revolute(m.ground(), arm, vec2(0.0, 0.0), arm.start()))?;
    /// # m.add("motor", drive_angle(arm, Law::ramp(2.0)))?;
    /// # let ground = m.ground();
    /// # let system = m.build()?;
    /// # let motion = system.run([0.0, 0.1])?;
    /// # let forces = system.forces(&motion)?;
    /// let shaking = forces.on_ground().on(PlanarBody::from(ground))?;
    /// assert!((shaking.magnitude()?.max() - 1.2 * 0.35 * 4.0).abs() < 1e-12); // m r ω²
    /// # Ok(())
    /// # }
    /// ```
    pub fn on_ground(&self) -> Reaction<'_> {
        let all = (0..self.system.equations().blocks.len()).map(Source::Constraint);
        let friction = (0..self.frictions.all.len()).map(Source::Friction);
        Reaction::new(self, "all constraints", all.chain(friction).collect())
    }

    /// Force and torque of the friction in a joint on its bodies, about the joint's point; its power is what
    /// is lost as heat, negative. [`Forces::reaction`] of the joint is without it: the normal forces.
    ///
    /// Errors: a name that no joint with friction has.
    pub fn friction(&self, joint: &str) -> Result<Reaction<'_>> {
        let known = || self.frictions.all.iter().map(|rubbing| &rubbing.name);
        let number = known().position(|name| name == joint).ok_or_else(|| Error::UnknownName {
            what: "joint with friction",
            name: joint.to_string(),
            known: known().cloned().collect(),
        })?;
        Ok(Reaction::new(self, &format!("{joint}.friction"), vec![Source::Friction(number)]))
    }

    /// Force and torque of a load on its bodies.
    ///
    /// Errors: a name that no load has.
    pub fn load(&self, name: &str) -> Result<Reaction<'_>> {
        let number = self.loads.iter().position(|(known, _)| *known == name);
        let number = number.ok_or_else(|| Error::UnknownName {
            what: "load",
            name: name.to_string(),
            known: self.loads.iter().map(|(name, _)| name.to_string()).collect(),
        })?;
        Ok(Reaction::new(self, name, vec![Source::Load(number)]))
    }

    /// The force or torque that a driving constraint must give, and its power.
    ///
    /// Errors: a name that no constraint has, a constraint that drives nothing; an effort that is not unique.
    pub fn drive(&self, name: &str) -> Result<Drive> {
        effort::drive(self, self.block(name)?)
    }

    /// Names of all constraints, drivers among them, in the order of adding; of each spatial body the row by
    /// which its Euler parameters stay normalised, which holds nothing, is not one of them.
    pub fn constraints(&self) -> Vec<&str> {
        let blocks = self.system.equations().blocks.iter();
        let told = blocks.filter(|block| block.constraint.facts().kind != "euler_norm");
        told.map(|block| block.name.as_str()).collect()
    }

    /// Names of the loads.
    pub fn loads(&self) -> Vec<&str> {
        self.loads.iter().map(|(name, _)| *name).collect()
    }

    /// Names of the constraints that drive.
    pub fn drives(&self) -> Vec<&str> {
        let blocks = self.system.equations().blocks.iter();
        blocks.filter(|block| block.drives).map(|block| block.name.as_str()).collect()
    }

    /// Kinetic and potential energy.
    pub fn energy(&self) -> &Energy {
        &self.energy
    }

    /// The balance of powers, which is always made: drives and loads against the rate of the kinetic energy,
    /// differentiated from T.
    pub fn balance(&self) -> &Balance {
        &self.balance
    }

    fn block(&self, name: &str) -> Result<usize> {
        let blocks = &self.system.equations().blocks;
        blocks.iter().position(|block| block.name == name).ok_or_else(|| Error::UnknownName {
            what: "constraint",
            name: name.to_string(),
            known: blocks.iter().map(|block| block.name.clone()).collect(),
        })
    }

    /// The constraints that share what is not unique at time k.
    pub(super) fn sharing(&self, k: usize) -> Vec<String> {
        self.multipliers[k].sharing(self.system)
    }

    /// The values of C_q of one constraint at time k.
    pub(super) fn jacobian(&self, block: usize, k: usize) -> Vec<f64> {
        let (equations, motion) = (self.system.equations(), self.motion);
        let block = &equations.blocks[block];
        let mut values: Vec<f64> =
            equations.constants[block.values()].iter().map(|constant| constant.unwrap_or(0.0)).collect();
        let instant = equations.instant_at(motion.times()[k], motion.q(k));
        block.constraint.jacobian(&equations.at(block, &instant), &mut values);
        values
    }
}
