//! Reads mechanisms from the files of other programs.
//!
//! [`asmt`] reads the files of OndselSolver, which solves assemblies of FreeCAD. A reader creates a
//! [`kin::Mechanism`] and lists the names of all omitted parts. So a reader never silently creates
//! a mechanism that lacks a joint or moves differently than in the other program.
//!
//! The modules, each built on the modules before it: `imported` (results and mistakes) → `tree`
//! (lines by their indentation) → `formula` (laws as text) → `asmt/`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod asmt;
mod formula;
mod imported;
mod tree;

pub use asmt::asmt;
pub use imported::{Imported, LeftOut, Mistake};
