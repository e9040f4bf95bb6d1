//! Forces: reactions, efforts of drives, loads and powers, against references and closed forms.

mod advantage;
mod along;
#[path = "../data/engines.rs"]
mod both;
mod chrono;
mod closed;
// Its mechanisms are those of other files.
#[allow(dead_code)]
#[path = "../data/mod.rs"]
mod data;
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
mod references;
mod singular;
mod unique;
mod views;
