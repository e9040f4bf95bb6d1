//! Computes the pose of a motion at and near its change points, where C_q is singular and Newton's
//! method cannot solve a pose.
//!
//! Kin computes the pose from the branch on which the motion arrives and the branch on which the
//! motion continues.

use super::fine::rows;
use crate::outcome::error::Result;
use crate::outcome::motion::{Branch, SingularKind, SingularPosition};
use crate::solve::motion::Motion;
use crate::solve::newton::Outcome;
use crate::solve::options::SolverOptions;
use crate::solve::run::Run;
use crate::system::System;

/// The largest displacement between a change point and the poses computed from its branches. A
/// branch is of second order, so the error of such a pose is 1e-15. The error of a solved pose
/// grows near the change point, and is 1e-11 at this distance. \[-\]
const BESIDE: f64 = 1e-5;

/// A time nearer than this share counts as the change point itself, which is known to 1e-10. \[-\]
const AT: f64 = 1e-3;

/// The displacement between a change point and the pose that shows on which branch the motion
/// arrives. \[-\]
const BEFORE: f64 = 1e-2;

/// The displacement to the nearest pose at which the jerk is computed. \[-\]
const JERK: f64 = 0.02;

/// The change points of a motion, in its order.
pub(super) struct Changes(Vec<Change>);

/// A change point of a motion.
struct Change {
    t: f64,
    q: Vec<f64>,
    /// The branch on which the motion arrives, and the one on which it continues.
    before: Branch,
    after: Branch,
    /// The time in which nothing moves by more than [`BESIDE`]. \[s\]
    near: f64,
    /// −1 if the motion runs backwards in time, otherwise 1.
    sense: f64,
}

impl Changes {
    /// Returns the change points of a motion. A run with default options finds out on which branch
    /// it arrives at each of them.
    pub(super) fn of(system: &System, motion: &Motion) -> Self {
        let found = motion.singular_positions().iter();
        let bifurcations = found.filter(|found| found.kind == SingularKind::Bifurcation);
        let mut all: Vec<Change> = Vec::new();
        for position in bifurcations {
            all.extend(Change::of(system, motion, position, all.last()));
        }
        Changes(all)
    }

    /// Returns the times at and near change points at which a step of the motion must be divided,
    /// in the order of the motion.
    pub(super) fn cuts(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
        let within = move |t: &f64| (t - from) * (t - to) < 0.0;
        let beside =
            |change: &Change| [-1.0, 0.0, 1.0].map(|k| change.t + k * change.sense * change.near);
        self.0
            .iter()
            .filter(move |change| within(&change.t))
            .flat_map(beside)
            .filter(move |t| within(t))
    }

    /// Appends the pose at a time near a change point. Returns false if there is none near.
    pub(super) fn add(&self, system: &System, t: f64, jerk: bool, to: &mut Motion) -> Result<bool> {
        let beside = self.0.iter().filter(|change| (t - change.t).abs() <= change.near);
        let nearest = beside.min_by(|a, b| (t - a.t).abs().total_cmp(&(t - b.t).abs()));
        let Some(change) = nearest else { return Ok(false) };
        let qddd = if jerk { change.jerk(system, t)? } else { Vec::new() };
        let [q, qd, qdd] = change.pose(t);
        let mut residual = 0.0;
        let mut worst = 0;
        for (k, c) in system.residual(&q, t)?.iter().enumerate() {
            if c.abs() > residual {
                (residual, worst) = (c.abs(), k);
            }
        }
        to.append(t, [&q, &qd, &qdd, &qddd], Outcome { iterations: 0, residual }, worst);
        Ok(true)
    }
}

