//! Masses, gravity, loads and friction in mechanism files.

mod format;
mod loads;
mod masses;

pub use format::{ActingData, FormulaData, FrictionData, FrictionShape, LoadData, PointMassData, ScalarData};
pub(super) use loads::{Carried, carry};
pub use masses::MassData;
