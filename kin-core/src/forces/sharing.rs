//! Forces that redundant constraints share, made one by a rule that is asked for.

use nalgebra::{DMatrix, DVector};

use super::calls::Forces;
use super::reaction::{Reaction, Source};
use crate::model::error::{Error, Result};

/// The rule by which redundant constraints share forces that no balance decides.
///
/// ```
/// # use kin::prelude::*;
/// # use kin::Sharing;
/// # fn main() -> kin::Result<()> {
/// let mut m = Mechanism::new("door");
/// let door = m.spatial("door", SpatialPose::at(vec3(0.5, 0.0, 1.0)))?;
/// let (ground, z) = (m.ground(), vec3(0.0, 0.0, 1.0));
/// for (name, height) in [("hinge 1", 0.3), ("hinge 2", 1.7)] {
///     let (u, p) = (vec3(-0.5, 0.0, height - 1.0), vec3(0.0, 0.0, height));
///     m.add(name, spatial::revolute(door, ground, u, p, z, z))?;
/// }
/// m.add("hand", spatial::drive_turn(door, ground, z, z, Law::ramp(0.5)))?;
/// m.mass(door, 20.0, vec3(0.0, 0.0, 0.0), [[8.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 2.0]])?;
/// m.gravity(vec3(0.0, 0.0, -9.81));
/// let system = m.build()?;
/// let motion = system.run([0.0, 0.5])?;
///
/// let forces = system.forces(&motion)?;
/// // Which hinge carries the door?
/// assert!(forces.reaction("hinge 1")?.on(door)?.component("F_z").is_err());
/// let both = forces.sum(["hinge 1", "hinge 2"])?.on(door)?.component("F_z")?;
/// assert!((both.max() - 196.2).abs() < 1e-9);
///
/// let forces = system.forces_with(&motion, &Sharing::LeastNorm)?;
/// assert!((forces.reaction("hinge 1")?.on(door)?.component("F_z")?.max() - 98.1).abs() < 1e-9);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Sharing {
    /// No number is given for what is not unique.
    #[default]
    NotGiven,
    /// The sum of the squares of the forces and torques of all constraints, each about its own
    /// point, is least: one newton counts as one newton metre, in the units of the mechanism.
    LeastNorm,
    /// These equations, by name (`hinge 2.z`), hold nothing. There must be as many of them as are
    /// redundant, and the others must still be independent.
    LeftOut(Vec<String>),
}

/// Entries of the null space below this share of the largest one are rounding.   \[-\]
const NOTHING: f64 = 1e-10;

impl Forces<'_> {
    /// Makes forces unique by a rule. Errors: equations that cannot be left out, by name.
    pub(super) fn share(&mut self, sharing: &Sharing) -> Result<()> {
        if *sharing == Sharing::NotGiven {
            return Ok(());
        }
        let found: Result<Vec<DVector<f64>>> = (0..self.motion.len())
            .map(|k| match sharing {
                Sharing::LeftOut(rows) => self.left_out(rows, k),
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

    /// The shares of the vectors of the null space with which the norm is least.
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
                // Bare coordinates have no point: their multipliers count.
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

    /// The shares with which the multipliers of these equations are zero.
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
            let reason = format!("{} equations are left out, but {n} are redundant", rows.len());
            return Err(invalid(self.system.name(), &reason));
        }
        if n == 0 {
            return Ok(DVector::zeros(0));
        }
        // Each row by its largest entry, so that units do not count.
        let size = |row: usize| at.open.iter().fold(0.0_f64, |m, open| m.max(open[row].abs()));
        let largest = (0..equations.rows).map(size).fold(0.0, f64::max);
        if let Some(row) = rows.iter().find(|row| size(**row) <= NOTHING * largest) {
            let reason = format!(
                "`{}` is not redundant: left out, nothing holds in its place",
                equations.equation(*row)
            );
            return Err(invalid(self.system.name(), &reason));
        }
        let matrix = DMatrix::from_fn(n, n, |i, j| at.open[j][rows[i]] / size(rows[i]));
        let rhs = DVector::from_fn(n, |i, _| -lambda[rows[i]] / size(rows[i]));
        let values = matrix.clone().singular_values();
        let dependent = values.min() <= 1e-7 * values.max() || values.min().is_nan();
        if dependent {
            let reason = format!("without `{}` something is free", names.join("`, `"));
            return Err(invalid(self.system.name(), &reason));
        }
        matrix.lu().solve(&rhs).ok_or_else(|| {
            invalid(self.system.name(), "the equations left out depend on one another")
        })
    }
}

fn invalid(name: &str, reason: &str) -> Error {
    let constraint = name.to_string();
    let kind = "sharing of forces".to_string();
    Error::InvalidParameters { constraint, kind, reason: reason.to_string() }
}
