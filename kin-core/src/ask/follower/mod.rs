//! A follower: the position of a mechanism by values of its drivers instead of by time.

mod configuration;
pub(in crate::ask) mod dead_centre;
mod drivers;
mod frozen;
mod map;
mod moved;
mod path;
mod prescribed;
mod roles;
mod small;

use crate::ask::solver::Solver;
use crate::law::Law;
use crate::outcome::error::{Error, Result};
use crate::outcome::motion::Motion;
use crate::outcome::named_value::NamedValue;
use crate::solve::newton::Outcome;
use crate::solve::options::SolverOptions;
use crate::system::{Solution, System, time};

pub use configuration::Configuration;
pub use dead_centre::Start;
use drivers::Driver;
pub use map::{Map, Mapped};
use small::Small;

/// Stands on one branch of a mechanism and moves along it by values of its drivers.
///
/// A driver is a law whose argument is time. Its value is one number of the follower: `motor`, or
/// `motor.LAW` if the constraint has several such laws. A call of [`Follower::to`] moves the values
/// along the straight line from where they are, over any distance, and checks the way as a run
/// does. So the path defines the branch. If the way leads to a toggle the follower stops there.
///
/// Time elsewhere in an equation stands still; [`Follower::frozen`] lists these constraints.
///
/// ```
/// use kin::prelude::*;
///
/// # fn main() -> kin::Result<()> {
/// let mut m = Mechanism::new("crank");
/// let crank = m.link("crank", 0.4)?;
/// m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
/// m.add("motor", drive_angle(crank, Law::ramp(2.0)))?;
/// let system = m.build()?;
///
/// let mut follower = system.follower(0.0)?;
/// let here = follower.to([("motor", 0.63)])?;
/// assert_eq!(here.coordinate("crank.theta"), Some(0.63));
/// # Ok(())
/// # }
/// ```
pub struct Follower {
    /// The system, with laws of a path parameter in place of those of time. At 0 they have the
    /// present values. No other follower shares these laws.
    pub(in crate::ask) system: System,
    pub(in crate::ask) options: SolverOptions,
    t0: f64,
    drivers: Vec<Driver>,
    frozen: Vec<String>,
    /// The present position. \[m, rad\]
    pub(in crate::ask) q: Vec<f64>,
    /// Where the next move begins instead, if the present position is singular.
    regular: Option<Regular>,
    /// The mechanism with all of its drivers, if other values are given instead of them.
    whole: Option<Box<Whole>>,
    /// The solver of small steps, if the last move was one.
    small: Small,
}

/// A mechanism with all of its drivers at rest. Time stands still in all other constraints.
#[derive(Debug)]
struct Whole {
    system: System,
    drivers: Vec<Driver>,
}

impl Clone for Whole {
    fn clone(&self) -> Self {
        Whole::of(&self.system, &self.drivers)
    }
}

impl Clone for Follower {
    fn clone(&self) -> Self {
        let Whole { system, drivers } = Whole::of(&self.system, &self.drivers);
        Follower {
            system,
            options: self.options.clone(),
            t0: self.t0,
            drivers,
            frozen: self.frozen.clone(),
            q: self.q.clone(),
            regular: self.regular.clone(),
            whole: self.whole.clone(),
            small: Small::default(),
        }
    }
}

impl std::fmt::Debug for Follower {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Follower")
            .field("system", &self.system)
            .field("drivers", &self.drivers())
            .field("q", &self.q)
            .finish()
    }
}

impl Whole {
    /// Returns a copy with laws that it shares with no other system.
    fn of(system: &System, drivers: &[Driver]) -> Self {
        let mut system = system.clone();
        let mut drivers = drivers.to_vec();
        drivers::install(&mut drivers, &mut system);
        Whole { system, drivers }
    }
}

/// A position shortly before a singular one.
#[derive(Clone, Debug)]
struct Regular {
    values: Vec<f64>,
    q: Vec<f64>,
}

