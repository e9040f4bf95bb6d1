//! Reads and writes mechanisms, motions, forces and diagnoses as data for serde and as JSON files.
//!
//! A motion read from a file equals the written motion to the last digit. To read a mechanism, pass
//! a [`Registry`] of constructors. Add user-defined constraints to the registry:
//! `Registry::new().with::<parabolic_slot>()`.

mod dimension;
mod dynamics;
mod expression;
mod format;
mod joints;
mod law;
mod mechanism;
mod motion;
mod names;
mod once;
mod read;
mod registry;
mod schema;
mod value;

use std::path::Path;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

pub use crate::model::describer::Describer;
pub use dimension::{DimensionData, NumberData};
pub use dynamics::{
    ActingData, AlongData, FormulaData, FrictionData, FrictionShape, LoadData, MassData,
    MeasureData, PointMassData, ScalarData,
};
pub use format::{
    ArgumentData, BodyData, BodyKind, ColumnData, ConstraintData, ForcesData, LimitData,
    MechanismData, PreferredData,
};
pub use law::{LawData, LawReader};
pub use motion::{BreakData, MotionData, OutputData};
pub use registry::{Described, Reader, Registry};
pub use schema::schema;
pub use value::{
    Datum, Incoming, IncomingBySerde, IncomingRefused, Outgoing, OutgoingBySerde, OutgoingConstant,
    OutgoingRefused, RefusedConstant,
};

use crate::ask::diagnosis::Diagnosis;
use crate::forces::Forces;
use crate::model::mechanism::Mechanism;
use crate::outcome::error::{Error, Result};
use crate::outcome::motion::Series;
use crate::solve::motion::Motion;

/// The newest version of the formats. Kin writes this version and reads all versions from the first
/// on. It grows if an older reader would misunderstand a file.
const FORMAT: u32 = 1;

/// Returns the version of data that contain none.
fn is_first() -> u32 {
    1
}

/// Returns an error for data of a version above `newest`.
fn understood(version: u32, newest: u32) -> std::result::Result<(), String> {
    let known = if newest == 1 { "format 1".to_string() } else { format!("formats 1 to {newest}") };
    match version {
        0 => Err(format!("format 0 does not exist. Kin reads {known}")),
        _ if version <= newest => Ok(()),
        _ => Err(format!(
            "a newer Kin has written its format {version}, but Kin {} reads {known}. Update Kin",
            env!("CARGO_PKG_VERSION")
        )),
    }
}

/// Reads the data in a text. For a newer version the error names the version, not the first unknown
/// member.
fn read_text<T: DeserializeOwned>(text: &str) -> std::result::Result<T, String> {
    #[derive(Deserialize)]
    struct Version {
        format: u32,
    }
    read::text(text).map_err(|told| {
        let newer = serde_json::from_str(text)
            .ok()
            .and_then(|Version { format }| understood(format, FORMAT).err());
        newer.unwrap_or(told)
    })
}

impl MechanismData {
    /// Reads the text of a mechanism file.
    ///
    /// Errors, with line and column: the text is not JSON; a member is missing, unknown or of
    /// another type; the data have a newer version.
    pub fn read(text: &str) -> Result<MechanismData> {
        read_text(text).map_err(|reason| Error::Data { place: "mechanism".to_string(), reason })
    }
}

impl MotionData {
    /// Reads the text of a motion.
    ///
    /// Errors: those of [`MechanismData::read`].
    pub fn read(text: &str) -> Result<MotionData> {
        read_text(text).map_err(|reason| Error::Data { place: "motion".to_string(), reason })
    }
}

impl Mechanism {
    /// Reads a mechanism from a file.
    ///
    /// Errors: Kin cannot read the file; those of [`Mechanism::from_data`].
    pub fn read_json(path: impl AsRef<Path>, registry: &Registry) -> Result<Mechanism> {
        Mechanism::from_data(&read_file(path.as_ref())?, registry)
    }
}

impl Diagnosis {
    /// Writes the diagnosis as JSON without loss, and creates missing folders.
    ///
    /// Errors: Kin cannot write the file.
    pub fn write_json(&self, path: impl AsRef<Path>) -> Result<()> {
        write(path.as_ref(), self)
    }

    /// Reads a diagnosis from a file.
    ///
    /// Errors: Kin cannot read the file.
    pub fn read_json(path: impl AsRef<Path>) -> Result<Diagnosis> {
        read_file(path.as_ref())
    }
}

impl Motion {
    /// Writes the motion as JSON ([`Motion::data`]) without loss, and creates missing folders.
    ///
    /// Errors: Kin cannot write the file.
    pub fn write_json(&self, path: impl AsRef<Path>) -> Result<()> {
        write(path.as_ref(), &self.data())
    }

    /// Reads a motion from a file.
    ///
    /// Errors: Kin cannot read the file; those of [`Motion::from_data`].
    pub fn read_json(path: impl AsRef<Path>) -> Result<Motion> {
        Motion::from_data(&read_file(path.as_ref())?)
    }
}

impl Forces<'_> {
    /// Returns every unique quantity as data for serde: the columns of [`Forces::columns`] with
    /// their units.
    pub fn data(&self) -> ForcesData {
        let motion = self.motion();
        let column = |column: Series| ColumnData {
            name: column.name().to_string(),
            unit: column.unit().to_string(),
            values: column.values().to_vec(),
        };
        ForcesData {
            format: FORMAT,
            mechanism: self.mechanism_name().to_string(),
            units: motion.unit_words().clone(),
            times: motion.times().to_vec(),
            columns: self.columns().into_iter().map(column).collect(),
            left_over: self.balance().worst(),
        }
    }

    /// Writes the forces as JSON ([`Forces::data`]) and creates missing folders.
    ///
    /// Errors: Kin cannot write the file.
    pub fn write_json(&self, path: impl AsRef<Path>) -> Result<()> {
        write(path.as_ref(), &self.data())
    }
}

fn write(path: &Path, data: &impl Serialize) -> Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let write = || {
        folder.map_or(Ok(()), std::fs::create_dir_all)?;
        std::fs::write(path, serde_json::to_string(data)? + "\n")
    };
    write().map_err(|source| Error::File { path: path.to_path_buf(), source })
}

fn read_file<T: DeserializeOwned>(path: &Path) -> Result<T> {
    let fail = |reason: String| Error::Data { place: path.display().to_string(), reason };
    let text = std::fs::read_to_string(path).map_err(|error| fail(error.to_string()))?;
    read_text(&text).map_err(fail)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_versions_up_to_the_newest_are_read() {
        let told = |version, newest| understood(version, newest).err().unwrap_or_default();
        assert_eq!([told(1, 1), told(1, 3), told(3, 3)], [const { String::new() }; 3]);
        assert!(told(2, 1).starts_with("a newer Kin has written its format 2, but Kin "));
        assert!(
            told(2, 1).contains(" reads format 1. Update Kin")
                && told(4, 3).contains(" reads formats 1 to 3. ")
        );
        assert_eq!(told(0, 2), "format 0 does not exist. Kin reads formats 1 to 2");
    }
}
