//! Computes the forces of the cases of a sweep.

use crate::forces::Forces;
use crate::outcome::error::Result;
use crate::solve::sweep::Sweep;

impl Sweep<'_> {
    /// Runs every case over the times as [`Sweep::run`] does, and returns the results of `keep` in
    /// the order of the cases.
    ///
    /// Kin calls `keep` with the index of each case and its forces ([`crate::System::forces`]), or
    /// with the index and the error if the case fails.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # fn main() -> kin::Result<()> {
    /// # let mut m = Mechanism::new("arm");
    /// let arm = m.link("arm", 0.5)?;
    /// m.mass(arm, 1.2, vec2(0.1, 0.0), 0.03)?;
    /// m.gravity(vec2(0.0, -9.81));
    /// m.add("O", revolute(m.ground(), arm, vec2(0.0, 0.0), arm.start()))?;
    /// m.add("motor", drive_angle(arm, Law::sine(0.5, 3.0, 0.0)))?;
    /// let (system, times) = (m.build()?, linspace(0.0, 2.0, 101));
    /// // The pin wanders along the arm.
    /// let cases: Vec<[f64; 1]> = (0..5).map(|k| [-0.25 + 0.05 * k as f64]).collect();
    /// let torques = system.sweep(["O.u_j.x"])?.forces(&cases, &times, |_, forces| {
    ///     kin::Result::Ok(forces?.drive("motor")?.effort().max())
    /// })?;
    /// assert!(torques.iter().all(Result::is_ok));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Errors: those of [`Sweep::run`] that concern the whole sweep.
    pub fn forces<R: Send>(
        &self,
        cases: &[impl AsRef<[f64]> + Sync],
        times: impl AsRef<[f64]>,
        keep: impl Fn(usize, Result<Forces<'_>>) -> R + Sync,
    ) -> Result<Vec<R>> {
        self.run_each(cases, times, |case, system, motion| match motion {
            Ok(motion) => keep(case, system.forces(&motion)),
            Err(error) => keep(case, Err(error)),
        })
    }
}
