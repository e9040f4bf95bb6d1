//! Returns the growth of forces near singular positions.

use super::super::acting::Beside;
use super::super::calls::Forces;
use super::super::sum::Sum;
use super::towards;
use crate::outcome::error::Result;
use crate::outcome::growth::Growth;

impl Forces<'_> {
    /// Returns the constraints whose forces grow without bound near the singular positions of the
    /// motion, with the time t* and the exponent of |t − t*|.
    ///
    /// The singular positions ([`crate::Motion::singular_positions`]) are the toggle that ended the
    /// motion and the change points that the motion passed. The list of constraints includes
    /// drivers. Kin computes the forces without friction at several positions near each singular
    /// position.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # use kin::Load;
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("pump, driven at its piston");
    /// let (crank, rod) = (m.link("crank", 1.0)?, m.link("rod", 2.5)?);
    /// let piston = m.planar("piston", pose(2.4, 0.0, 0.0))?;
    /// m.add("O", revolute(crank, m.ground(), crank.start(), vec2(0.0, 0.0)))?;
    /// m.add("A", revolute(crank, rod, crank.end(), rod.start()))?;
    /// m.add("B", revolute(rod, piston, rod.end(), vec2(0.0, 0.0)))?;
    /// let (origin, along) = (vec2(0.0, 0.0), vec2(0.0, 1.0));
    /// m.add("guide", prismatic(piston, m.ground(), origin, origin, along, 0.0))?;
    /// m.add("push", drive(piston.x(), Law::linear(2.4, 0.4)))?; // the dead centre is at 3.5
    /// m.prefer(crank, deg(60.0));
    /// m.load("brake", Load::torque(crank, 3.0))?;
    /// let system = m.build()?;
    /// let stopped = system.run(linspace(0.0, 5.0, 51)).unwrap_err();
    /// let forces = system.forces(stopped.motion().expect("the motion before the dead centre"))?;
    /// for growth in forces.growth()? {
    ///     // the forces of `push` grow without bound towards t* = 2.75 s, like |t − t*|^(−1/2)
    ///     println!("{growth}");
    /// }
    /// # let mut growths = forces.growth()?.into_iter();
    /// # assert!(growths.any(|growth| growth.constraint == "push" && growth.power == -0.5));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// For mechanisms with redundant equations, and for motions from given states, Kin does not
    /// know the singular positions and returns an empty list.
    ///
    /// Errors: those of a run, if Kin cannot follow the motion again.
    pub fn growth(&self) -> Result<Vec<Growth>> {
        let system = self.system;
        let points = Beside::points(self.system);
        let mut sum = Sum::new(system, &self.loads, &points);
        let mut all = Vec::new();
        for position in self.motion.singular_positions() {
            all.extend(towards(system, self.motion, position, &mut |now| sum.generalised(now))?);
        }
        Ok(all)
    }
}
