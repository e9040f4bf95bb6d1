//! Equations from text: constraints in mechanisms, files that carry their equations, and mistakes told at the
//! place of the text.

mod dimensions;
mod files;
mod laws;
mod mistakes;
mod rustc;
