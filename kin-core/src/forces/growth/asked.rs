//! The growth of forces, as people ask for it.

use super::super::acting::Beside;
use super::super::calls::Forces;
use super::super::sum::Sum;
use super::towards;
use crate::model::error::Result;
use crate::model::growth::Growth;

impl Forces<'_> {
    /// The constraints whose forces grow without bound towards singular positions of the motion
    /// ([`crate::Motion::singular_positions`]), with the time t* and the power of |t − t*|: the
    /// toggle that has ended it, and change points that it has passed. Drivers are among them.
    /// Forces are computed anew at some places on the way; friction has no part in it.
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
    ///     // `push`: forces grow without bound towards t = 2.75 s, as |t − t*|^(−1/2)
    ///     println!("{growth}");
    /// }
    /// # let mut growths = forces.growth()?.into_iter();
    /// # assert!(growths.any(|growth| growth.constraint == "push" && growth.power == -0.5));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Of mechanisms with redundant equations, and of motions given by states, singular positions
    /// are not known, and nothing is told. Errors: those of a run, where the motion cannot be gone
    /// along again.
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
