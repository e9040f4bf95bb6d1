//! Energies, and the balance of powers.

use std::fmt;

use super::sum::At;
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

/// Energies and powers as they are gathered on the way, one list for each.
pub(super) struct Powers {
    kinetic: Vec<f64>,
    potential: Vec<f64>,
    rate: Vec<f64>,
    drives: Vec<f64>,
    loads: Vec<f64>,
    friction: Vec<f64>,
    largest: Vec<f64>,
}

impl Powers {
    pub(super) fn new(times: usize) -> Self {
        let list = || vec![0.0; times];
        let [kinetic, potential, rate, drives, loads, friction, largest] = [(); 7].map(|()| list());
        Powers { kinetic, potential, rate, drives, loads, friction, largest }
    }

    /// The lists that a program fills: T, V, dT/dt, powers of drives, of loads with weight, the largest one.
    pub(super) fn of_tape(&mut self) -> [&mut Vec<f64>; 6] {
        let Powers { kinetic, potential, rate, drives, loads, largest, .. } = self;
        [kinetic, potential, rate, drives, loads, largest]
    }

    /// Those of time k.
    pub(super) fn set(&mut self, k: usize, at: &At) {
        self.friction[k] = at.friction;
        let all = [at.kinetic, at.potential, at.rate, at.drives, at.loads + at.weight, at.largest];
        self.of_tape().into_iter().zip(all).for_each(|(list, x)| list[k] = x);
    }

    pub(super) fn energy_and_balance(self, motion: &Motion) -> (Energy, Balance) {
        let Powers { kinetic, potential, rate, drives, loads, friction, largest } = self;
        let units = motion.unit_words();
        let series = |name: &str, unit: String, list| Series::new(name, unit, motion.clock(), list);
        let power = |name: &str, list| series(name, units.power(), list);
        let largest = largest.iter().chain(&drives).fold(0.0_f64, |m, power| m.max(power.abs()));
        let left = |k: usize| drives[k] + loads[k] + friction[k] - rate[k];
        let left = (0..rate.len()).map(left).collect();
        let energy = Energy {
            kinetic: series("T", units.energy(), kinetic),
            potential: series("V", units.energy(), potential),
        };
        let balance = Balance {
            drives: power("drives", drives),
            loads: power("loads", loads),
            friction: power("friction", friction),
            kinetic: power("T'", rate),
            left: power("left", left),
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
