//! A constraint that prescribes a measure of a joint.

use std::f64::consts::TAU;

use crate::coordinates::Argument;
use crate::law::Law;
use crate::model::constraint::{Constraint, Entry, Facts, Measured, Parameters, Parts};
use crate::model::state::{At, Rates};
use crate::numbers::Offsets;

/// The name of its law.
pub(super) const LAW: &str = "law";

/// Makes a measure m of a joint follow a law of time: m(q) − f(t) = 0. An angle of which only the
/// remainder of whole turns is known counts up to whole turns.
#[derive(Clone)]
pub(super) struct Prescribed {
    joint: Box<dyn Constraint>,
    /// The number of the measure among those of the joint.
    number: usize,
    turns: bool,
    law: Law,
    /// One entry for each column of the joint.
    pattern: Vec<Entry>,
    /// The place of each argument in a list of the columns of this joint alone.
    places: Vec<Offsets>,
}

impl Prescribed {
    pub(super) fn new(joint: Box<dyn Constraint>, number: usize, measured: Measured) -> Self {
        let mut columns = 0;
        let mut places = Vec::new();
        for argument in joint.arguments() {
            places.push(Offsets::new(0, columns as u32));
            columns += argument.target.columns();
        }
        let pattern = (0..columns).map(|column| Entry::new(0, column)).collect();
        let turns = measured.turns;
        Prescribed { joint, number, turns, law: Law::constant(0.0), pattern, places }
    }

    /// Returns true if the measure can depend on time too. Its derivatives by time are then left
    /// out, because time stands still.
    fn is_timed(&self) -> bool {
        self.joint.facts().is_driver
    }

    /// Returns the measure and its derivatives along q̇ and no further rates.
    fn along(&self, at: &At<'_>, rates: &Rates<'_>) -> [f64; 4] {
        let none = vec![0.0; self.pattern.len()];
        let still = Rates::new(&none, &self.places);
        self.joint.measure(self.number, at, &[*rates, still, still])
    }

    /// Returns the measure at rest; its derivatives are those by time.
    fn at_rest(&self, at: &At<'_>) -> [f64; 4] {
        let none = vec![0.0; self.pattern.len()];
        self.along(at, &Rates::new(&none, &self.places))
    }
}

impl Constraint for Prescribed {
    fn facts(&self) -> Facts<'_> {
        Facts {
            description: "Makes a measure of a joint have a given value.",
            rows: &["value"],
            pattern: &self.pattern,
            is_driver: true,
            has_branches: false,
            ..Facts::of("prescribed")
        }
    }

    fn arguments(&self) -> Vec<Argument> {
        self.joint.arguments()
    }

    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        let off = self.at_rest(at)[0] - self.law.at(at.t);
        let whole = if self.turns { TAU * (off / TAU).round() } else { 0.0 };
        c.iter_mut().take(1).for_each(|c| *c = off - whole);
    }

    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]) {
        let by_time = if self.is_timed() { self.at_rest(at)[1] } else { 0.0 };
        let mut unit = vec![0.0; self.pattern.len()];
        for (column, place) in c_q.iter_mut().take(self.pattern.len()).enumerate() {
            unit[column] = 1.0;
            *place = self.along(at, &Rates::new(&unit, &self.places))[1] - by_time;
            unit[column] = 0.0;
        }
    }

    fn velocity_rhs(&self, at: &At<'_>, rhs: &mut [f64]) {
        rhs.iter_mut().take(1).for_each(|rhs| *rhs = self.law.jet(at.t)[1]);
    }

    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
        let bend = if self.is_timed() {
            let [back, forth] = [-1.0, 1.0].map(|sign| {
                let rates: Vec<f64> = self
                    .joint
                    .arguments()
                    .iter()
                    .enumerate()
                    .flat_map(|(k, argument)| qd.columns(k, argument.target.columns()))
                    .map(|rate| sign * rate)
                    .collect();
                self.along(at, &Rates::new(&rates, &self.places))[2]
            });
            0.5 * (back + forth) - self.at_rest(at)[2]
        } else {
            self.along(at, qd)[2]
        };
        let law = t_dot * t_dot * self.law.jet(at.t)[2];
        q_d.iter_mut().take(1).for_each(|q_d| *q_d = law - bend);
    }

    fn jerk_rhs(&self, at: &At<'_>, qd: &Rates<'_>, qdd: &Rates<'_>, rhs: &mut [f64]) -> bool {
        if self.is_timed() {
            return false;
        }
        let none = vec![0.0; self.pattern.len()];
        let still = Rates::new(&none, &self.places);
        let [.., third] = self.joint.measure(self.number, at, &[*qd, *qdd, still]);
        rhs.iter_mut().take(1).for_each(|rhs| *rhs = self.law.jet(at.t)[3] - third);
        true
    }

    fn parts(&self) -> Parts<'_> {
        Parts { parameters: Some(self), written: None }
    }

    fn parameters_mut(&mut self) -> Option<&mut dyn Parameters> {
        Some(self)
    }
}

impl Parameters for Prescribed {
    fn parameters(&self, _visit: &mut dyn FnMut(&str, f64)) {}

    fn set_parameter(&mut self, _name: &str, _value: f64) -> bool {
        false
    }

    fn set_law(&mut self, name: &str, law: &Law) -> bool {
        if name == LAW {
            self.law = law.clone();
        }
        name == LAW
    }
}
