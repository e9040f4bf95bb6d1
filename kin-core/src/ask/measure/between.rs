//! Computes the pose at a time between two times of a motion, on the branch of the motion.

use super::changes::Changes;
use crate::outcome::error::{Error, Result};
use crate::solve::motion::Motion;
use crate::solve::newton::Outcome;
use crate::system::{Solution, System};

impl System {
    /// Returns the pose at one time t within a motion of this system, as a motion with one time.
    /// \[s\]
    ///
    /// Kin solves the pose, starting from an interpolation between the neighbouring poses of the
    /// motion. You can call every function of a motion on the result. At a change point the pose
    /// and its velocities are those of the branch on which the motion continues.
    ///
    /// To compute a pose without a motion, call `system.run([t])`.
    ///
    /// Errors: t is outside the motion; the motion belongs to another system; those of
    /// [`System::solve_at`].
    pub fn at(&self, motion: &Motion, t: f64) -> Result<Motion> {
        self.own_as_it_is(motion)?;
        let before = step_of(motion.times(), t).ok_or_else(|| outside(motion, t))?;
        let mut pose = Motion::new(self, 1);
        self.add_between(motion, &Changes::of(self, motion), (before, t), &mut pose)?;
        Ok(pose)
    }

    /// Returns the pose at t near q with its velocities, as a motion of that time alone. Preferred
    /// values do not count.
    pub(crate) fn next_to(&self, t: f64, q: &[f64]) -> Result<Motion> {
        self.pose_near(t, q, false)
    }

    /// Returns the pose at t near q; `jerk` says whether to compute q⃛ too.
    pub(super) fn pose_near(&self, t: f64, q: &[f64], jerk: bool) -> Result<Motion> {
        let mut pose = Motion::new(self, 1);
        self.append_solved(t, q, jerk, &mut pose)?;
        Ok(pose)
    }

    /// Appends the pose at t, between time k of a motion and the next, to another motion.
    pub(super) fn add_between(
        &self,
        motion: &Motion,
        changes: &Changes,
        (k, t): (usize, f64),
        to: &mut Motion,
    ) -> Result<()> {
        let all = 0..self.n_coordinates();
        if let Some(same) = [k, k + 1].into_iter().find(|k| motion.times().get(*k) == Some(&t)) {
            let outcome = Outcome { iterations: 0, residual: motion.residuals()[same] };
            to.append(t, motion.orders(same, all), outcome, 0);
            return Ok(());
        }
        if changes.add(self, t, motion.has_jerk(), to)? {
            return Ok(());
        }
        self.append_solved(t, &interpolated(motion, k, t), motion.has_jerk(), to)
    }

    /// Appends the pose at t near q.
    fn append_solved(&self, t: f64, q: &[f64], jerk: bool, to: &mut Motion) -> Result<()> {
        let Solution { q, qd, qdd, report, .. } = self.solve_at(t, q)?;
        let qddd = if jerk { self.jerk(&q, &qd, &qdd, t)? } else { Vec::new() };
        let worst =
            self.names_of_equations().iter().position(|name| *name == report.worst).unwrap_or(0);
        to.append(
            t,
            [&q, &qd, &qdd, &qddd],
            Outcome { iterations: report.iterations, residual: report.residual },
            worst,
        );
        Ok(())
    }
}

/// Returns the step of the times that contains t: from k to k + 1.
pub(super) fn step_of(times: &[f64], t: f64) -> Option<usize> {
    if let [only] = times {
        return (*only == t).then_some(0);
    }
    times
        .windows(2)
        .position(|pair| (pair[0] <= t && t <= pair[1]) || (pair[1] <= t && t <= pair[0]))
}

fn outside(motion: &Motion, t: f64) -> Error {
    let s = motion.unit_words().time();
    let reason = match motion.times() {
        [] => format!("the motion has no times, so Kin cannot evaluate it at t = {t} {s}"),
        [first, .., last] => {
            format!(
                "t = {t} {s} is outside of the motion, which goes from {first} {s} to {last} {s}"
            )
        }
        [only] => {
            format!("t = {t} {s} is outside of the motion, which has only the time {only} {s}")
        }
    };
    Error::InvalidTimes { reason }
}

/// Returns q from the quintic polynomial through q, q̇ and q̈ at both ends of step k.
fn interpolated(motion: &Motion, k: usize, t: f64) -> Vec<f64> {
    let (Some(&from), Some(&to)) = (motion.times().get(k), motion.times().get(k + 1)) else {
        return motion.q(k).to_vec();
    };
    let u = (t - from) / (to - from);
    motion.quintics(k).iter().map(|c| c.iter().rev().fold(0.0, |sum, c| sum * u + c)).collect()
}

impl Motion {
    /// Returns for each coordinate the quintic polynomial c0 + c1 u + … over 0 ≤ u ≤ 1 through q,
    /// q̇ and q̈ at both ends of step k.
    pub(crate) fn quintics(&self, k: usize) -> Vec<[f64; 6]> {
        let h = self.times.get(k + 1).zip(self.times.get(k)).map_or(0.0, |(to, from)| to - from);
        let ends = [k, k + 1].map(|k| (self.q(k), self.qd(k), self.qdd(k)));
        (0..self.layout.len())
            .map(|j| quintic(ends.map(|(q, qd, qdd)| [q[j], h * qd[j], h * h * qdd[j]])))
            .collect()
    }
}

/// Returns the quintic polynomial over 0 ≤ u ≤ 1 with these values, slopes and second derivatives
/// at its ends (quintic Hermite interpolation).
pub(crate) fn quintic([[x0, v0, a0], [x1, v1, a1]]: [[f64; 3]; 2]) -> [f64; 6] {
    let x = x1 - (x0 + v0 + 0.5 * a0);
    let v = v1 - (v0 + a0);
    let a = a1 - a0;
    [
        x0,
        v0,
        0.5 * a0,
        10.0 * x - 4.0 * v + 0.5 * a,
        -15.0 * x + 7.0 * v - a,
        6.0 * x - 3.0 * v + 0.5 * a,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quintic_is_exact_for_polynomials_of_fifth_degree() {
        let c = [0.3, -1.0, 2.0, 0.7, -0.2, 1.1];
        let x = |s: f64| c.iter().rev().fold(0.0, |sum, c| sum * s + c);
        let slopes = |s: f64| {
            let v = c[1] + s * (2.0 * c[2] + s * (3.0 * c[3] + s * (4.0 * c[4] + s * 5.0 * c[5])));
            [x(s), v, 2.0 * c[2] + s * (6.0 * c[3] + s * (12.0 * c[4] + s * 20.0 * c[5]))]
        };
        for s in [0.0, 0.2, 0.5, 0.9, 1.0] {
            let found =
                quintic([slopes(0.0), slopes(1.0)]).iter().rev().fold(0.0, |sum, c| sum * s + c);
            assert!((found - x(s)).abs() < 1e-14);
        }
    }

    #[test]
    fn a_time_belongs_to_its_step_forwards_and_backwards() {
        assert_eq!(step_of(&[0.0, 1.0, 2.0], 1.5), Some(1));
        assert_eq!(step_of(&[2.0, 1.0, 0.0], 0.5), Some(1));
        assert_eq!(
            (step_of(&[0.0, 1.0], 1.1), step_of(&[], 0.0), step_of(&[3.0], 3.0)),
            (None, None, Some(0))
        );
        assert_eq!(step_of(&[0.0, 1.0], f64::NAN), None);
    }
}
