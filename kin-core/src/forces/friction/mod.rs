//! Computes dry friction, which depends on the reactions of joints, while the reactions depend on
//! friction.
//!
//! The normal forces N of all contacts depend linearly on the amounts f of friction: N = N₀ + Σ f_e
//! N_e. N_e are the normal forces for one unit of friction in joint e; Kin computes N_e by one
//! transposed solve with the existing elimination. Coulomb's law gives f as a function of N. So
//! Newton's method needs only the few normal forces as unknowns (`grown.rs`).

mod grown;
mod rubbing;

use nalgebra::{DMatrix, DVector};

use super::acting::Now;
use super::multipliers::{LOOSE, Multipliers, TransposedSolver};
use crate::model::loads::Friction;
use crate::numbers::algebra::Vec3;
use crate::outcome::error::{Error, Result};
use crate::outcome::jammed::Jammed;
use crate::system::System;
use crate::system::evaluate::Block;
use grown::{Grown, Laws};
pub(super) use rubbing::{Rub, Rubbing};

/// A driver works against friction if its effort is at least this share of the largest one. \[-\]
const WORKS: f64 = 1e-6;

/// All joints with friction.
pub(super) struct Frictions {
    pub all: Vec<Rubbing>,
}

impl Frictions {
    /// Prepares the joints with friction. Errors: a joint with parameters that no longer make it a
    /// pin or slide.
    pub(super) fn new(system: &System) -> Result<Frictions> {
        let blocks = system.equations().blocks.iter().enumerate();
        let one = |(name, friction): &(String, Friction)| {
            let (number, block) = blocks
                .clone()
                .find(|(_, block)| block.name == *name)
                .ok_or_else(|| Error::UnknownName {
                    what: "constraint",
                    name: name.clone(),
                    known: blocks.clone().map(|(_, block)| block.name.clone()).collect(),
                })?;
            Rubbing::new(name, friction, number, block.constraint.as_ref())
        };
        let all = system.loads.frictions.iter().map(one);
        Ok(Frictions { all: all.collect::<Result<_>>()? })
    }

    /// Adds friction to λ, which is without friction, and stores the friction of each joint.
    ///
    /// Errors: a reaction that is not unique, by name; a jammed mechanism.
    pub(super) fn add(
        &self,
        solver: &TransposedSolver<'_>,
        now: Now<'_>,
        found: &mut Multipliers,
    ) -> Result<()> {
        if self.all.is_empty() {
            return Ok(());
        }
        let system = solver.system();
        let rubs: Vec<Rub> = self.all.iter().map(|rubbing| rubbing.at(system, now)).collect();
        self.unique(&rubs, solver, found)?;
        let n = now.q.len();
        let mut lambda = Vec::new();
        for rub in &rubs {
            for unit in rub.units(n) {
                lambda.push(solver.transposed(&unit));
            }
        }
        let columns: Vec<DVector<f64>> =
            lambda.iter().map(|unit| self.contacts(&rubs, solver, unit)).collect();
        let rows = columns.first().map_or(0, |column| column.len());
        let contacts = DMatrix::from_fn(rows, columns.len(), |i, k| columns[k][i]);
        let laws = Laws::new(&self.all, &rubs, &contacts);
        let amounts = match laws.grow(&self.contacts(&rubs, solver, &found.lambda)) {
            Grown::Whole(contacts) => laws.amounts(&contacts, 1.0),
            Grown::Jammed { share, contacts } => {
                let amounts = laws.amounts(&contacts, share);
                return Err(self.jammed(
                    solver,
                    now.t,
                    Held { rubs: &rubs, lambda: &lambda, amounts, share },
                ));
            }
        };
        for (amount, unit) in amounts.iter().zip(&lambda) {
            found.lambda.iter_mut().zip(unit).for_each(|(all, unit)| *all += amount * unit);
        }
        let mut rest = amounts.as_slice();
        for mut rub in rubs {
            let (own, others) = rest.split_at(rub.n_amounts().min(rest.len()));
            rest = others;
            rub.take(own);
            found.beside.rubs.push(rub);
        }
        Ok(())
    }

    /// Normal forces at all contacts by λ.
    fn contacts(
        &self,
        rubs: &[Rub],
        solver: &TransposedSolver<'_>,
        lambda: &[f64],
    ) -> DVector<f64> {
        let mut all = Vec::new();
        for (rubbing, rub) in self.all.iter().zip(rubs) {
            let wrench = rub.held(&solver.by_block(rubbing.block, lambda));
            all.extend(rubbing.contacts(rub, wrench).iter().flat_map(|normal| normal.to_array()));
        }
        DVector::from_vec(all)
    }

    /// Errors: contacts to which something can be added that no balance notices.
    fn unique(
        &self,
        rubs: &[Rub],
        solver: &TransposedSolver<'_>,
        found: &Multipliers,
    ) -> Result<()> {
        for (number, open) in found.beside.open.iter().enumerate() {
            for (rubbing, rub) in self.all.iter().zip(rubs) {
                let wrench = rub.held(&solver.by_block(rubbing.block, open));
                let loose = |normal: &Vec3| normal.norm() * found.beside.length > LOOSE;
                if rubbing.contacts(rub, wrench).iter().any(loose) {
                    let what = "the force that causes its friction";
                    let sharing = found.beside.sharing(solver.system(), |open| open == number);
                    return Err(Error::not_unique(&rubbing.name, what, sharing));
                }
            }
        }
        Ok(())
    }

    fn jammed(&self, solver: &TransposedSolver<'_>, t: f64, held: Held<'_>) -> Error {
        let system = solver.system();
        let blocks = &solver.system().equations().blocks;
        let mut lambda = vec![0.0; system.n_equations()];
        for (amount, unit) in held.amounts.iter().zip(held.lambda) {
            lambda.iter_mut().zip(unit).for_each(|(all, unit)| *all += amount * unit);
        }
        let mut worst = 0.0;
        let mut name = "";
        let mut first = 0;
        for (rubbing, rub) in self.all.iter().zip(held.rubs) {
            let power = (held.amounts[first] * rub.rate).abs();
            if power >= worst {
                (worst, name) = (power, &rubbing.name);
            }
            first += rub.n_amounts();
        }
        let effort = |block: &Block| block.rows().map(|row| lambda[row].abs()).fold(0.0, f64::max);
        let all = || blocks.iter().filter(|block| block.drives);
        let largest = all().map(effort).fold(0.0, f64::max);
        let drives = all().filter(|block| effort(block) > WORKS * largest);
        let drives = drives.map(|block| block.name.clone()).collect();
        let constraint = name.to_string();
        let units = system.unit_words().clone();
        Box::new(Jammed { constraint, t, share: held.share, drives, units }).into()
    }
}

/// Forces without bound, by their directions.
struct Held<'a> {
    rubs: &'a [Rub],
    lambda: &'a [Vec<f64>],
    amounts: Vec<f64>,
    share: f64,
}
