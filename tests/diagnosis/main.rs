//! Diagnoses of mechanisms with a known answer: counts, ranks, dependencies and freedoms by name.

mod assemblies;
mod branches;
mod cost;
#[path = "../data/engines.rs"]
mod engines;
mod invariance;
mod limits;
mod models;
mod motors;
mod plan;
mod planar;
mod planted;
mod random;
mod shaky;
mod silence;
mod space;
mod spatial;
mod steps;
mod verdicts;
