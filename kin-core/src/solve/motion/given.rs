//! Creates motions from states that were measured, or that another program computed.

use super::Motion;
use crate::outcome::error::{Error, Result};
use crate::solve::newton::Outcome;
use crate::system::System;

impl Motion {
    /// Creates a motion from given states: q, q̇ and q̈ at each time, in the order of
    /// [`System::coordinate_names`]. \[s, m, rad\]
    ///
    /// Kin does not solve or change the states, and requires only finite numbers.
    /// [`Motion::residuals`] shows how far the states are from C(q, t) = 0. Use this function to
    /// compute the forces of a measured motion.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("pendulum");
    /// let bob = m.planar("bob", pose(0.0, 0.0, 0.0))?; // frame at the pin
    /// m.add("O", revolute(bob, m.ground(), vec2(0.0, 0.0), vec2(0.0, 0.0)))?;
    /// m.add("swing", drive_angle(bob, Law::constant(0.0)))?; // what would hold it at this place
    /// m.mass(bob, 2.0, vec2(0.0, -0.5), 0.02)?;
    /// m.gravity(vec2(0.0, -9.81));
    /// let system = m.build()?;
    /// // Let go at rest at 0.3 rad: θ̈ = −m g l sin θ / (J + m l²).
    /// let alpha = -2.0 * 9.81 * 0.5 * 0.3_f64.sin() / (0.02 + 2.0 * 0.25);
    /// let (q, qd, qdd) = ([0.0, 0.0, 0.3], [0.0; 3], [0.0, 0.0, alpha]);
    /// let motion = Motion::from_states(&system, &[0.0], &[q], &[qd], &[qdd])?;
    /// let forces = system.forces(&motion)?;
    /// assert!(forces.drive("swing")?.effort().values()[0].abs() < 1e-14); // it swings freely
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Errors: a list or row has the wrong length; a number is not finite; the times neither only
    /// increase nor only decrease.
    pub fn from_states(
        system: &System,
        times: &[f64],
        q: &[impl AsRef<[f64]>],
        qd: &[impl AsRef<[f64]>],
        qdd: &[impl AsRef<[f64]>],
    ) -> Result<Motion> {
        let mut motion = Motion::new(system, times.len());
        let lengths = [("q", q.len()), ("q'", qd.len()), ("q''", qdd.len())];
        if let Some((what, found)) = lengths.into_iter().find(|(_, found)| *found != times.len()) {
            let what = format!("{what} of a motion");
            return Err(Error::WrongLength { what, expected: times.len(), found });
        }
        ordered(times)?;
        for (k, &t) in times.iter().enumerate() {
            let q = q[k].as_ref();
            let qd = qd[k].as_ref();
            let qdd = qdd[k].as_ref();
            system.check(q, "q")?;
            system.check(qd, "q'")?;
            system.check(qdd, "q''")?;
            let c = system.residual(q, t)?;
            let largest = |best: (usize, f64), (row, c): (usize, &f64)| {
                if c.abs() > best.1 { (row, c.abs()) } else { best }
            };
            let (worst, residual) = c.iter().enumerate().fold((0, 0.0), largest);
            motion.append(t, [q, qd, qdd, &[]], Outcome { iterations: 0, residual }, worst);
        }
        Ok(motion)
    }
}

/// Returns an error for times that are not finite, or that change direction.
fn ordered(times: &[f64]) -> Result<()> {
    let bad = |reason: String| Err(Error::InvalidTimes { reason });
    if let Some(t) = times.iter().find(|t| !t.is_finite()) {
        return bad(format!("t is {t}. Give finite times"));
    }
    let up = times.windows(2).all(|pair| pair[0] < pair[1]);
    let down = times.windows(2).all(|pair| pair[0] > pair[1]);
    if up || down {
        Ok(())
    } else {
        bad("the times must only increase or only decrease".to_string())
    }
}
