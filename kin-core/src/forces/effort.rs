//! The force or torque of a driving constraint, and its power.

mod advantage;

use std::fmt;

use super::calls::Forces;
use super::multipliers::LOOSE;
use crate::model::coordinates::Target;
use crate::model::error::{Error, Result};
use crate::model::motion::Series;
use crate::model::not_unique::NotUnique;
use crate::model::units::{Unit, Units};
use crate::system::System;
use crate::system::evaluate::Block;

/// Efforts and power of a driving constraint: for each of its rows x(q) − f(t) = 0 the generalised force −λ
/// along x. A row that is written otherwise, as those of `moving_point`, has −λ too, the generalised force
/// along the row; it does not belong to one law then, and the power alone tells what the drive gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    efforts: Vec<Series>,
    power: Series,
}

/// The largest magnitude of a number over time, and when.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Peak {
    /// The value, with its sign.
    pub value: f64,
    /// When.   \[s\]
    pub t: f64,
    /// The unit of the value.
    pub unit: String,
    units: Units,
}

impl Peak {
    /// Of a series; `None` of an empty one.
    fn of(series: &Series) -> Peak {
        let (value, t) = if series.max().abs() >= series.min().abs() {
            (series.max(), series.at_max())
        } else {
            (series.min(), series.at_min())
        };
        Peak { value, t, unit: series.unit().to_string(), units: series.unit_words().clone() }
    }
}

impl fmt::Display for Peak {
    /// "4.31 N m at 0.212 s"
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = |x: f64| format!("{x:.4e}").parse::<f64>().unwrap_or(x);
        write!(f, "{} {} at {} {}", digits(self.value), self.unit, digits(self.t), self.units.time())
    }
}

impl Series {
    /// The largest magnitude, the first one of several; NaN of an empty series.
    pub fn peak(&self) -> Peak {
        Peak::of(self)
    }
}

impl Drive {
    /// The generalised force that belongs to its law: a torque where the law is an angle, a force where it is
    /// a length. Power put into the mechanism = effort · ḟ; positive the way the law grows. Of a driver with
    /// several rows that of the first; [`Drive::efforts`] has all. [`Drive`] tells of rows of other forms.
    ///    \[N m, N\]
    pub fn effort(&self) -> &Series {
        &self.efforts[0]
    }

    /// One for each row.
    pub fn efforts(&self) -> &[Series] {
        &self.efforts
    }

    /// λ · C_t, the power that it puts into the mechanism.   \[W\]
    pub fn power(&self) -> &Series {
        &self.power
    }

    /// The largest effort of all rows, and when.
    pub fn peak(&self) -> Peak {
        let peaks = self.efforts.iter().map(Series::peak);
        peaks
            .reduce(|best, next| if next.value.abs() > best.value.abs() { next } else { best })
            .unwrap_or_else(|| self.power.peak())
    }
}

/// Of one constraint that drives.
pub(super) fn drive(forces: &Forces<'_>, number: usize) -> Result<Drive> {
    let (system, motion) = (forces.system, forces.motion);
    let equations = system.equations();
    let block = &equations.blocks[number];
    if !block.drives {
        let drives = forces.drives().into_iter().map(str::to_string).collect();
        return Err(Error::UnknownName { what: "driver", name: block.name.clone(), known: drives });
    }
    let units = motion.unit_words();
    let mut efforts = Vec::new();
    for (k, row) in block.rows().enumerate() {
        let unit = unit_of_row(system, block, k);
        for time in 0..motion.len() {
            let at = forces.multipliers.beside(time);
            let scale = if unit.as_deref() == Some("m") { at.length } else { 1.0 };
            if at.open.iter().any(|open| open[row].abs() * scale > LOOSE) {
                return Err(NotUnique::error(&block.equation(k), "its effort", forces.sharing(time)));
            }
        }
        let unit = match unit.as_deref() {
            Some("m") => units.force(),
            Some("rad") => units.torque(),
            Some(_) => units.energy(),
            None => format!("{} a unit of its row", units.energy()),
        };
        let values = (0..motion.len()).map(|k| 0.0 - forces.multipliers.at(k)[row]).collect();
        efforts.push(Series::new(block.equation(k), unit, motion.clock(), values));
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

/// The unit of a row as its documentation says (`[m]`, `[rad, m]`), or of the coordinate that it drives.
fn unit_of_row(system: &System, block: &Block, k: usize) -> Option<String> {
    if let [only] = block.constraint.arguments().as_slice()
        && let Target::Coord(..) = only.target
    {
        let layout = system.layout();
        let column = layout.columns(only).first().copied().flatten()?;
        return Some(match layout.units[column] {
            Unit::Metre => "m".to_string(),
            Unit::Radian => "rad".to_string(),
            Unit::One => "-".to_string(),
        });
    }
    let facts = block.constraint.facts();
    let text = facts.description.split("\n\n").next()?.replace('\\', "");
    let (_, after) = text.rsplit_once('[')?;
    let words: Vec<&str> = after.split(']').next()?.split(',').map(str::trim).collect();
    let word = if words.len() == 1 { words.first() } else { words.get(k) };
    word.map(|word| word.to_string())
}
