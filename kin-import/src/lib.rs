//! Mechanisms of other programs, read from their files.
//!
//! [`asmt`] reads the files of OndselSolver, which solves assemblies of FreeCAD. A reader makes a
//! [`kin::Mechanism`] and tells by name everything that it leaves out: a mechanism that lacks a
//! joint or moves otherwise than in the program that it comes from is never made silently.
//!
//! The files, in the order in which they stand on one another: `imported` (what comes out,
//! mistakes) → `tree` (lines by their indentation) → `formula` (laws as text) → `asmt/`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod asmt;
mod formula;
mod imported;
mod tree;

pub use asmt::asmt;
pub use imported::{Imported, LeftOut, Mistake};
