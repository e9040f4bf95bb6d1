//! Collects the warnings of a motion.

use super::Motion;
use crate::outcome::motion::warning::MOST;
use crate::outcome::motion::{Warning, WarningKind};

impl Motion {
    /// Returns the warnings of the motion: common mistakes with which a run still succeeds.
    ///
    /// Kin warns of numbers that look like degrees, a first position far from the drawn position, a
    /// start near a singular position, and a table that ends before the run. Each warning has a
    /// kind, the names of the parts that it concerns, and a text. The list contains at most four
    /// warnings of each kind.
    ///
    /// Kin computes the list when you first call this method. A case of a sweep has only warnings
    /// about the drawn position and about tables. Measured motions, poses between two times, and
    /// the later parts of a run in parts have only warnings about tables.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("crank");
    /// let crank = m.link("crank", 1.0)?;
    /// m.add("O", revolute(crank, Ground, crank.start(), vec2(0.0, 0.0)))?;
    /// m.add("motor", drive_angle(crank, Law::ramp(360.0)))?; // intended: TAU
    /// let motion = m.build()?.run(linspace(0.0, 1.0, 11))?;
    /// assert_eq!(
    ///     motion.warnings()[0].to_string(),
    ///     "`motor` turns `crank` at 360 rad/s (57 turns/s): the law of the driver is \
    ///      `Law::ramp(360.0)`. Angles are in radians; if degrees are meant, give \
    ///      `Law::ramp(TAU)`."
    /// );
    /// # Ok(())
    /// # }
    /// ```
    pub fn warnings(&self) -> &[Warning] {
        self.warnings.get_or_init(|| {
            let mut all = self.begun.clone();
            // Where a number is named, the angle to which it leads says nothing more.
            let named = all.iter().any(|warning| warning.kind == WarningKind::Degrees);
            let far = self.far_from_drawn();
            all.extend(
                far.filter(|found| !(named && found.kind == WarningKind::Degrees)).take(MOST),
            );
            let events = self.events().iter().filter(|event| event.kind.is_warning());
            all.extend(events.take(MOST).map(|event| {
                Warning::new(WarningKind::BeyondRange, &[&event.name], format!("{event}."))
            }));
            all
        })
    }
}
