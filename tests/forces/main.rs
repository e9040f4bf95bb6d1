//! Forces: reactions, efforts of drives, loads and powers, against references and closed forms.

mod advantage;
mod along;
#[path = "../data/engines.rs"]
mod both;
mod chrono;
mod closed;
mod columns;
mod coulomb;
// Its mechanisms are those of other files.
#[allow(dead_code)]
#[path = "../data/mod.rs"]
mod data;
mod efforts;
mod energy;
mod engines;
mod errors;
mod examples;
mod file;
mod friction;
mod friction_given;
mod laws;
mod loads;
mod measures;
mod newton_euler;
#[path = "../data/own.rs"]
mod own;
mod points;
mod powers;
mod programs;
mod references;
mod shared;
mod singular;
mod unique;
mod views;
