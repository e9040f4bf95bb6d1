//! Solves for the normal forces of all contacts by Newton's method, while friction grows from zero
//! to its full size.
//!
//! With a share s of friction the normal forces satisfy X = X₀ + s A(X). The function A is
//! positively homogeneous: twice the forces cause twice the friction. So X = Y/w with
//!
//! ```text
//! Y − w X₀ − s A(Y) = 0,   |Y|² + w² = 1,
//! ```
//!
//! Y remains bounded where X does not: the forces X grow without bound as w falls to zero. If w is
//! negative, every push would be a pull. Kin follows the curve from s = 0, where the curve gives
//! the solution without friction.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::rubbing::{Rub, Rubbing};
use crate::numbers::algebra::Vec3;

/// The friction law of one joint.
struct Law {
    contacts: Range<usize>,
    /// Friction along the axis for one newton of normal forces.
    along: f64,
    /// Friction across the axis for one newton of force across.
    across: f64,
    directions: Vec<Vec3>,
}

/// The amounts of friction from the normal forces at contacts, and the contacts from the amounts.
pub(super) struct Laws<'a> {
    all: Vec<Law>,
    n_amounts: usize,
    by_amounts: &'a DMatrix<f64>,
}

/// The normal forces with full friction, or those that have grown without bound.
pub(super) enum Grown {
    Whole(DVector<f64>),
    Jammed { share: f64, contacts: DVector<f64> },
}

/// The w at which forces are 1e12 times those without friction. \[-\]
const BOUND: f64 = 1e-12;

/// The largest distance of a step from the preceding position. \[-\]
const NEAR: f64 = 0.3;

/// The smallest step of the share. If no step of this size is possible, the curve turns back. \[-\]
const SMALLEST: f64 = 1e-9;

/// The largest number of steps of the curve; about twenty are usual in hard cases.
const STEPS: usize = 1000;

/// The largest number of Newton steps. A kink where a force changes its side costs one.
const ITERATIONS: usize = 20;

/// A point (Y, w) of the curve.
#[derive(Clone)]
struct Station {
    y: DVector<f64>,
    w: f64,
}

