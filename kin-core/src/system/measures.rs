//! Measures of joints by name: `JOINT.MEASURE`.

use super::System;
use crate::model::constraint::Measured;
use crate::model::error::Error;

/// One measure of one constraint.
#[derive(Clone, Copy)]
pub(crate) struct MeasurePlace {
    pub block: usize,
    pub number: usize,
    pub measured: Measured,
}

impl System {
    /// Names of all measures of its joints, such as `slot.slide`, in the order of the constraints:
    /// what [`System::measure`] can be asked for beside coordinates.
    pub fn measures(&self) -> Vec<String> {
        self.constraints()
            .flat_map(|(name, constraint)| {
                constraint.facts().measures.iter().map(move |m| format!("{name}.{}", m.name))
            })
            .collect()
    }

    /// Where a measure is, by its name.
    pub(crate) fn place_of(&self, name: &str) -> Option<MeasurePlace> {
        let (joint, measure) = name.rsplit_once('.')?;
        let (block, (_, constraint)) =
            self.constraints().enumerate().find(|(_, (known, _))| *known == joint)?;
        let number = constraint.facts().measures.iter().position(|known| known.name == measure)?;
        Some(MeasurePlace { block, number, measured: constraint.facts().measures[number] })
    }

    /// True of the name of a measure or of a coordinate.
    pub(crate) fn is_measure(&self, name: &str) -> bool {
        self.place_of(name).is_some() || self.coordinate_names().iter().any(|known| known == name)
    }

    /// The error for a name that no measure has: what can be asked of that joint, or of all.
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
                    "there is no `{name}`: this joint has no measure. Ask for a point, an angle between bodies or a coordinate instead"
                )
            }
            _ => format!(
                "there is no `{name}`; what can be asked of this joint is {}",
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
