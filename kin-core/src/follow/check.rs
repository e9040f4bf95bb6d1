//! Whether a step of time has stayed on its branch, from what is at hand: q, q̇, q̈ at both ends, pivots and their signs.
//!
//! Two solutions that are near one another lie on either side of a singular position, so det C_q differs in sign between them; and where C_q has
//! a pivot p, by the measures, no other solution is much nearer than p. So a step is good if no block of C_q has turned over and if
//! q + h q̇ + ½ h² q̈ from either end meets the other end much nearer than p. Where that is not so, the terms of second order along the miss
//! tell whether Newton's method from the prediction must end there (the estimate of Newton and Kantorovich): they see equations that
//! are linear along it, as those of a chain are in its lengths.

use crate::fours::{self, Fours};
use crate::layout::Unit;
use crate::newton::Newton;

/// A prediction may miss by this share of the smallest pivot.   \[-\]
pub(crate) const EASY: f64 = 0.05;

/// The estimate of Newton and Kantorovich, |C_q⁻¹ (C_q v)_q v| / |v| of the miss v, that is safe; ½ would still do.   \[-\]
const SAFE: f64 = 0.25;

/// No body turns by more than this in one step.   \[rad\]
pub(crate) const REACH: f64 = 1.0;

/// What is wrong with a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Objection {
    /// Too long to be judged.
    Long,
    /// A prediction from one end is too far from the other for both to be surely on one branch.
    Missed,
    /// A block of C_q has turned over.
    TurnedOver,
}

impl Objection {
    pub(crate) fn reason(self) -> &'static str {
        match self {
            Objection::Long => "a step of time turns a body too far",
            Objection::Missed => "the next position is not where this one leads",
            Objection::TurnedOver => "a loop of the mechanism has turned over",
        }
    }
}

/// One end of a step: q, q̇, q̈.
pub(crate) type End<'a> = [&'a Fours; 3];

/// What was seen at the last position that was accepted.
pub(crate) struct Check {
    negative: Vec<bool>,
    pivot: f64,
    /// The same of the position in hand.
    now: Vec<bool>,
    /// 1 for coordinates that turn, 0 for lengths.
    turns: Fours,
    miss: Fours,
}

impl Check {
    pub(crate) fn new(units: &[Unit]) -> Self {
        let turns: Vec<f64> = units.iter().map(|unit| f64::from(u8::from(*unit != Unit::Metre))).collect();
        let room = || Vec::with_capacity(units.len());
        Check { negative: room(), pivot: f64::INFINITY, now: room(), turns: turns[..].into(), miss: Fours::new(units.len(), 0.0) }
    }

    /// Takes the position in hand as it is.
    pub(crate) fn accept(&mut self, newton: &Newton<'_>) {
        newton.linear.orientation(&mut self.negative);
        self.pivot = newton.linear.smallest_pivot();
    }

    /// The position in hand is singular: the next step is judged by its other end alone.
    pub(crate) fn leave_open(&mut self) {
        self.negative.clear();
        self.pivot = f64::INFINITY;
    }

    /// Judges the step h from one end to the position in hand, and accepts that if there is no objection.
    pub(crate) fn judge(&mut self, newton: &mut Newton<'_>, h: f64, from: End<'_>) -> Result<(), Objection> {
        let (pivot, to) = (newton.linear.smallest_pivot(), [&newton.q, &newton.qd, &newton.qdd]);
        let [miss, reach] = fours::miss(h, from, to, newton.shares(), &self.turns);
        if reach > REACH {
            return Err(Objection::Long);
        }
        // Not a number counts as missed.
        if (miss.is_nan() || miss > EASY * pivot.min(self.pivot)) && !self.is_safe(newton, h, from, miss) {
            return Err(Objection::Missed);
        }
        newton.linear.orientation(&mut self.now);
        if self.now != self.negative && self.now.len() == self.negative.len() {
            return Err(Objection::TurnedOver);
        }
        std::mem::swap(&mut self.now, &mut self.negative);
        self.pivot = pivot;
        Ok(())
    }

    /// The estimate of Newton and Kantorovich at the position in hand, along the miss of the prediction; larger by as much as `miss`, which is
    /// that from either end, is larger.
    fn is_safe(&mut self, newton: &mut Newton<'_>, h: f64, [q, qd, qdd]: End<'_>, miss: f64) -> bool {
        let ends = newton.q.iter().zip(q.iter()).zip(qd.iter().zip(qdd.iter()));
        for (miss, ((to, q), (qd, qdd))) in self.miss.iter_mut().zip(ends) {
            *miss = to - q - h * (qd + 0.5 * h * qdd);
        }
        let own = fours::largest_share(self.miss.whole(), newton.shares().whole());
        own > 0.0 && newton.bend(&self.miss) * (miss / own) <= SAFE * own
    }
}