impl<'a> Laws<'a> {
    pub(super) fn new(all: &[Rubbing], rubs: &[Rub], by_amounts: &'a DMatrix<f64>) -> Laws<'a> {
        let mut laws = Vec::new();
        let mut first = 0;
        let mut n_amounts = 0;
        for (rubbing, rub) in all.iter().zip(rubs) {
            let contacts = first..first + rubbing.n_contacts();
            (first, n_amounts) = (contacts.end, n_amounts + rub.n_amounts());
            let [along, across] = rubbing.by_normal_force(rub.rate);
            laws.push(Law { contacts, along, across, directions: rub.across().to_vec() });
        }
        Laws { all: laws, n_amounts, by_amounts }
    }

    /// Returns a share of the friction that the normal forces cause.
    pub(super) fn amounts(&self, contacts: &DVector<f64>, share: f64) -> Vec<f64> {
        let mut all = Vec::with_capacity(self.n_amounts);
        for law in &self.all {
            let normals = law.contacts.clone().map(|k| normal(contacts, k));
            all.push(share * law.along * normals.map(|normal| normal.norm()).sum::<f64>());
            // The contact across the width of a guide has its force along the axis and is not
            // included here.
            let force =
                law.contacts.clone().fold(Vec3::zeros(), |force, k| force + normal(contacts, k));
            all.extend(law.directions.iter().map(|u| share * law.across * u.dot(force)));
        }
        all
    }

    /// Returns the derivatives of the amounts by the components of the normal forces.
    fn slopes(&self, contacts: &DVector<f64>) -> DMatrix<f64> {
        let mut slopes = DMatrix::zeros(self.n_amounts, contacts.len());
        let mut row = 0;
        for law in &self.all {
            for k in law.contacts.clone() {
                let normal = normal(contacts, k);
                // A contact without force has a zero slope.
                let size = normal.norm();
                let way = if size > 0.0 { normal * (1.0 / size) } else { Vec3::zeros() };
                for (axis, way) in way.to_array().into_iter().enumerate() {
                    slopes[(row, 3 * k + axis)] = law.along * way;
                }
            }
            for (number, u) in law.directions.iter().enumerate() {
                for k in law.contacts.clone() {
                    for (axis, u) in u.to_array().into_iter().enumerate() {
                        slopes[(row + 1 + number, 3 * k + axis)] = law.across * u;
                    }
                }
            }
            row += 1 + law.directions.len();
        }
        slopes
    }

    /// Returns the normal forces with friction from those without.
    pub(super) fn grow(&self, without: &DVector<f64>) -> Grown {
        let size = without.amax();
        if size == 0.0 {
            return Grown::Whole(without.clone());
        }
        let start = without / size;
        let norm = (start.norm_squared() + 1.0).sqrt();
        let mut place = Station { y: &start / norm, w: 1.0 / norm };
        let mut share = 0.0;
        let mut step = 1.0_f64;
        for _ in 0..STEPS {
            let next = (share + step).min(1.0);
            match self.corrected(&place, &start, next) {
                Some(found) if found.w > BOUND => (place, share, step) = (found, next, 2.0 * step),
                Some(_) => return self.unbounded(place, &start, [share, next]),
                None => step *= 0.5,
            }
            if share == 1.0 {
                return Grown::Whole(place.y * (size / place.w));
            }
            if step < SMALLEST {
                break;
            }
        }
        Grown::Jammed { share, contacts: place.y }
    }

    /// Returns the share at which w falls to zero, between two shares.
    fn unbounded(
        &self,
        mut place: Station,
        start: &DVector<f64>,
        [mut from, mut to]: [f64; 2],
    ) -> Grown {
        while to - from > 1e-15 {
            let middle = 0.5 * (from + to);
            match self.corrected(&place, start, middle) {
                Some(found) if found.w > BOUND => (place, from) = (found, middle),
                _ => to = middle,
            }
        }
        Grown::Jammed { share: to, contacts: place.y }
    }

    /// Runs Newton's method at one share. Returns `None` if it does not converge nearby.
    fn corrected(&self, from: &Station, start: &DVector<f64>, share: f64) -> Option<Station> {
        let n = start.len();
        let mut at = from.clone();
        for _ in 0..ITERATIONS {
            let amounts = DVector::from_vec(self.amounts(&at.y, share));
            let left = &at.y - start * at.w - self.by_amounts * amounts;
            let slopes = self.by_amounts * self.slopes(&at.y) * share;
            let mut matrix = DMatrix::identity(n + 1, n + 1);
            let mut square = matrix.view_mut((0, 0), (n, n));
            square -= slopes;
            for k in 0..n {
                matrix[(k, n)] = -start[k];
                matrix[(n, k)] = 2.0 * at.y[k];
            }
            matrix[(n, n)] = 2.0 * at.w;
            let mut rhs = DVector::zeros(n + 1);
            rhs.rows_mut(0, n).copy_from(&-left);
            rhs[n] = 1.0 - at.y.norm_squared() - at.w * at.w;
            let step = matrix.lu().solve(&rhs)?;
            let size = step.norm();
            if !size.is_finite() {
                return None;
            }
            at.y += step.rows(0, n);
            at.w += step[n];
            if size < 1e-12 {
                let near =
                    ((&at.y - &from.y).norm_squared() + (at.w - from.w).powi(2)).sqrt() < NEAR;
                return near.then_some(at);
            }
        }
        None
    }
}

fn normal(contacts: &DVector<f64>, k: usize) -> Vec3 {
    Vec3::new(contacts[3 * k], contacts[3 * k + 1], contacts[3 * k + 2])
}
