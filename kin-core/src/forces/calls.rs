//! Computes the forces of a motion, and returns their quantities by name.

use std::sync::{Arc, OnceLock};

use super::acting::{Beside, Laid, Now};
use super::balance::{Balance, Energy, Powers};
use super::effort::{self, Drive};
use super::friction::Frictions;
use super::growth;
use super::inverse;
use super::multipliers::{AllMultipliers, TransposedSolver};
use super::reaction::{Reaction, Source};
use super::sum::{Sum, not_finite};
use crate::ask::solver::Solver;
use crate::outcome::error::surface::Surface;
use crate::outcome::error::{Error, Result};
use crate::solve::motion::{EngineCounts, Motion};
use crate::solve::options::Engine;
use crate::system::System;

/// The forces of a motion: reactions of constraints, efforts of drivers, forces of loads, energies,
/// and the balance of powers.
pub struct Forces<'a> {
    pub(super) system: &'a System,
    pub(super) motion: &'a Motion,
    pub(super) multipliers: AllMultipliers,
    pub(super) loads: Vec<(&'a str, Laid<'a>)>,
    pub(super) frictions: Frictions,
    /// Computed at the first use.
    energy: OnceLock<Energy>,
    balance: Balance,
    engine: EngineCounts,
    plain: Option<Arc<str>>,
}

impl System {
    /// Returns the names of the loads, in the order in which the program added them.
    pub fn load_names(&self) -> Vec<&str> {
        self.loads.loads.iter().map(|(name, _)| name.as_str()).collect()
    }

    /// Returns true if the mechanism has a mass or a load, so that [`System::forces`] has a result.
    pub fn has_forces(&self) -> bool {
        !self.loads.is_empty()
    }

    /// Computes the forces of a motion of this system: C_qᵀ λ = Q_e + Q_v − M q̈, with one
    /// transposed solve for each time.
    ///
    /// [`crate::Mechanism::mass`] sets masses, [`crate::Mechanism::gravity`] sets the acceleration
    /// of gravity, and [`crate::Mechanism::load`] adds other loads. For many times Kin uses a
    /// compiled program if possible ([`Forces::engine`]).
    ///
    /// Errors:
    ///
    /// * the mechanism has no masses and no loads;
    /// * the motion belongs to another system;
    /// * the motion has a singular position, where forces have no bound;
    /// * a load is not finite;
    /// * friction jams the mechanism ([`crate::error::Jammed`]);
    /// * friction depends on a force that is not unique.
    pub fn forces<'a>(&'a self, motion: &'a Motion) -> Result<Forces<'a>> {
        self.solver().forces(motion)
    }
}