impl System {
    /// Returns a follower on the branch of the assembled position at time t0.
    ///
    /// Errors: those of [`System::position`]; no law of time drives the mechanism.
    pub fn follower(&self, t0: f64) -> Result<Follower> {
        self.solver().follower(t0)
    }
}

impl Solver<'_> {
    /// Returns a follower on the branch of the assembled position at time t0, as
    /// [`System::follower`] does. The options count for each move of the follower.
    ///
    /// Errors: those of [`Solver::position`]; no law of time drives the mechanism.
    pub fn follower(&self, t0: f64) -> Result<Follower> {
        let t0 = time(t0)?;
        let Solution { q, .. } = self.position(t0)?;
        let mut system = self.system.clone();
        let (drivers, frozen) = drivers::take(&mut system, t0, &q);
        if drivers.is_empty() {
            return Err(Error::InvalidOptions {
                reason: format!(
                    "a follower moves drivers, but \"{}\" has no driver with a law of time. Drive a joint \
                     or coordinate with a law whose argument is time",
                    self.system.name()
                ),
            });
        }
        let options = self.options.clone();
        Ok(Follower {
            system,
            options,
            t0,
            drivers,
            frozen,
            q,
            regular: None,
            whole: None,
            small: Small::default(),
        })
    }
}

impl Follower {
    /// Moves the named drivers to these values, along the straight line from where they are. The
    /// other drivers stand still. Returns the configuration there.
    ///
    /// Errors: a name that no driver has, the same name twice, a value that is not finite; these
    /// leave the follower where it is. [`Error::CannotReach`]: a singular position is on the way.
    /// The follower then stands there, and can be moved back.
    pub fn to(
        &mut self,
        values: impl IntoIterator<Item = (impl AsRef<str>, f64)>,
    ) -> Result<Configuration<'_>> {
        let mut targets = std::mem::take(&mut self.small.targets);
        let moved = self.targets(values, &mut targets).and_then(|()| self.move_to(&targets));
        self.small.targets = targets;
        moved?;
        Ok(self.here())
    }

    /// Moves along a polyline: to each list of values in turn, as [`Follower::to`] does. Passes
    /// each configuration to `keep`.
    ///
    /// Errors: those of [`Follower::to`], with the follower where it stopped; those of `keep`.
    pub fn to_by<N: AsRef<str>>(
        &mut self,
        path: impl IntoIterator<Item = impl IntoIterator<Item = (N, f64)>>,
        mut keep: impl FnMut(Configuration<'_>) -> Result<()>,
    ) -> Result<()> {
        path.into_iter().try_for_each(|values| keep(self.to(values)?))
    }

    /// Returns the configuration where the follower is.
    pub fn here(&self) -> Configuration<'_> {
        Configuration { follower: self }
    }

    /// Returns the drivers with their present values.
    pub fn drivers(&self) -> Vec<NamedValue> {
        self.drivers.iter().map(|driver| driver.value.clone()).collect()
    }

    /// Returns the names of the constraints that read time in another way than by a law of time
    /// alone. Time stands at t0 in them.
    pub fn frozen(&self) -> &[String] {
        &self.frozen
    }

    /// Returns the time t0 of the follower. \[s\]
    pub fn t0(&self) -> f64 {
        self.t0
    }

    /// Returns q, q̇ and q̈ where the follower is, for given rates of the drivers: pairs of a name
    /// and \[u̇, ü\]. The other drivers are at rest.
    ///
    /// Errors: an unknown name, a rate that is not finite, a singular position.
    pub fn rates(
        &mut self,
        rates: impl IntoIterator<Item = (impl AsRef<str>, [f64; 2])>,
    ) -> Result<Solution> {
        let mut of_driver = vec![[0.0; 2]; self.drivers.len()];
        for (name, rate) in rates {
            let name = name.as_ref();
            let k = self.number(name)?;
            for (rate, what) in rate.iter().zip(["velocity", "acceleration"]) {
                self.check_finite(name, what, *rate)?;
            }
            of_driver[k] = rate;
        }
        for (driver, [speed, acceleration]) in self.drivers.iter().zip(of_driver) {
            driver.path.lead([driver.value.value, speed, 0.5 * acceleration]);
        }
        let mut found =
            self.system.solver().options(self.options.clone()).solve_at(0.0, &self.q)?;
        found.t = self.t0;
        Ok(found)
    }

    /// Returns the configuration as a motion of one time, with q̇ and q̈ for these rates of the
    /// drivers.
    pub(crate) fn moving(
        &mut self,
        rates: impl IntoIterator<Item = (impl AsRef<str>, [f64; 2])>,
    ) -> Result<Motion> {
        let Solution { q, qd, qdd, .. } = self.rates(rates)?;
        let mut motion = Motion::new(&self.system, 1);
        let outcome = Outcome { iterations: 0, residual: 0.0 };
        motion.append(0.0, [&q, &qd, &qdd, &[]], outcome, 0);
        Ok(motion)
    }

    /// Returns the system with the laws of the present values.
    pub(crate) fn system(&self) -> &System {
        &self.system
    }

    /// Returns the name of the constraint of each driver.
    pub(crate) fn constraints_of_drivers(&self) -> Vec<String> {
        let names = self.system.constraint_names();
        self.drivers.iter().map(|driver| names[driver.block].to_string()).collect()
    }

    /// Gives the named driver the value t at time t, and returns its present value. The other
    /// drivers are at rest.
    pub(in crate::ask) fn let_run(&mut self, name: &str) -> Result<NamedValue> {
        let k = self.number(name)?;
        self.drivers.iter().for_each(Driver::rest);
        self.drivers[k].path.lead([0.0, 1.0, 0.0]);
        Ok(self.drivers[k].value.clone())
    }

    /// Returns the system with these laws in place of those of the drivers.
    pub(in crate::ask) fn with_laws(&self, laws: &[Law]) -> System {
        let mut system = self.system.clone();
        for (driver, law) in self.drivers.iter().zip(laws) {
            driver.replace(&mut system, law);
        }
        system
    }

    /// Returns the laws of the drivers in the system from which the follower was made.
    pub(in crate::ask) fn laws_of(&self, system: &System) -> Vec<Option<Law>> {
        self.drivers.iter().map(|driver| driver.law(system, (self.t0, &self.q))).collect()
    }

    /// Writes the values of all drivers with the given ones changed.
    fn targets(
        &mut self,
        values: impl IntoIterator<Item = (impl AsRef<str>, f64)>,
        targets: &mut Vec<f64>,
    ) -> Result<()> {
        targets.clear();
        targets.extend(self.drivers.iter().map(|driver| driver.value.value));
        self.small.given.clear();
        self.small.given.resize(targets.len(), false);
        for (name, value) in values {
            let name = name.as_ref();
            let k = self.number(name)?;
            self.check_finite(name, "value", value)?;
            if std::mem::replace(&mut self.small.given[k], true) {
                return Err(Error::DuplicateName {
                    what: "values of a driver",
                    name: name.to_string(),
                });
            }
            targets[k] = value;
        }
        Ok(())
    }

    fn number(&self, name: &str) -> Result<usize> {
        let found = self.drivers.iter().position(|driver| driver.value.name == name);
        found.ok_or_else(|| Error::UnknownName {
            what: "driver",
            name: name.to_string(),
            known: self.drivers.iter().map(|driver| driver.value.name.clone()).collect(),
        })
    }

    fn check_finite(&self, name: &str, what: &str, value: f64) -> Result<()> {
        if value.is_finite() {
            return Ok(());
        }
        Err(Error::InitialNotFinite {
            name: name.to_string(),
            coordinate: format!("the {what}"),
            value,
        })
    }
}
