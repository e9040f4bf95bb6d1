//! Mechanisms as files of C: compiled with all warnings, run, and compared with the library.
//!
//! The tests need the C compiler `cc`, which Rust needs as a linker too.

mod examples;
mod guide;
mod names;
mod options;
mod programs;
mod toggles;

#[path = "../data/own.rs"]
mod own;
