//! Computes energies and the balance of powers.

use std::fmt;

use super::acting::{Beside, Laid, Now};
use super::inverse;
use super::multipliers::not_numbers;
use super::sum::{At, Sum};
use crate::outcome::motion::Series;
use crate::solve::motion::Motion;
use crate::system::System;

/// The kinetic and potential energy over time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Energy {
    /// T = Σ ½ m v_c² + ½ ω · J ω.   \[J\]
    pub kinetic: Series,
    /// V = −Σ m g · r_c + Σ V of loads that are energies.   \[J\]
    pub potential: Series,
}

/// The balance of powers over time: the power of constraints, loads and weight, and the difference
/// from dT/dt.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Balance {
    /// λ · C_t of all constraints: the power of the drivers. \[W\]
    pub drives: Series,
    /// The power of loads and of weight.   \[W\]
    pub loads: Series,
    /// The power of friction in joints. Friction dissipates power, so the values are at most zero.
    /// \[W\]
    pub friction: Series,
    /// The derivative dT/dt of the kinetic energy. Kin differentiates T along the motion and does
    /// not use the balance of forces. \[W\]
    pub kinetic: Series,
    /// The power of drivers, loads and friction minus dT/dt. The difference is zero except for
    /// rounding. \[W\]
    pub left: Series,
    /// The largest power of any force (of a driver, a load, weight, inertia) on any coordinate at
    /// any time. Rounding errors are proportional to this power. \[W\]
    pub largest: f64,
}

/// The powers at all times, one list for each kind.
pub(super) struct Powers {
    rate: Vec<f64>,
    drives: Vec<f64>,
    loads: Vec<f64>,
    friction: Vec<f64>,
    largest: Vec<f64>,
}

impl Powers {
    pub(super) fn new(times: usize) -> Self {
        // Every time fills its numbers. Friction is appended instead, because a compiled program
        // has none.
        let [rate, drives, loads, largest] = [(); 4].map(|()| not_numbers(times));
        Powers { rate, drives, loads, friction: vec![0.0; times], largest }
    }

    /// Returns the lists that a program fills: dT/dt, the powers of drivers, of loads with weight,
    /// and the largest power.
    pub(super) fn of_tape(&mut self) -> [&mut Vec<f64>; 4] {
        let Powers { rate, drives, loads, largest, .. } = self;
        [rate, drives, loads, largest]
    }

    /// Stores the powers of time k.
    pub(super) fn set(&mut self, k: usize, at: &At) {
        self.friction[k] = at.friction;
        let all = [at.rate, at.drives, at.loads + at.weight, at.largest];
        self.of_tape().into_iter().zip(all).for_each(|(list, x)| list[k] = x);
    }

    pub(super) fn balance(self, motion: &Motion) -> Balance {
        let Powers { rate, drives, loads, friction, largest } = self;
        let largest = f64::max(largest_of(&largest), largest_of(&drives));
        let given = drives.iter().zip(&loads).zip(&friction);
        let left: Vec<f64> = given
            .zip(&rate)
            .map(|(((drives, loads), lost), rate)| drives + loads + lost - rate)
            .collect();
        let unit = motion.unit_words().power();
        let left = Series::new("left", unit.clone(), motion.clock(), left);
        let power = |name: &str, list| left.beside(name, unit.clone(), list);
        Balance {
            drives: power("drives", drives),
            loads: power("loads", loads),
            friction: power("friction", friction),
            kinetic: power("T'", rate),
            left,
            largest,
        }
    }
}

/// Returns the largest magnitude of a list, several numbers at once. NaN does not count.
fn largest_of(list: &[f64]) -> f64 {
    const SIDE: usize = 8;
    let larger = |most: f64, x: f64| if x.abs() > most { x.abs() } else { most };
    let (many, few) = list.as_chunks::<SIDE>();
    let mut most = [0.0; SIDE];
    for own in many {
        most = std::array::from_fn(|k| larger(most[k], own[k]));
    }
    few.iter().chain(&most).fold(0.0, |most, x| larger(most, *x))
}

impl Energy {
    /// Computes the energies along a motion: with a compiled program if that is faster, otherwise
    /// time by time.
    pub(super) fn along(system: &System, motion: &Motion, loads: &[(&str, Laid<'_>)]) -> Energy {
        let tape =
            inverse::pays(motion).then(|| inverse::energies(system, motion, loads)).flatten();
        let [kinetic, potential] = tape.unwrap_or_else(|| {
            let points = Beside::points(system);
            let mut sum = Sum::new(system, loads, &points);
            let at = |k: usize| {
                let now = Now {
                    t: motion.times()[k],
                    q: motion.q(k),
                    qd: motion.qd(k),
                    qdd: motion.qdd(k),
                };
                // The forces at this time are already known, so no error can occur.
                sum.at(now).map_or([f64::NAN; 2], |at| [at.kinetic, at.potential])
            };
            let (kinetic, potential) = (0..motion.len()).map(at).map(<(f64, f64)>::from).unzip();
            [kinetic, potential]
        });
        let unit = motion.unit_words().energy();
        let kinetic = Series::new("T", unit.clone(), motion.clock(), kinetic);
        Energy { potential: kinetic.beside("V", unit, potential), kinetic }
    }
}

impl Balance {
    /// Returns the largest difference of the balance as a share of the largest power, or 0 if all
    /// powers are zero. \[-\]
    pub fn worst(&self) -> f64 {
        let left = self.left.max().abs().max(self.left.min().abs());
        if left == 0.0 { 0.0 } else { left / self.largest }
    }
}

impl fmt::Display for Balance {
    /// Writes "power balance: drives + loads − kinetic energy's rate = 3e-15 of 41 W at most."
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rubs = if self.friction.min() < 0.0 { " + friction" } else { "" };
        write!(
            f,
            "power balance: drives + loads{rubs} − kinetic energy's rate = {:.0e} of {:.3} {} at most.",
            self.worst(),
            self.largest,
            self.left.unit()
        )
    }
}
