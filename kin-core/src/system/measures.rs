//! Lists the measures of joints by name: `JOINT.MEASURE`.

use super::System;
use crate::model::constraint::Measured;
use crate::outcome::error::Error;

/// A measure of a constraint.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeasurePlace {
    pub block: usize,
    pub number: usize,
    pub measured: Measured,
}

impl System {
    /// Returns the names of all measures of joints, such as `slot.slide`, in the order of the
    /// constraints.
    ///
    /// [`System::measure`] accepts the names of measures and of coordinates.
    pub fn measures(&self) -> Vec<String> {
        self.constraints()
            .flat_map(|(name, constraint)| {
                constraint.facts().measures.iter().map(move |m| format!("{name}.{}", m.name))
            })
            .collect()
    }

    /// Returns the place of a measure, by its name.
    pub(crate) fn place_of(&self, name: &str) -> Option<MeasurePlace> {
        let (joint, measure) = name.rsplit_once('.')?;
        let (block, (_, constraint)) =
            self.constraints().enumerate().find(|(_, (known, _))| *known == joint)?;
        let number = constraint.facts().measures.iter().position(|known| known.name == measure)?;
        Some(MeasurePlace { block, number, measured: constraint.facts().measures[number] })
    }

    /// Returns true for the name of a measure or of a coordinate.
    pub(crate) fn is_measure(&self, name: &str) -> bool {
        self.place_of(name).is_some() || self.coordinate_names().iter().any(|known| known == name)
    }

    /// Builds the error for a name that no measure has. It lists the names of that joint, or all
    /// names.
    pub(crate) fn no_measure(&self, name: &str) -> Error {
        let joint = |name: &str| self.constraints().find(|(known, _)| *known == name);
        let Some((joint, constraint)) = joint(name).or_else(|| joint(name.rsplit_once('.')?.0))
        else {
            let known = self
                .measures()
                .into_iter()
                .chain(self.coordinate_names().iter().cloned())
                .collect();
            return Error::UnknownName {
                what: "measure or coordinate",
                name: name.to_string(),
                known,
            };
        };
        let known: Vec<String> = constraint
            .facts()
            .measures
            .iter()
            .map(|measure| format!("`{joint}.{}`", measure.name))
            .collect();
        let reason = match known[..] {
            [] => {
                format!(
                    "`{name}` does not exist, because this joint has no measure. Use a point, an angle between bodies or a coordinate instead"
                )
            }
            _ => format!(
                "`{name}` does not exist. This joint has the measures {}",
                known.join(" and ")
            ),
        };
        Error::InvalidConstraint {
            constraint: joint.to_string(),
            kind: constraint.facts().kind.to_string(),
            reason,
        }
    }
}
