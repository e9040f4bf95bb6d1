//! Tests whether a step of time has stayed on its branch, from existing numbers: q, q̇, q̈ at both
//! ends, pivots and their signs.
//!
//! Two neighbouring solutions are on opposite sides of a singular position, so det C_q has opposite
//! signs at the two solutions. Near a C_q with a scaled pivot p, no other solution is much nearer
//! than p. So a step is good under two conditions: no block of C_q has changed its sign, and q + h
//! q̇ + ½ h² q̈ from each end hits the other end with an error far below p. Otherwise second-order
//! terms along the error decide whether Newton's method from the prediction must end at this
//! solution (the estimate of Newton and Kantorovich). The second-order terms are zero for equations
//! that are linear along the error, such as the equations of a chain in its lengths.

use super::drive::{Drive, Lever, Span};
use crate::coordinates::units::Unit;
use crate::numbers::padded::{self, Padded};
use crate::outcome::error::UnfollowedReason;
use crate::solve::newton::Newton;
use crate::system::System;
use crate::system::evaluate::{Equations, Instant};

/// The permitted error of a prediction, as a share of the smallest pivot. \[-\]
pub(super) const EASY: f64 = 0.05;

/// The safe value of the estimate of Newton and Kantorovich, |C_q⁻¹ (C_q v)_q v| / |v| for the
/// error v. The theorem allows ½. \[-\]
pub(super) const SAFE: f64 = 0.25;

/// If the smallest pivot falls below this share of its largest value, a singular position may be
/// near. \[-\]
const FADED: f64 = 0.5;

/// The largest rotation of a body in one step. \[rad\]
pub(crate) const REACH: f64 = 1.0;

/// Returns true if a body rotates too far in a step for the test.
#[inline(always)]
pub(crate) fn turns_too_far(reach: f64) -> bool {
    reach > REACH
}

/// Returns true if the error of the prediction from one end is too large for certainty about the
/// branch; `pivot` is the smaller pivot of both ends. A NaN is too large.
#[inline(always)]
pub(crate) fn misses_too_far(miss: f64, pivot: f64) -> bool {
    let is_near = miss <= EASY * pivot;
    !is_near
}

/// The reasons to reject a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Objection {
    /// The step is too long for the test.
    Long,
    /// The prediction from one end misses the other by this value in units of order 1, too far for
    /// certainty.
    Missed(f64),
    /// A block of C_q has changed its sign.
    TurnedOver,
    /// Drivers may lead further away within the step than its ends show.
    Hidden,
}

impl Objection {
    /// Returns the reason, unless shorter steps certainly help.
    pub(crate) fn of_branches(self) -> Option<UnfollowedReason> {
        match self {
            Objection::Missed(_) | Objection::TurnedOver => Some(self.reason()),
            Objection::Long | Objection::Hidden => None,
        }
    }

    pub(crate) fn reason(self) -> UnfollowedReason {
        match self {
            Objection::Long => UnfollowedReason::TurnsTooFar,
            Objection::Missed(_) => UnfollowedReason::PredictionMissed,
            Objection::TurnedOver => UnfollowedReason::TurnedOver,
            Objection::Hidden => UnfollowedReason::HiddenDrive,
        }
    }
}

/// One end of a step: q, q̇, q̈.
pub(crate) type End<'a> = [&'a Padded; 3];

/// The data of the last accepted position, for the test of the next step.
pub(crate) struct Check {
    negative: Vec<bool>,
    pivot: f64,
    /// The largest value of the smallest pivot.
    most: f64,
    /// For each block whether its determinant is negative at the present position.
    now: Vec<bool>,
    /// 1 for coordinates that rotate, 0 for lengths.
    turns: Padded,
    miss: Padded,
    /// The motion of the drivers between the ends of a step. It does not matter if there is one
    /// position at each time.
    drive: Drive,
    explicit: bool,
}

