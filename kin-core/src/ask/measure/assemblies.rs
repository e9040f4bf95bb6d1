//! Selects an assembly by a measure.

use super::Measure;
use crate::outcome::error::{Error, Result};
use crate::solve::assembly::{Assembly, apart};
use crate::solve::motion::Motion;
use crate::solve::newton::Outcome;
use crate::system::System;

impl System {
    /// Returns the assembly at time t in which a measure is nearest to a value:
    /// `system.assembly_near(0.0, "elbow.angle", deg(-60.0))?`.
    ///
    /// The measure may be any function of a motion, such as the distance of two points. Kin ignores
    /// full revolutions of angles. To use the assembly, call `system.set_initial(&found.q)?`.
    ///
    /// Errors: those of [`System::assemblies`] and [`System::measure`]; Kin finds no assembly.
    pub fn assembly_near(&self, t: f64, what: impl Measure, value: f64) -> Result<Assembly> {
        let mut nearest: Option<(f64, Assembly)> = None;
        for assembly in self.assemblies(t)? {
            let found = what.of(self, &self.posed(t, &assembly.q))?.value;
            let x = found.values().first().copied().unwrap_or(f64::NAN);
            let far = apart(x, value, found.unit() == "rad");
            if far.is_finite() && nearest.as_ref().is_none_or(|(known, _)| far < *known) {
                nearest = Some((far, assembly));
            }
        }
        let none = || Error::UnknownName {
            what: "assembly",
            name: format!("with {value} at t = {t} s"),
            known: Vec::new(),
        };
        nearest.map(|(_, assembly)| assembly).ok_or_else(none)
    }

    /// Returns a motion of one time at a pose that satisfies the equations, at rest if the
    /// velocities do not exist.
    fn posed(&self, t: f64, q: &[f64]) -> Motion {
        let mut motion = Motion::new(self, 1);
        let still = vec![0.0; q.len()];
        match self.solve_at(t, q) {
            Ok(found) => motion.append(
                t,
                [&found.q, &found.qd, &found.qdd, &[]],
                Outcome { iterations: 0, residual: found.report.residual },
                0,
            ),
            Err(_) => motion.append(
                t,
                [q, &still, &still, &[]],
                Outcome { iterations: 0, residual: 0.0 },
                0,
            ),
        }
        motion
    }
}
