//! Applies the rules that make the forces of redundant constraints unique.

use nalgebra::{DMatrix, DVector};

use super::calls::Forces;
use super::reaction::{Reaction, Source};
use crate::model::loads::LoadSharing;
use crate::outcome::error::{Error, Result};
use crate::outcome::words::list;

/// Entries of the null space below this share of the largest one are rounding. \[-\]
const NOTHING: f64 = 1e-10;

impl Forces<'_> {
    /// Makes forces unique by a rule. Errors: equations that cannot be left out, by name.
    pub(super) fn share(&mut self, sharing: &LoadSharing) -> Result<()> {
        if *sharing == LoadSharing::NotGiven {
            return Ok(());
        }
        let found: Result<Vec<DVector<f64>>> = (0..self.motion.len())
            .map(|k| match sharing {
                LoadSharing::Without(rows) => self.left_out(rows, k),
                _ => self.least(k),
            })
            .collect();
        for (k, shares) in found?.into_iter().enumerate() {
            for (open, share) in self.multipliers.close(k).into_iter().zip(shares.iter()) {
                self.multipliers
                    .at_mut(k)
                    .iter_mut()
                    .zip(open)
                    .for_each(|(lambda, open)| *lambda += share * open);
            }
        }
        Ok(())
    }

    /// Returns the shares of the vectors of the null space that minimise the norm.
    fn least(&self, k: usize) -> Result<DVector<f64>> {
        let lambda = self.multipliers.at(k);
        let at = self.multipliers.beside(k);
        let mut own = Vec::new();
        let mut open = vec![Vec::new(); at.open.len()];
        if open.is_empty() {
            return Ok(DVector::zeros(0));
        }
        for (number, block) in self.system.equations().blocks.iter().enumerate() {
            let reaction = Reaction::new(self, &block.name, vec![Source::Constraint(number)]);
            let mut all = reaction.at_its_point(k).into_iter();
            match all.next() {
                Some(wrench) => {
                    own.extend(wrench.components());
                    open.iter_mut()
                        .zip(all)
                        .for_each(|(open, wrench)| open.extend(wrench.components()));
                }
                // Scalar coordinates have no point, so their multipliers count.
                None => {
                    own.extend(block.rows().map(|row| lambda[row]));
                    let rows = || block.rows();
                    open.iter_mut()
                        .zip(&at.open)
                        .for_each(|(open, y)| open.extend(rows().map(|row| y[row])));
                }
            }
        }
        let matrix = DMatrix::from_fn(own.len(), open.len(), |i, j| open[j][i]);
        let solved = matrix.svd(true, true).solve(&-DVector::from_vec(own), 1e-12);
        solved.map_err(|reason| invalid(self.system.name(), reason))
    }

    /// Returns the shares for which the multipliers of these equations are zero.
    fn left_out(&self, names: &[String], k: usize) -> Result<DVector<f64>> {
        let lambda = self.multipliers.at(k);
        let at = self.multipliers.beside(k);
        let equations = self.system.equations();
        let mut rows = Vec::new();
        for name in names {
            let row = (0..equations.rows).find(|row| equations.equation(*row) == *name);
            rows.push(row.ok_or_else(|| Error::UnknownName {
                what: "equation",
                name: name.clone(),
                known: (0..equations.rows).map(|row| equations.equation(row)).collect(),
            })?);
        }
        let n = at.open.len();
        if rows.len() != n {
            let reason = format!(
                "the rule leaves out {} equations, but {n} equations are redundant",
                rows.len()
            );
            return Err(invalid(self.system.name(), &reason));
        }
        if n == 0 {
            return Ok(DVector::zeros(0));
        }
        // Each row is divided by its largest entry, so that units do not matter.
        let size = |row: usize| at.open.iter().fold(0.0_f64, |m, open| m.max(open[row].abs()));
        let largest = (0..equations.rows).map(size).fold(0.0, f64::max);
        if let Some(row) = rows.iter().find(|row| size(**row) <= NOTHING * largest) {
            let reason = format!(
                "the equation `{0}` is not redundant: if you remove `{0}`, a body or coordinate can move. Leave out redundant equations only",
                equations.equation(*row)
            );
            return Err(invalid(self.system.name(), &reason));
        }
        let matrix = DMatrix::from_fn(n, n, |i, j| at.open[j][rows[i]] / size(rows[i]));
        let rhs = DVector::from_fn(n, |i, _| -lambda[rows[i]] / size(rows[i]));
        let values = matrix.clone().singular_values();
        let dependent = values.min() <= 1e-7 * values.max() || values.min().is_nan();
        if dependent {
            let reason = format!(
                "if you remove the equations {}, a body or coordinate can move. Leave out equations that are redundant together",
                list(names)
            );
            return Err(invalid(self.system.name(), &reason));
        }
        matrix.lu().solve(&rhs).ok_or_else(|| {
            invalid(
                self.system.name(),
                "the equations that the rule leaves out depend on one another. Leave out other redundant equations",
            )
        })
    }
}

fn invalid(name: &str, reason: &str) -> Error {
    let constraint = name.to_string();
    let kind = "distribution of forces".to_string();
    Error::InvalidParameters { constraint, kind, reason: reason.to_string() }
}
