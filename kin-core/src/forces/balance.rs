//! Energies, and the balance of powers.

use std::fmt;

use super::calls::At;
use crate::model::motion::Series;
use crate::solve::motion::Motion;

/// Kinetic and potential energy over time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Energy {
    /// T = Σ ½ m v_c² + ½ ω · J ω.   \[J\]
    pub kinetic: Series,
    /// V = −Σ m g · r_c + Σ V of loads that are energies.   \[J\]
    pub potential: Series,
}

/// The balance of powers over time: what constraints and loads put in, weight among them, and what is left of
/// it beyond dT/dt.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Balance {
    /// λ · C_t of all constraints: the power of the drives.   \[W\]
    pub drives: Series,
    /// The power of loads and of weight.   \[W\]
    pub loads: Series,
    /// The power of friction in joints, which is lost: at most zero.   \[W\]
    pub friction: Series,
    /// dT/dt, by differentiating T along the motion: not by the balance of forces.   \[W\]
    pub kinetic: Series,
    /// Power of drives, loads and friction less dT/dt.   \[W\]
    pub left: Series,
    /// The largest power that any force (of a drive, a load, weight, inertia) has on any coordinate at any
    /// time: rounding is a share of that.   \[W\]
    pub largest: f64,
}

/// Energies and powers as they are gathered on the way.
pub(super) struct Powers(Vec<At>);

impl Powers {
    pub(super) fn new(times: usize) -> Self {
        Powers(Vec::with_capacity(times))
    }

    pub(super) fn push(&mut self, at: At) {
        self.0.push(at);
    }

    pub(super) fn energy_and_balance(self, motion: &Motion) -> (Energy, Balance) {
        let units = motion.unit_words();
        let series = |name: &str, unit: String, of: &dyn Fn(&At) -> f64| {
            Series::new(name, unit, motion.clock(), self.0.iter().map(of).collect())
        };
        let power = |name: &str, of: &dyn Fn(&At) -> f64| series(name, units.power(), of);
        let largest = self.0.iter().fold(0.0_f64, |m, at| m.max(at.largest).max(at.drives.abs()));
        let energy = Energy {
            kinetic: series("T", units.energy(), &|at| at.kinetic),
            potential: series("V", units.energy(), &|at| at.potential),
        };
        let balance = Balance {
            drives: power("drives", &|at| at.drives),
            loads: power("loads", &|at| at.loads + at.weight),
            friction: power("friction", &|at| at.friction),
            kinetic: power("T'", &|at| at.rate),
            left: power("left", &|at| at.drives + at.loads + at.weight + at.friction - at.rate),
            largest,
        };
        (energy, balance)
    }
}

impl Balance {
    /// The largest power that is left over, as a share of the largest power; 0 where nothing has
    /// power.   \[-\]
    pub fn worst(&self) -> f64 {
        let left = self.left.max().abs().max(self.left.min().abs());
        if left == 0.0 { 0.0 } else { left / self.largest }
    }
}

impl fmt::Display for Balance {
    /// "power balance: drives + loads − kinetic energy's rate = 3e-15 of 41 W at most."
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
