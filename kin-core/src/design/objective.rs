//! Computes a number of a motion as a function of dimensions, with its gradient, for optimisers.

use crate::ask::measure::Measure;
use crate::outcome::error::{Error, Result};
use crate::solve::motion::Quantity;
use crate::solve::run::times;
use crate::system::System;

/// A function p → (value, gradient) of dimensions and parameters ([`System::objective`]).
///
/// The function sets the dimensions and parameters, runs the motion, and computes one number from a
/// measure.
pub struct Objective<M, F> {
    system: System,
    names: Vec<String>,
    times: Vec<f64>,
    what: M,
    cost: F,
}

impl System {
    /// Creates a function of dimensions and parameters with its exact gradient, for an optimiser.
    ///
    /// The function runs the motion over the times. The closure `cost` computes the number F from
    /// the measure y, and ∂F/∂y, ∂F/∂ẏ and ∂F/∂ÿ at each time. Kin needs one backward solve for all
    /// parameters together ([`System::gradient`]). The function works on a copy of the system. With
    /// the feature `argmin` the function implements the traits of the crate `argmin`.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("crank");
    /// let length = m.dimension("length", 0.3)?;
    /// let crank = m.link("crank", length)?;
    /// m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0)))?;
    /// m.add("motor", drive_angle(crank, Law::ramp(1.0)))?;
    /// // Its middle should go to 0.1 in the mean square.
    /// let objective = m.build()?.objective(["length"], linspace(0.0, 6.0, 61), crank.x(), |x| {
    ///     let off: Vec<f64> = x.value.values().iter().map(|x| x - 0.1).collect();
    ///     let slopes = off.iter().map(|off| [2.0 * off, 0.0, 0.0]).collect();
    ///     (off.iter().map(|off| off * off).sum(), slopes)
    /// })?;
    /// let (value, gradient) = objective.at(&[0.25])?;
    /// let beside = (objective.at(&[0.2501])?.0 - objective.at(&[0.2499])?.0) / 2e-4;
    /// assert!(value > 0.0 && (gradient[0] - beside).abs() < 1e-6);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Errors: no dimension or parameter has a given name; the times neither only increase nor only
    /// decrease.
    pub fn objective<M: Measure, F: Fn(&Quantity) -> (f64, Vec<[f64; 3]>)>(
        &self,
        names: impl IntoIterator<Item = impl AsRef<str>>,
        times: impl AsRef<[f64]>,
        what: M,
        cost: F,
    ) -> Result<Objective<M, F>> {
        let names: Vec<String> = names.into_iter().map(|name| name.as_ref().to_string()).collect();
        names.iter().try_for_each(|name| self.parameter(name).map(|_| ()))?;
        let times = times.as_ref().to_vec();
        times::check(&times)?;
        Ok(Objective { system: self.clone(), names, times, what, cost })
    }
}

impl<M: Measure, F: Fn(&Quantity) -> (f64, Vec<[f64; 3]>)> Objective<M, F> {
    /// Returns the names of the dimensions and parameters, in the order of p.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Returns the present values of the dimensions and parameters, at which a search can begin.
    pub fn start(&self) -> Vec<f64> {
        self.names.iter().map(|name| self.system.parameter(name).unwrap_or(f64::NAN)).collect()
    }

    /// Returns the value and the gradient at p.
    ///
    /// Errors: p has the wrong length; those of [`System::set`], [`System::run`], the measure and
    /// [`System::gradient`]; `cost` returns a number that is not finite, or does not return one
    /// weight for each time.
    pub fn at(&self, p: &[f64]) -> Result<(f64, Vec<f64>)> {
        let (system, motion, y) = self.asked(p)?;
        let (value, weights) = self.number(&y)?;
        let weight = |k: usize| weights.get(k).copied().unwrap_or([f64::NAN; 3]);
        let what = Named { what: &self.what };
        Ok((value, system.gradient(&motion, &self.names, what, weight)?))
    }

    /// Returns the value at p, without the gradient.
    ///
    /// Errors: those of [`Objective::at`].
    pub fn value(&self, p: &[f64]) -> Result<f64> {
        self.number(&self.asked(p)?.2).map(|(value, _)| value)
    }

    fn asked(&self, p: &[f64]) -> Result<(System, crate::solve::motion::Motion, Quantity)> {
        if p.len() != self.names.len() {
            return Err(Error::WrongLength {
                what: "point of an objective".to_string(),
                expected: self.names.len(),
                found: p.len(),
            });
        }
        let mut system = self.system.clone();
        self.names.iter().zip(p).try_for_each(|(name, value)| system.set(name, *value))?;
        let motion = system.run(&self.times)?;
        let y = self.what.of(&system, &motion)?;
        Ok((system, motion, y))
    }

    fn number(&self, y: &Quantity) -> Result<(f64, Vec<[f64; 3]>)> {
        let (value, weights) = (self.cost)(y);
        if weights.len() != self.times.len() {
            return Err(Error::WrongLength {
                what: "list of weights of an objective (one for each time)".to_string(),
                expected: self.times.len(),
                found: weights.len(),
            });
        }
        if !value.is_finite() || weights.iter().flatten().any(|x| !x.is_finite()) {
            let reason = format!(
                "the cost of the objective is {value}, and its weights may not be finite. Return finite numbers"
            );
            return Err(Error::InvalidOptions { reason });
        }
        Ok((value, weights))
    }
}

/// A borrowed measure.
struct Named<'a, M> {
    what: &'a M,
}

impl<M: Measure> Measure for Named<'_, M> {
    fn of(&self, system: &System, motion: &crate::solve::motion::Motion) -> Result<Quantity> {
        self.what.of(system, motion)
    }

    fn name(&self) -> Option<&str> {
        self.what.name()
    }

    fn coordinate(&self, system: &System) -> Option<usize> {
        self.what.coordinate(system)
    }
}

#[cfg(feature = "argmin")]
mod traits {
    use argmin::core::{CostFunction, Gradient};

    use super::{Measure, Objective, Quantity};

    impl<M: Measure, F: Fn(&Quantity) -> (f64, Vec<[f64; 3]>)> CostFunction for Objective<M, F> {
        type Param = Vec<f64>;
        type Output = f64;

        fn cost(&self, p: &Self::Param) -> Result<f64, argmin::core::Error> {
            Ok(self.value(p)?)
        }
    }

    impl<M: Measure, F: Fn(&Quantity) -> (f64, Vec<[f64; 3]>)> Gradient for Objective<M, F> {
        type Param = Vec<f64>;
        type Gradient = Vec<f64>;

        fn gradient(&self, p: &Self::Param) -> Result<Vec<f64>, argmin::core::Error> {
            Ok(self.at(p)?.1)
        }
    }
}
