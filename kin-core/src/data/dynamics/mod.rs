//! Reads and writes masses, gravity, loads and friction in mechanism files.

mod format;
mod loads;
mod masses;

pub use format::{
    ActingData, AlongData, FormulaData, FrictionData, FrictionShape, LoadData, MeasureData,
    PointMassData, ScalarData,
};
pub(super) use loads::{Carried, carry};
pub use masses::MassData;