impl<'a> Solver<'a> {
    /// Computes the forces of a motion of this system ([`System::forces`]) with the options of this
    /// solver.
    ///
    /// [`crate::SolverOptions::sharing`] sets the rule for redundant constraints.
    ///
    /// [`Engine::StepByStep`] assembles and solves one time after the other. [`Engine::Compiled`]
    /// compiles one program from masses, loads and the transposed solve, and runs the program for
    /// several times at once. [`Engine::Auto`] uses the compiled program if it saves time. The
    /// results of both engines differ in the last digits.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # use kin::{Engine, SolverOptions};
    /// # fn main() -> kin::Result<()> {
    /// # let mut m = Mechanism::new("arm");
    /// # let arm = m.link("arm", 0.5)?;
    /// # m.mass(arm, 1.2, vec2(0.1, 0.0), 0.03)?;
    /// # m.gravity(vec2(0.0, -9.81));
    /// # m.add("O", revolute(m.ground(), arm, vec2(0.0, 0.0), arm.start()))?;
    /// # m.add("motor", drive_angle(arm, Law::ramp(2.0)))?;
    /// # let system = m.build()?;
    /// let motion = system.run(linspace(0.0, 1.0, 101))?;
    /// let solver = system.solver().options(SolverOptions::new().engine(Engine::StepByStep));
    /// let forces = solver.forces(&motion)?;
    /// assert_eq!(forces.engine().compiled, 0);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Errors: those of [`System::forces`]; an equation of the sharing rule cannot be left out (the
    /// error names the equation). With [`Engine::Compiled`] the call also returns an error if Kin
    /// cannot compile a program. The causes are friction, redundant equations, a load that is a
    /// closure, and a constraint without a formula; the error names the cause.
    pub fn forces(&self, motion: &'a Motion) -> Result<Forces<'a>> {
        let system = self.system;
        system.own_as_it_is(motion)?;
        if !system.has_forces() {
            return Err(Error::InvalidParameters {
                constraint: system.name().to_string(),
                kind: "forces".to_string(),
                reason: format!(
                    "no body of the mechanism has mass, and no load acts. Add masses and loads {}",
                    Surface::chosen().loads()
                ),
            });
        }
        let mut forces = Walk::new(system, motion)?.by(self.options.engine)?;
        forces.share(&self.options.sharing)?;
        Ok(forces)
    }
}

/// The λ of a program and of the walk differ by less than this share of the largest one.   \[-\]
const SAME: f64 = 1e-8;
const OTHERS: &str =
    "the compiled forces differ from the forces of the equations at the first time";

/// The forces of a motion during their computation.
struct Walk<'a> {
    system: &'a System,
    motion: &'a Motion,
    loads: Vec<(&'a str, Laid<'a>)>,
    frictions: Frictions,
    multipliers: AllMultipliers,
    powers: Powers,
}

impl<'a> Walk<'a> {
    fn new(system: &'a System, motion: &'a Motion) -> Result<Self> {
        let loads = Laid::all(system, motion)?;
        let frictions = Frictions::new(system)?;
        let multipliers = AllMultipliers::new(system.n_equations(), motion.len());
        Ok(Walk {
            system,
            motion,
            loads,
            frictions,
            multipliers,
            powers: Powers::new(motion.len()),
        })
    }

    /// Computes the forces with a program if it is requested or faster, and the remaining times one
    /// by one.
    fn by(mut self, engine: Engine) -> Result<Forces<'a>> {
        let system = self.system;
        let motion = self.motion;
        let mut counts = EngineCounts::default();
        let mut plain = None;
        let pays = engine == Engine::Auto && inverse::pays(motion);
        let found =
            if pays || engine == Engine::Compiled { self.compiled()? } else { Err(String::new()) };
        match found {
            Ok(left) => {
                counts.compiled = motion.len() - left.len();
                counts.handed_back = left.len() - 1;
                self.walk(&left[1..])?;
            }
            Err(reason) if engine == Engine::Compiled => {
                let reason = format!(
                    "{reason}. To let Kin choose the engine, {}",
                    Surface::chosen().any_engine_of_forces()
                );
                return Err(Error::InvalidOptions { reason });
            }
            Err(reason) => {
                plain = pays.then(|| reason.into());
                self.walk(&(0..motion.len()).collect::<Vec<usize>>())?;
            }
        }
        let Walk { loads, frictions, multipliers, powers, .. } = self;
        let energy = OnceLock::new();
        let balance = powers.balance(motion);
        Ok(Forces {
            system,
            motion,
            multipliers,
            loads,
            frictions,
            energy,
            balance,
            engine: counts,
            plain,
        })
    }

    /// Runs a program. Returns the times that remain and the first time, which is known already and
    /// must have the same λ in the program. Returns the reason if there is no program.
    fn compiled(&mut self) -> Result<std::result::Result<Vec<usize>, String>> {
        let found = (self.multipliers.all(), &mut self.powers);
        let left = match inverse::fill(self.system, self.motion, &self.loads, found) {
            Ok(left) => left,
            Err(refusal) => return Ok(Err(refusal.to_string())),
        };
        let own = self.multipliers.at(0).to_vec();
        self.walk(&[0])?;
        let largest = self.multipliers.at(0).iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let far = |(a, b): (&f64, &f64)| (a - b).abs() > SAME * largest;
        let begins_there = left.first() != Some(&0);
        if begins_there && own.iter().zip(self.multipliers.at(0)).any(far) {
            return Ok(Err(OTHERS.to_string()));
        }
        Ok(Ok([0].into_iter().chain(left.into_iter().filter(|k| *k != 0)).collect()))
    }

    /// Computes some times, one after the other.
    fn walk(&mut self, times: &[usize]) -> Result<()> {
        let system = self.system;
        let motion = self.motion;
        let points = Beside::points(self.system);
        let mut solver = TransposedSolver::new(system);
        let mut sum = Sum::new(system, &self.loads, &points);
        for &k in times {
            let t = motion.times()[k];
            let now = Now { t, q: motion.q(k), qd: motion.qd(k), qdd: motion.qdd(k) };
            let mut at = sum.at(now)?;
            let found = solver.solve(now, &sum.by_q);
            let mut found = found.map_err(|error| {
                growth::explained(system, motion, t, error, &mut |now| sum.generalised(now))
            })?;
            are_finite(system, &found.lambda, t)?;
            self.frictions.add(&solver, now, &mut found)?;
            are_finite(system, &found.lambda, t)?;
            at.drives = solver.power(&found.lambda);
            at.take_friction(&found.beside.rubs);
            self.powers.set(k, &at);
            self.multipliers.set(k, found);
        }
        Ok(())
    }
}