impl Check {
    pub(crate) fn new(system: &System) -> Self {
        let units = &system.layout().units;
        let turns: Vec<f64> =
            units.iter().map(|unit| f64::from(u8::from(*unit != Unit::Metre))).collect();
        let room = || Vec::with_capacity(units.len());
        Check {
            negative: room(),
            pivot: f64::INFINITY,
            most: 0.0,
            now: room(),
            turns: turns[..].into(),
            miss: Padded::new(units.len(), 0.0),
            drive: Drive::new(system.equations()),
            explicit: system.equations().is_explicit(),
        }
    }

    /// Accepts the present position without a test.
    pub(crate) fn accept(&mut self, newton: &Newton<'_>) {
        newton.linear.orientation(&mut self.negative);
        self.pivot = newton.linear.smallest_pivot();
        self.most = self.most.max(self.pivot);
    }

    /// Returns true if the ends of a step show everything that time does in between.
    ///
    /// The function is inlined, because a call at each time of a program would cost 3 % of a small
    /// mechanism's run.
    #[inline(always)]
    pub(crate) fn ends_suffice(&mut self, from: f64, to: f64, pivot: f64) -> bool {
        self.explicit || self.drive.ends_suffice(from, to, pivot)
    }

    /// Returns true if the ends of any step show everything, whatever the velocities of the laws
    /// are. Laws with velocities that are unlike one another must be in place.
    #[cold]
    pub(crate) fn ends_always_suffice(&mut self, equations: &Equations, instant: &Instant) -> bool {
        self.explicit || self.drive.ends_always_suffice(equations, instant)
    }

    /// Discards everything known of the laws.
    pub(crate) fn forget_laws(&mut self, equations: &Equations) {
        if !self.explicit {
            self.drive.forget(equations);
        }
    }

    /// Returns true if equations without bounds may be sampled before the next single step examines
    /// them.
    pub(crate) fn may_sample(&self) -> bool {
        self.drive.may_sample()
    }

    /// Returns true if samples of equations without bounds show that the step contains nothing
    /// hidden. The instant is that of its end.
    pub(crate) fn samples_suffice(&mut self, span: Span<'_>, instant: &Instant) -> bool {
        self.drive.samples_suffice(span, instant)
    }

    /// Records that the compiled program accepted positions on the same sides of all singular ones.
    /// `pivot` is the smallest pivot of the last one.
    pub(crate) fn go_on(&mut self, pivot: f64) {
        self.pivot = pivot;
    }

    /// Marks the present position as singular: only the other end of the next step counts.
    pub(crate) fn leave_open(&mut self) {
        self.negative.clear();
        self.pivot = f64::INFINITY;
    }

    /// Tests the step h from one end to the present position, and accepts it if there is no
    /// objection.
    #[inline(always)]
    pub(crate) fn judge(
        &mut self,
        newton: &mut Newton<'_>,
        h: f64,
        from: End<'_>,
    ) -> Result<(), Objection> {
        let pivot = newton.linear.smallest_pivot();
        let to = [&newton.q, &newton.qd, &newton.qdd];
        let [miss, reach] = padded::miss(h, from, to, newton.shares(), &self.turns);
        if turns_too_far(reach) {
            return Err(Objection::Long);
        }
        newton.linear.orientation(&mut self.now);
        let t = newton.instant.t();
        let least = pivot.min(self.pivot);
        if misses_too_far(miss, least) && !self.is_safe(newton, h, from, miss) {
            return Err(Objection::Missed(miss));
        }
        if self.now != self.negative && self.now.len() == self.negative.len() {
            return Err(Objection::TurnedOver);
        }
        let [from, to] = [t - h, t];
        if !self.ends_suffice(from, to, least) && self.hides(newton, from, to, least) {
            return Err(Objection::Hidden);
        }
        std::mem::swap(&mut self.now, &mut self.negative);
        self.pivot = pivot;
        self.most = self.most.max(pivot);
        Ok(())
    }

