//! `.asmt` files: one written for these tests, and those of OndselSolver where their folder is at
//! hand.

mod incomplete;
mod joints;
mod outside;
mod own;
mod written;