/// Returns an error with the name of the first equation whose λ is not finite.
fn are_finite(system: &System, lambda: &[f64], t: f64) -> Result<()> {
    match lambda.iter().position(|x| !x.is_finite()) {
        Some(bad) => Err(not_finite(system, &system.equations().equation(bad), t, lambda[bad])),
        None => Ok(()),
    }
}

impl<'a> Forces<'a> {
    /// Returns the motion to which the forces belong.
    pub fn motion(&self) -> &'a Motion {
        self.motion
    }

    /// Returns the number of times that a program has computed ([`Engine::Compiled`]), and the
    /// number of times that the program returned to the step-by-step solver.
    ///
    /// The program returns a time if a pivot is small or a number is not finite.
    pub fn engine(&self) -> EngineCounts {
        self.engine
    }

    /// Returns the reason why Kin computed all times one by one although a program would have been
    /// faster.
    ///
    /// The reason contains the name of the cause. Returns `None` if Kin used a program, or did not
    /// try to compile one.
    pub fn why_not_compiled(&self) -> Option<&str> {
        self.plain.as_deref()
    }

    /// Returns the name of the mechanism.
    pub(crate) fn mechanism_name(&self) -> &str {
        self.system.name()
    }

    /// Returns the force and torque of a constraint, such as a joint or a driver, on its bodies.
    ///
    /// Errors: no constraint has the name.
    pub fn reaction(&self, constraint: &str) -> Result<Reaction<'_>> {
        Ok(Reaction::new(self, constraint, vec![Source::Constraint(self.block(constraint)?)]))
    }

    /// Returns the force and torque of several constraints together, about the origin of a body.
    ///
    /// The sum over redundant constraints can be unique although the force of each constraint is
    /// not unique.
    ///
    /// Errors: no constraint has a name of the list; the list is empty.
    pub fn sum(
        &self,
        constraints: impl IntoIterator<Item = impl AsRef<str>>,
    ) -> Result<Reaction<'_>> {
        let names: Vec<String> =
            constraints.into_iter().map(|name| name.as_ref().to_string()).collect();
        let sources: Result<Vec<Source>> =
            names.iter().map(|name| Ok(Source::Constraint(self.block(name)?))).collect();
        if names.is_empty() {
            return Err(Error::EmptyName { what: "sum of constraints" });
        }
        Ok(Reaction::new(self, &names.join(" + "), sources?))
    }

    /// Returns the force and torque of all constraints, including drivers, on the ground: the
    /// shaking force and the shaking moment about the origin.
    ///
    /// Call [`Reaction::on`] with the ground as a planar or spatial body. The result includes
    /// friction in joints. The result does not include loads between a body and the ground.
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

    /// Returns the force and torque of the friction in a joint on its bodies, about the joint's
    /// point.
    ///
    /// The power of friction is the dissipated power, as a negative number. [`Forces::reaction`] of
    /// the joint contains only the normal forces.
    ///
    /// Errors: no joint with friction has the name.
    pub fn friction(&self, joint: &str) -> Result<Reaction<'_>> {
        let known = || self.frictions.all.iter().map(|rubbing| &rubbing.name);
        let number = known().position(|name| name == joint).ok_or_else(|| Error::UnknownName {
            what: "joint with friction",
            name: joint.to_string(),
            known: known().cloned().collect(),
        })?;
        Ok(Reaction::new(self, &format!("{joint}.friction"), vec![Source::Friction(number)]))
    }

    /// Returns the force and torque of a load on its bodies.
    ///
    /// Errors: no load has the name.
    pub fn load(&self, name: &str) -> Result<Reaction<'_>> {
        let number = self.loads.iter().position(|(known, _)| *known == name);
        let number = number.ok_or_else(|| Error::UnknownName {
            what: "load",
            name: name.to_string(),
            known: self.loads.iter().map(|(name, _)| name.to_string()).collect(),
        })?;
        Ok(Reaction::new(self, name, vec![Source::Load(number)]))
    }

    /// Returns the efforts of a driver and its power.
    ///
    /// Errors: no constraint has the name; the constraint is not a driver; an effort is not unique.
    pub fn drive(&self, name: &str) -> Result<Drive> {
        effort::drive(self, self.block(name)?)
    }

    /// Returns the names of all constraints, including drivers, in the order in which the program
    /// added them.
    ///
    /// The list omits the norm constraints of Euler parameters, which carry no force.
    pub fn constraints(&self) -> Vec<&str> {
        let blocks = self.system.equations().blocks.iter();
        let told = blocks.filter(|block| block.constraint.facts().kind != "euler_norm");
        told.map(|block| block.name.as_str()).collect()
    }

    /// Returns the names of the loads.
    pub fn loads(&self) -> Vec<&str> {
        self.loads.iter().map(|(name, _)| *name).collect()
    }

    /// Returns the names of the drivers.
    pub fn drives(&self) -> Vec<&str> {
        let blocks = self.system.equations().blocks.iter();
        blocks.filter(|block| block.drives).map(|block| block.name.as_str()).collect()
    }

    /// Returns the kinetic and potential energy.
    pub fn energy(&self) -> &Energy {
        self.energy.get_or_init(|| Energy::along(self.system, self.motion, &self.loads))
    }

    /// Returns the balance of powers: the power of drivers, loads and friction, compared with
    /// dT/dt.
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

    /// Returns the constraints that share what is not unique at time k, from the vectors of the
    /// null space that change it.
    pub(super) fn sharing(&self, k: usize, is_in_it: impl Fn(usize) -> bool) -> Vec<String> {
        self.multipliers.beside(k).sharing(self.system, is_in_it)
    }

    /// Returns the values of C_q of one constraint at time k.
    pub(super) fn jacobian(&self, block: usize, k: usize) -> Vec<f64> {
        let equations = self.system.equations();
        let motion = self.motion;
        let block = &equations.blocks[block];
        let mut values: Vec<f64> = equations.constants[block.values()]
            .iter()
            .map(|constant| constant.unwrap_or(0.0))
            .collect();
        let instant = equations.instant_at(motion.times()[k], motion.q(k));
        block.constraint.jacobian(&equations.at(block, &instant), &mut values);
        values
    }
}
