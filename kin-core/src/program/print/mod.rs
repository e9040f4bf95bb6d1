//! Prints a scheduled tape as text: places become names, and each step becomes one line.
//!
//! `listing` names the numbers of a tape. `operation` prints one step in any dialect of
//! [`kin_graph::text`]. `c` prints a whole mechanism as a file of C, and `equations` its equations
//! as formulas. `vector` computes the numbers with which the file tests itself.

mod c;
mod equations;
mod listing;
mod operation;
mod pieces;
mod selftest;
mod vector;

pub(crate) use c::{Sample, Sheet, Symbol, file};
pub(crate) use equations::equations;
