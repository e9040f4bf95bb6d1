//! Checks that a motion belongs to the present system.

use crate::outcome::error::{Error, OtherMotion, Result};
use crate::solve::motion::Motion;
use crate::system::{System, scale};

/// An equation with a residual above this share of its terms, and twice the residual of the run,
/// belongs to another system. \[-\]
const OFF: f64 = 1e-8;

impl System {
    /// Returns an error unless the motion belongs to this system.
    pub(crate) fn own(&self, motion: &Motion) -> Result<()> {
        let expected = self.n_coordinates();
        let found = motion.names().len();
        match motion.names() == self.coordinate_names() {
            true => Ok(()),
            false => Err(Error::WrongLength {
                what: format!(
                    "a position of the motion of \"{}\", which does not belong to \"{}\",",
                    motion.name(),
                    self.name()
                ),
                expected,
                found,
            }),
        }
    }

    /// Returns an error unless the motion belongs to this system as it is now. The check evaluates
    /// its first, middle and last time.
    pub(crate) fn own_as_it_is(&self, motion: &Motion) -> Result<()> {
        self.own(motion)?;
        let last = motion.len().saturating_sub(1);
        [0, last / 2, last]
            .into_iter()
            .filter(|k| *k < motion.len())
            .try_for_each(|k| self.holds(motion, k))
    }

    /// Returns an error if C = 0 does not hold at a time of the motion as well as the motion
    /// claims.
    fn holds(&self, motion: &Motion, k: usize) -> Result<()> {
        let t = motion.times()[k];
        let q = motion.q(k);
        let told = 2.0 * motion.residuals()[k];
        // Another error reports C or C_q that is not finite.
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