impl Change {
    /// Returns `None` if no branch is known. `last` is the preceding change point.
    fn of(
        system: &System,
        motion: &Motion,
        at: &SingularPosition,
        last: Option<&Change>,
    ) -> Option<Self> {
        let after = at.branches.first()?;
        let sizes = system.model().measure(&at.q, at.t).sizes;
        let rate = |x: &f64, size: &f64| x.abs() / size;
        let fastest = at.branches.iter().fold(0.0_f64, |most, Branch { qd, qdd }| {
            let first = qd.iter().zip(&sizes).fold(most, |m, (x, size)| m.max(rate(x, size)));
            qdd.iter().zip(&sizes).fold(first, |m, (x, size)| m.max(rate(x, size).sqrt()))
        });
        let sense = if motion.times().last() < motion.times().first() { -1.0 } else { 1.0 };
        let near = if fastest > 0.0 && fastest.is_finite() { BESIDE / fastest } else { 0.0 };
        let t = at.t;
        let q = at.q.clone();
        let before = after.clone();
        let mut change = Change { t, q, before, after: after.clone(), near, sense };
        if let Some(pose) = change.pose_before(system, motion, BEFORE / BESIDE * near, last) {
            let off = |branch: &Branch| {
                let there = moved(&change.q, branch, pose.times()[0] - t);
                let each = there[0].iter().zip(pose.q(0)).zip(&sizes);
                each.fold(0.0_f64, |m, ((a, b), size)| m.max((a - b).abs() / size))
            };
            let nearest = at.branches.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
            change.before = nearest.unwrap_or(after).clone();
        }
        Some(change)
    }

    /// Returns a pose of the motion at most this time before the change point. Returns `None` if it
    /// cannot be reached from the preceding time or change point.
    fn pose_before(
        &self,
        system: &System,
        motion: &Motion,
        long: f64,
        last: Option<&Change>,
    ) -> Option<Motion> {
        let is_before = |t: f64| self.sense * (self.t - t) > self.near;
        let k = motion.times().iter().rposition(|t| is_before(*t))?;
        let from = match last.filter(|last| self.sense * (last.t - motion.times()[k]) > 0.0) {
            None => rows(system, motion, k..k + 1),
            Some(last) => {
                let t = last.t + last.sense * last.near;
                let [q, qd, qdd] = last.pose(t);
                let mut pose = Motion::new(system, 1);
                pose.append(t, [&q, &qd, &qdd, &[]], Outcome { iterations: 0, residual: 0.0 }, 0);
                pose
            }
        };
        let left = self.sense * (self.t - from.times()[0]);
        let t = self.t - self.sense * long.min(0.5 * left);
        let options = SolverOptions::default();
        let mut pose = Motion::new(system, 1);
        Run::new(system, &options, None).ok()?.go_from(&from, 0, t, &mut pose).ok()?;
        Some(pose)
    }

    /// Returns true for a time at which the motion is still on the branch on which it arrives.
    fn is_before(&self, t: f64) -> bool {
        self.sense * (self.t - t) > AT * self.near
    }

    /// Returns the branch of the motion at a time.
    fn branch(&self, t: f64) -> &Branch {
        if self.is_before(t) { &self.before } else { &self.after }
    }

    fn pose(&self, t: f64) -> [Vec<f64>; 3] {
        moved(&self.q, self.branch(t), t - self.t)
    }

    /// Returns q⃛ at a time, by cubic extrapolation from four poses on its side of the change
    /// point.
    fn jerk(&self, system: &System, t: f64) -> Result<Vec<f64>> {
        let branch = self.branch(t);
        let step = JERK / BESIDE * self.near;
        let side = if self.is_before(t) { -self.sense } else { self.sense };
        let mut jerk = vec![0.0; self.q.len()];
        for (steps, weight) in [(1.0, 4.0), (2.0, -6.0), (3.0, 4.0), (4.0, -1.0)] {
            let h = side * steps * step;
            let [q, ..] = moved(&self.q, branch, h);
            let pose = system.pose_near(self.t + h, &q, true)?;
            jerk.iter_mut().zip(pose.qddd(0)).for_each(|(jerk, qddd)| *jerk += weight * qddd);
        }
        Ok(jerk)
    }
}

/// Returns q, q̇ and q̈ on a branch, a time h after q.
fn moved(q: &[f64], Branch { qd, qdd }: &Branch, h: f64) -> [Vec<f64>; 3] {
    let each = q.iter().zip(qd.iter().zip(qdd));
    let there = each.map(|(q, (qd, qdd))| q + h * (qd + 0.5 * h * qdd)).collect();
    let rates = qd.iter().zip(qdd).map(|(qd, qdd)| qd + h * qdd).collect();
    [there, rates, qdd.clone()]
}
