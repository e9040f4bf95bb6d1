//! Computes the force or torque of a driver, and its power.

mod advantage;
mod by_law;

use std::fmt;

use super::calls::Forces;
use super::multipliers::LOOSE;
use crate::coordinates::units::Units;
use crate::outcome::error::{Error, Result};
use crate::outcome::motion::Series;
use by_law::{Led, Share};

/// The efforts and the power of a driver.
///
/// The effort of a law f is the generalised force λ · ∂C/∂f. So effort · ḟ is the power that the
/// law puts into the mechanism. For a driver with rows x(q) − f(t) = 0 the effort is −λ, row by
/// row.
///
/// Kin does not know ∂C/∂f for drivers on the dual route, and for drivers that read the slope of a
/// law or a law at several times. For these drivers the efforts are −λ for each row, and only the
/// power has a clear meaning.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    efforts: Vec<Series>,
    power: Series,
}

/// The largest magnitude of a quantity over time, and its time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Peak {
    /// The value of the largest magnitude, with its sign.
    pub value: f64,
    /// The first time of the largest magnitude. \[s\]
    pub t: f64,
    /// The unit of the value.
    pub unit: String,
    units: Units,
}

impl Peak {
    /// Returns the peak of a series, or NaN for an empty one.
    fn of(series: &Series) -> Peak {
        let first = series.best(|a, b| a.abs() > b.abs());
        let [value, t] =
            [series.values(), series.times()].map(|all| first.map_or(f64::NAN, |k| all[k]));
        Peak { value, t, unit: series.unit().to_string(), units: series.unit_words().clone() }
    }
}

impl fmt::Display for Peak {
    /// Writes "4.31 N m at 0.212 s".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = |x: f64| format!("{x:.4e}").parse::<f64>().unwrap_or(x);
        write!(
            f,
            "{} {} at {} {}",
            digits(self.value),
            self.unit,
            digits(self.t),
            self.units.time()
        )
    }
}

impl Series {
    /// Returns the value of largest magnitude with its first time, or NaN for an empty series.
    pub fn peak(&self) -> Peak {
        Peak::of(self)
    }
}

impl Drive {
    /// Returns the generalised force of the driver's law: a torque if the law is an angle, a force
    /// if it is a length. \[N m, N\]
    ///
    /// The power that the driver puts into the mechanism is effort · ḟ. The effort is positive in
    /// the direction in which the law grows. For a driver with several laws this method returns the
    /// effort of the first law; [`Drive::efforts`] returns all efforts.
    pub fn effort(&self) -> &Series {
        &self.efforts[0]
    }

    /// Returns the effort of each law.
    ///
    /// The effort of a single law has the name of the driver, such as `motor`. If a driver has a
    /// row for each law, the names contain the row, such as `hand.x`. Otherwise the names contain
    /// the law, such as `tip.x_i`. If the formulas do not show whether a law is a length or an
    /// angle, the unit is the unit of energy per unit of the law.
    pub fn efforts(&self) -> &[Series] {
        &self.efforts
    }

    /// Returns λ · C_t, the power that the driver puts into the mechanism. \[W\]
    pub fn power(&self) -> &Series {
        &self.power
    }

    /// Returns the largest effort of all laws, and its time.
    pub fn peak(&self) -> Peak {
        let peaks = self.efforts.iter().map(Series::peak);
        peaks
            .reduce(|best, next| if next.value.abs() > best.value.abs() { next } else { best })
            .unwrap_or_else(|| self.power.peak())
    }
}

/// Computes the efforts of one driver.
pub(super) fn drive(forces: &Forces<'_>, number: usize) -> Result<Drive> {
    let system = forces.system;
    let motion = forces.motion;
    let equations = system.equations();
    let block = &equations.blocks[number];
    if !block.drives {
        let drives = forces.drives().into_iter().map(str::to_string).collect();
        return Err(Error::UnknownName { what: "driver", name: block.name.clone(), known: drives });
    }
    let units = motion.unit_words();
    let mut efforts = Vec::new();
    for led in Led::all(forces, block) {
        let is_length = led.unit.as_deref() == Some("m");
        for time in 0..motion.len() {
            let at = forces.multipliers.beside(time);
            let scale = if is_length { at.length } else { 1.0 };
            let is_loose = |open: usize| led.of(block, &at.open[open], time).abs() * scale > LOOSE;
            if (0..at.open.len()).any(is_loose) {
                return Err(Error::not_unique(
                    &led.name,
                    "its effort",
                    forces.sharing(time, is_loose),
                ));
            }
        }
        let unit = match (led.unit.as_deref(), &led.share) {
            (Some("m"), _) => units.force(),
            (Some("rad"), _) => units.torque(),
            (Some(_), _) => units.energy(),
            (None, Share::Row(_)) => format!("{} per unit of its row", units.energy()),
            (None, Share::Law(_)) => format!("{} per unit of its law", units.energy()),
        };
        let values =
            (0..motion.len()).map(|k| led.of(block, forces.multipliers.at(k), k)).collect();
        efforts.push(Series::new(led.name, unit, motion.clock(), values));
    }
    let power = |k: usize| -> f64 {
        let mut rhs = vec![0.0; system.n_equations()];
        equations.velocity_rhs(&equations.instant_at(motion.times()[k], motion.q(k)), &mut rhs);
        block.rows().map(|row| -rhs[row] * forces.multipliers.at(k)[row]).sum()
    };
    let power = (0..motion.len()).map(power).collect();
    let power = Series::new(format!("{}.power", block.name), units.power(), motion.clock(), power);
    Ok(Drive { efforts, power })
}
