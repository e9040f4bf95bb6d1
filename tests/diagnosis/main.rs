//! What is said of a mechanism: counts, ranks, dependencies and freedoms by name, for mechanisms with a known
//! answer.

mod assemblies;
mod branches;
mod cost;
mod invariance;
mod limits;
mod models;
mod plan;
mod planar;
mod planted;
mod random;
mod silence;
mod space;
mod spatial;
mod verdicts;
