//! Adds friction to joints of a mechanism.

use super::Mechanism;
use crate::dimensions::Beside;
use crate::model::loads::Friction;
use crate::outcome::error::{Error, Result};

impl Mechanism {
    /// Adds dry friction to an existing joint, by the name of the joint.
    ///
    /// A second call for the same joint replaces the friction of the first call.
    ///
    /// Friction does not change the motion of a driven mechanism. Friction changes the efforts of
    /// drivers and the reactions of joints. The numbers of the friction may be dimensions. If no
    /// driving force can overcome the friction, [`crate::System::forces`] reports a jammed
    /// mechanism.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # use kin::loads::Friction;
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("drum");
    /// let drum = m.planar("drum", pose(0.0, 0.0, 0.0))?;
    /// m.add("shaft", revolute(drum, m.ground(), vec2(0.0, 0.0), vec2(0.0, 0.0)))?;
    /// m.friction("shaft", Friction::pin(0.1, 0.02, 1e-3))?; // μ, radius, rate at which it sets in
    /// m.add("motor", drive_angle(drum, Law::ramp(5.0)))?;
    /// m.mass(drum, 30.0, vec2(0.0, 0.0), 0.6)?;
    /// m.gravity(vec2(0.0, -9.81));
    /// let system = m.build()?;
    /// let motion = system.run([0.0, 1.0])?;
    /// let effort = system.forces(&motion)?.drive("motor")?.peak().value;
    /// assert!((effort - 0.1 * 0.02 * 30.0 * 9.81).abs() < 1e-12); // μ r F
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Errors: no constraint has this name, the joint is neither a pin nor a slide, the coefficient
    /// is negative, a radius, length or velocity is not positive, a number is not finite.
    pub fn friction(&mut self, joint: &str, friction: Friction) -> Result<()> {
        let found = self.constraints.iter().find(|(name, _)| name == joint);
        let (_, constraint) = found.ok_or_else(|| Error::UnknownName {
            what: "constraint",
            name: joint.to_string(),
            known: self.constraints.iter().map(|(name, _)| name.clone()).collect(),
        })?;
        friction.seat_in(joint, constraint.as_ref())?;
        let bound = friction.given().map(|(name, number)| (name.to_string(), number)).collect();
        self.hang_beside(joint, Beside::Friction(joint.to_string()), bound)?;
        self.loads.frictions.retain(|(known, _)| known != joint);
        self.loads.frictions.push((joint.to_string(), friction));
        Ok(())
    }
}