    /// Returns true if something may happen between two times that their positions do not show.
    #[cold]
    fn hides(&mut self, newton: &mut Newton<'_>, from: f64, to: f64, pivot: f64) -> bool {
        let equations = newton.system.equations();
        let fades = newton.linear.smallest_pivot() / pivot;
        let mut lever =
            Factored { newton, v: &mut self.miss, turns: &self.turns, negative: &self.now, fades };
        self.drive.hides(Span { equations, from, to, pivot }, &mut lever)
    }

    /// Returns the estimate of Newton and Kantorovich at the present position along the error of
    /// the prediction, scaled up by `miss`, the larger error of both ends.
    fn is_safe(
        &mut self,
        newton: &mut Newton<'_>,
        h: f64,
        [q, qd, qdd]: End<'_>,
        miss: f64,
    ) -> bool {
        let ends = newton.q.iter().zip(q.iter()).zip(qd.iter().zip(qdd.iter()));
        for (miss, ((to, q), (qd, qdd))) in self.miss.iter_mut().zip(ends) {
            *miss = to - q - h * (qd + 0.5 * h * qdd);
        }
        let own = padded::largest_share(self.miss.whole(), newton.shares().whole());
        let turned = padded::largest_share(self.miss.whole(), self.turns.whole()) * (miss / own);
        let straight =
            own > 0.0 && turned <= REACH && newton.bend(&self.miss) * (miss / own) <= SAFE * own;
        let fades = newton.linear.smallest_pivot().min(self.pivot) < FADED * self.most;
        straight && !(fades && is_singular_near(newton, &self.miss, miss / own, &self.now))
    }
}

/// Returns true if C_q may be singular within factor · v of the present position: at either end a
/// block has another sign, or the smallest pivot is less than half of its present value. A change
/// point that is passed smoothly along a branch shows in nothing else.
#[cold]
fn is_singular_near(newton: &mut Newton<'_>, v: &[f64], factor: f64, negative: &[bool]) -> bool {
    let t = newton.instant.t();
    let here = newton.q.clone();
    let pivot = newton.linear.smallest_pivot();
    let mut signs = Vec::new();
    let mut is_regular = |factor: f64| {
        newton
            .q
            .iter_mut()
            .zip(here.iter().zip(v))
            .for_each(|(q, (here, v))| *q = here + factor * v);
        let factored = newton.linearize(t).is_ok() && newton.linear.factor();
        newton.linear.orientation(&mut signs);
        factored && signs == negative && newton.linear.smallest_pivot() >= 0.5 * pivot
    };
    let is_singular = !(is_regular(-factor) && is_regular(factor));
    newton.linear.revoke();
    newton.q.copy_from_slice(&here);
    let restored = newton.linearize(t).is_ok() && newton.linear.factor();
    is_singular || !restored
}

/// The present matrix as a lever.
struct Factored<'f, 'a> {
    newton: &'f mut Newton<'a>,
    v: &'f mut Padded,
    turns: &'f Padded,
    negative: &'f [bool],
    /// How many times smaller the smallest pivot is at the other end of the step. A motor that
    /// leads beyond both ends starts from the nearer one, where q moves as much further and a
    /// singular position is as much nearer.
    fades: f64,
}

impl Lever for Factored<'_, '_> {
    fn instant(&self) -> &Instant {
        &self.newton.instant
    }

    fn moved(&mut self, first: usize, b: &[f64]) -> f64 {
        let linear = &mut self.newton.linear;
        linear.rhs_mut().fill(0.0);
        linear.rhs_mut().iter_mut().skip(first).zip(b).for_each(|(place, b)| *place = *b);
        linear.solve();
        padded::take(self.v.whole_mut(), linear.whole_solution());
        padded::largest_share(self.v.whole(), self.newton.shares().whole())
    }

    fn bend(&mut self) -> f64 {
        self.fades * self.newton.bend(self.v)
    }

    fn turned(&self) -> f64 {
        padded::largest_share(self.v.whole(), self.turns.whole())
    }

    fn is_singular_within(&mut self, factor: f64) -> bool {
        is_singular_near(self.newton, self.v, self.fades * factor, self.negative)
    }
}

#[cfg(test)]
mod tests;
