//! Motions belong to the system that they are asked of, as it is now.

use crate::model::error::{Error, OtherMotion, Result};
use crate::solve::motion::Motion;
use crate::system::{System, scale};

/// An equation that is further off than this share of its terms, and twice what it was when the
/// motion was computed, is one of another system.   \[-\]
const OFF: f64 = 1e-8;

impl System {
    /// An error unless the motion is one of this system.
    pub(crate) fn own(&self, motion: &Motion) -> Result<()> {
        let expected = self.n_coordinates();
        let found = motion.names().len();
        match motion.names() == self.coordinate_names() {
            true => Ok(()),
            false => Err(Error::WrongLength {
                what: format!("a motion of \"{}\", not of \"{}\"", motion.name(), self.name()),
                expected,
                found,
            }),
        }
    }

    /// An error unless the motion is one of this system as it is now: its first, middle and last
    /// times are looked at.
    pub(crate) fn own_as_it_is(&self, motion: &Motion) -> Result<()> {
        self.own(motion)?;
        let last = motion.len().saturating_sub(1);
        [0, last / 2, last]
            .into_iter()
            .filter(|k| *k < motion.len())
            .try_for_each(|k| self.holds(motion, k))
    }

    /// An error where C = 0 does not hold at a time of the motion as far as it was told to.
    fn holds(&self, motion: &Motion, k: usize) -> Result<()> {
        let t = motion.times()[k];
        let q = motion.q(k);
        let told = 2.0 * motion.residuals()[k];
        // Another error tells where C or C_q is not finite.
        let Ok(point) = self.model().linearize(q, t) else { return Ok(()) };
        let equations = self.equations();
        let sizes = scale::sizes(self.layout(), equations, &point.values, (q, t), self.links());
        let mut terms = vec![0.0; point.c.len()];
        for (entry, value) in equations.entries.iter().zip(&point.values) {
            if let Some((row, column)) = *entry {
                terms[row] += value.abs() * (q[column].abs() + sizes[column]);
            }
        }
        let is_off = |row: &usize| point.c[*row].abs() > told + OFF * terms[*row];
        match (0..point.c.len()).find(is_off) {
            None => Ok(()),
            Some(row) => Err(Box::new(OtherMotion {
                system: self.name().to_string(),
                equation: equations.equation(row),
                off: point.c[row].abs(),
                t,
                units: self.unit_words().clone(),
            })
            .into()),
        }
    }
}
