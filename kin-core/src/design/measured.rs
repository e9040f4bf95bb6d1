//! Differentiates measures and their extremes by parameters.

use super::partials::{Partial, partials};
use super::sensitivities::{Sensitivities, Sensitivity};
use super::smooth;
use crate::ask::measure::{Extreme, Measure};
use crate::outcome::error::{Error, Result};
use crate::solve::motion::Motion;
use crate::system::System;

/// The derivatives of a measure y by one parameter p, with one value for each time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MeasureSensitivity {
    /// The name of the parameter.
    pub name: String,
    /// ∂y/∂p at each time. \[unit of y per unit of p\]
    pub value: Vec<f64>,
    /// ∂ẏ/∂p at each time. \[unit of ẏ per unit of p\]
    pub rate: Vec<f64>,
    /// ∂ÿ/∂p at each time. \[unit of ÿ per unit of p\]
    pub second_rate: Vec<f64>,
}

/// The derivatives of the time and the value of an extreme of a measure y by one parameter p.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ExtremeSensitivity {
    /// The name of the parameter.
    pub name: String,
    /// The derivative of the time of the extreme. \[s per unit of p\]
    pub t: f64,
    /// The derivative of the value of the extreme. \[unit of y per unit of p\]
    pub value: f64,
}

impl Sensitivities<'_> {
    /// Returns the exact derivatives of a measure and of its time derivatives by each parameter, at
    /// fixed times.
    ///
    /// The argument `what` is a name, a coordinate or a function of a motion ([`Measure`]), such as
    /// a coordinate of a point.
    ///
    /// The derivatives omit a direct dependence of the measure on a parameter: Kin differentiates
    /// only through the motion.
    ///
    /// Errors: those of [`crate::System::measure`]; the measure belongs to a joint that has one of
    /// the parameters (the error names the parameter).
    pub fn of(&self, what: impl Measure) -> Result<Vec<MeasureSensitivity>> {
        self.each(&what)
    }

    /// Returns the derivatives of time and value of an extreme of a measure by each parameter.
    ///
    /// At an extreme ẏ = 0, so dt/dp = −ẏ_p/ÿ, and the derivative of the value is y_p. If the
    /// largest or smallest value is at an end of the run, its time is fixed.
    ///
    /// Errors: those of [`Sensitivities::of`], [`crate::System::extremes`] and
    /// [`crate::System::at`]; the measure does not have this extreme on the motion; ÿ is zero at
    /// the extreme.
    pub fn extreme(
        &self,
        what: impl Measure,
        extreme: &Extreme,
    ) -> Result<Vec<ExtremeSensitivity>> {
        self.turning(&what, extreme)
    }

    fn turning(&self, what: &dyn Measure, extreme: &Extreme) -> Result<Vec<ExtremeSensitivity>> {
        let (extreme, turns) = on_motion(self.system, self.motion, what, extreme)?;
        self.all().iter().try_for_each(|by| smooth::kink(self.motion, extreme.t, by.name()))?;
        let pose = self.system.at(self.motion, extreme.t)?;
        let names = self.all().iter().map(Sensitivity::name);
        let there = self.system.sensitivities(&pose, names)?;
        let second =
            there.system.measure(&pose, |motion: &Motion| what.of(there.system, motion))?;
        let first = |all: &[f64]| all.first().copied().unwrap_or(f64::NAN);
        let size = first(second.value.values()).abs();
        let second = first(second.second_rate.values());
        let found = |by: MeasureSensitivity| {
            let value = first(&by.value);
            let rate = first(&by.rate);
            let t = if turns { -rate / second } else { 0.0 };
            if !turns {
                return Ok(ExtremeSensitivity { name: by.name, t, value });
            }
            if t.is_finite() && second.abs() > f64::EPSILON * size {
                return Ok(ExtremeSensitivity { name: by.name, t, value });
            }
            let reason = "the acceleration is also zero at the extreme, so the time of the extreme has no derivative";
            Err(Error::no_derivative(&by.name, reason))
        };
        there.each(what)?.into_iter().map(found).collect()
    }

    /// Returns the derivatives of the difference of two extremes of a measure, first minus second,
    /// by each parameter.
    ///
    /// The difference of the values is a stroke or a swing. The difference of the times is the time
    /// between dead centres.
    ///
    /// Errors: those of [`Sensitivities::extreme`].
    pub fn between(
        &self,
        what: impl Measure,
        first: &Extreme,
        second: &Extreme,
    ) -> Result<Vec<ExtremeSensitivity>> {
        let [first, second] = [first, second].map(|extreme| self.turning(&what, extreme));
        let both = first?.into_iter().zip(second?);
        let less = |(a, b): (ExtremeSensitivity, ExtremeSensitivity)| ExtremeSensitivity {
            name: a.name,
            t: a.t - b.t,
            value: a.value - b.value,
        };
        Ok(both.map(less).collect())
    }

    pub(super) fn each(&self, what: &dyn Measure) -> Result<Vec<MeasureSensitivity>> {
        self.all().iter().try_for_each(|by| refuse_own(self.system, what, by.name()))?;
        let partials = partials(self.system, self.motion, what)?;
        Ok(self.all().iter().map(|by| along(&partials, by, self.motion.len())).collect())
    }
}

/// Returns the extreme of the motion that corresponds to this one, and true if the measure changes
/// direction there. Errors: those of [`System::extremes`]; the motion has no such extreme.
pub(super) fn on_motion(
    system: &System,
    motion: &Motion,
    what: &dyn Measure,
    extreme: &Extreme,
) -> Result<(Extreme, bool)> {
    system.extremes(motion, |motion: &Motion| what.of(system, motion))?.find(extreme)
}

/// Returns y_p = y_q q_p and its time derivatives.
fn along(partials: &[(usize, Partial)], by: &Sensitivity, times: usize) -> MeasureSensitivity {
    let none = || vec![0.0; times];
    let name = by.name().to_string();
    let mut sum = MeasureSensitivity { name, value: none(), rate: none(), second_rate: none() };
    for (j, [y_q, first, second]) in partials {
        for k in 0..times {
            let [a, b, c] = [y_q[k], first[k], second[k]];
            let [q, qd, qdd] = [by.q(k)[*j], by.qd(k)[*j], by.qdd(k)[*j]];
            sum.value[k] += a * q;
            sum.rate[k] += a * qd + b * q;
            sum.second_rate[k] += a * qdd + 2.0 * b * qd + c * q;
        }
    }
    sum
}

/// Returns an error, by name, if a measure belongs to the joint that has the parameter.
pub(super) fn refuse_own(system: &System, what: &dyn Measure, by: &str) -> Result<()> {
    let Some(place) = what.name().and_then(|name| system.place_of(name)) else { return Ok(()) };
    if system.moving_with(by)?.iter().any(|moved| moved.block == place.block) {
        let reason = "the measure belongs to the joint with this parameter and may depend on the parameter directly. Use a coordinate or a point instead";
        return Err(Error::no_derivative(by, reason));
    }
    Ok(())
}
