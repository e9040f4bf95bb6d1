//! Derivatives of measures and of their extremes by parameters.
//!
//! A measure y is asked along the motions q + a s δ(s), δ(s) = q_p + s q̇_p + ½ s² q̈_p, that begin at the
//! pose of each time: its derivatives by s up to the third are polynomials in a of that degree, and the
//! linear coefficient of derivative k + 1 is (k + 1) times derivative k of y_p. Their values at two or four
//! changes a give it exactly: nothing is approximated.

use super::sensitivities::{Sensitivities, Sensitivity};
use super::smooth;
use crate::ask::measure::{Extreme, Measure};
use crate::model::error::Result;
use crate::model::no_derivative::NoDerivative;
use crate::solve::motion::{Motion, Quantity};
use crate::system::System;

/// Derivatives of a measure by one parameter, one value a time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MeasureSensitivity {
    /// The parameter.
    pub name: String,
    /// ∂y/∂p   \[unit of y a unit of p\]
    pub value: Vec<f64>,
    /// ∂ẏ/∂p   \[unit of ẏ a unit of p\]
    pub rate: Vec<f64>,
    /// ∂ÿ/∂p   \[unit of ÿ a unit of p\]
    pub second_rate: Vec<f64>,
}

/// How an extreme of a measure changes with one parameter.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ExtremeSensitivity {
    /// The parameter.
    pub name: String,
    /// The derivative of its time.   \[s a unit of p\]
    pub t: f64,
    /// The derivative of its value.   \[unit of y a unit of p\]
    pub value: f64,
}

impl Sensitivities<'_> {
    /// The derivatives of a measure and its rates by each parameter, at fixed times; exact. `what` is a name,
    /// a coordinate or a function of a motion ([`Measure`]), such as a coordinate of a point. What the
    /// measure depends on a parameter itself, not through the motion, is not known.
    ///
    /// Errors: those of [`crate::System::measure`]; by name a measure of the joint whose own parameter it is.
    pub fn of(&self, what: impl Measure) -> Result<Vec<MeasureSensitivity>> {
        self.each(&what)
    }

    /// How time and value of an extreme of a measure change with each parameter. As the rate vanishes there,
    /// dt/dp = −ẏ_p/ÿ and the value changes by y_p.
    ///
    /// Errors: those of [`Sensitivities::of`] and [`crate::System::at`]; an extreme at which the second rate
    /// vanishes too.
    pub fn extreme(&self, what: impl Measure, extreme: &Extreme) -> Result<Vec<ExtremeSensitivity>> {
        self.turning(&what, extreme)
    }

    fn turning(&self, what: &dyn Measure, extreme: &Extreme) -> Result<Vec<ExtremeSensitivity>> {
        self.all().iter().try_for_each(|by| smooth::kink(self.motion, extreme.t, by.name()))?;
        let pose = self.system.at(self.motion, extreme.t)?;
        let names = self.all().iter().map(Sensitivity::name);
        let there = self.system.sensitivities(&pose, names)?;
        let second = there.system.measure(&pose, |motion: &Motion| what.of(there.system, motion))?;
        let first = |all: &[f64]| all.first().copied().unwrap_or(f64::NAN);
        let (size, second) = (first(second.value.values()).abs(), first(second.second_rate.values()));
        let found = |by: MeasureSensitivity| {
            let (value, rate) = (first(&by.value), first(&by.rate));
            let t = -rate / second;
            if t.is_finite() && second.abs() > f64::EPSILON * size {
                return Ok(ExtremeSensitivity { name: by.name, t, value });
            }
            let reason = "the second rate vanishes at the extreme too: its time has no derivative";
            Err(NoDerivative::error(&by.name, reason))
        };
        there.each(what)?.into_iter().map(found).collect()
    }

    /// How the difference of two extremes of a measure, the first less the second, changes with each
    /// parameter: of the values (a stroke, a swing) and of the times (between dead centres).
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
        let by = |by: &Sensitivity| {
            refuse_own(self.system, what, by.name())?;
            along(self.system, self.motion, what, by)
        };
        self.all().iter().map(by).collect()
    }
}

/// An error by name where a measure is one of the joint whose parameter that is.
pub(super) fn refuse_own(system: &System, what: &dyn Measure, by: &str) -> Result<()> {
    let Some(place) = what.name().and_then(|name| system.place_of(name)) else { return Ok(()) };
    let joint = system.equations().blocks[place.block].name.as_str();
    let own = |by: &str| by.strip_prefix(joint).is_some_and(|rest| rest.starts_with('.'));
    if own(by) || system.parameters_on(by)?.is_some_and(|all| all.iter().any(|(name, _)| own(name))) {
        let reason = "the measure is one of the joint whose parameter it is, and may read it itself; ask for a \
                      coordinate or a point instead";
        return Err(NoDerivative::error(by, reason));
    }
    Ok(())
}

/// The derivatives of a measure along a change of a motion.
pub(super) fn along(
    system: &System,
    motion: &Motion,
    what: &dyn Measure,
    by: &Sensitivity,
) -> Result<MeasureSensitivity> {
    let size = |all: &[f64]| all.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let all = |of: &dyn Fn(usize) -> f64| (0..motion.len()).map(of).fold(0.0_f64, f64::max);
    let rates = all(&|k| size(motion.qd(k)).max(size(motion.qdd(k)).sqrt()));
    let slopes = all(&|k| size(by.q(k)).max(size(by.qd(k))).max(size(by.qdd(k))));
    // Changes of the size of the rates lose the fewest digits.
    let h = Some(rates.max(1.0) / slopes).filter(|h| h.is_finite()).unwrap_or(1.0);
    let asked = |a: f64| what.of(system, &changed(motion, by, a));
    let (near, far) = ([asked(h)?, asked(-h)?], [asked(2.0 * h)?, asked(-2.0 * h)?]);
    let odd = |[plus, minus]: &[Quantity; 2], order: usize, k: usize| {
        0.5 * (plus.orders()[order][k] - minus.orders()[order][k])
    };
    let linear = |order: usize, k: usize| match order {
        1 | 2 => odd(&near, order, k) / h,
        _ => (8.0 * odd(&near, order, k) - odd(&far, order, k)) / (6.0 * h),
    };
    let list = |order: usize| (0..motion.len()).map(|k| linear(order, k) / order as f64).collect();
    Ok(MeasureSensitivity {
        name: by.name().to_string(),
        value: list(1),
        rate: list(2),
        second_rate: list(3),
    })
}

/// The motion with the rates of q + a s δ(s).
fn changed(motion: &Motion, by: &Sensitivity, a: f64) -> Motion {
    let mut changed = motion.clone();
    changed.qddd = vec![0.0; changed.q.len()];
    let n = motion.names().len();
    for k in 0..motion.len() {
        for j in 0..n {
            let place = k * n + j;
            changed.qd[place] += a * by.q(k)[j];
            changed.qdd[place] += 2.0 * a * by.qd(k)[j];
            changed.qddd[place] = 3.0 * a * by.qdd(k)[j];
        }
    }
    changed
}
