//! A position with everything at rest: coordinates and measures by name, and as a motion.

use crate::ask::measure::Measure;
use crate::outcome::error::Result;
use crate::outcome::motion::Motion;
use crate::outcome::named_value::NamedValue;
use crate::solve::newton::Outcome;
use crate::system::System;

/// A position of a system.
#[derive(Clone, Copy, Debug)]
pub(in crate::ask) struct Still<'a> {
    pub system: &'a System,
    pub q: &'a [f64],
}

impl Still<'_> {
    /// Returns a coordinate by its name.
    pub(in crate::ask) fn coordinate(self, name: &str) -> Option<f64> {
        let names = self.system.coordinate_names();
        let column = names.iter().position(|known| known == name)?;
        self.q.get(column).copied()
    }

    /// Returns a measure. Errors: an unknown name, with the known ones.
    pub(in crate::ask) fn measure(self, what: impl Measure) -> Result<f64> {
        let motion = self.motion();
        Ok(self.system.measure(&motion, what)?.value.values()[0])
    }

    /// Returns all measures of joints. Errors: a measure that is not finite here.
    pub(in crate::ask) fn measures(self) -> Result<Vec<NamedValue>> {
        let motion = self.motion();
        let value = |name: String| {
            let quantity = self.system.measure(&motion, name.as_str())?;
            let unit = Some(quantity.value.unit().to_string());
            Ok(NamedValue { name, unit, value: quantity.value.values()[0] })
        };
        self.system.measures().into_iter().map(value).collect()
    }

    /// Returns the position as a motion of one time, 0.
    pub(in crate::ask) fn motion(self) -> Motion {
        let Still { system, q } = self;
        let rest = vec![0.0; q.len()];
        let mut motion = Motion::new(system, 1);
        let (worst, residual) = self.largest_residual();
        let outcome = Outcome { iterations: 0, residual };
        motion.append(0.0, [q, &rest, &rest, &[]], outcome, worst);
        motion
    }

    /// Returns the row with the largest |C_i|, and that value.
    fn largest_residual(self) -> (usize, f64) {
        let c = self.system.residual(self.q, 0.0).unwrap_or_default();
        let sizes = c.iter().map(|c| c.abs()).enumerate();
        sizes.fold((0, 0.0), |worst, one| if one.1 > worst.1 { one } else { worst })
    }
}
