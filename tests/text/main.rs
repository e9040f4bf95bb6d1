//! Equations from text: constraints in mechanisms, files that carry their equations, and mistakes
//! told at the place of the text.

#[path = "../data/as_text.rs"]
mod as_text;
mod dimensions;
#[path = "../data/engines.rs"]
mod engines;
mod examples;
mod files;
mod laws;
mod mistakes;
#[path = "../data/own.rs"]
mod own;
mod rustc;
