//! The library: every joint, driver and law, in one table each, and every test loops over the
//! tables.

#[path = "../data/as_text.rs"]
mod as_text;
mod checker;
mod composed;
#[path = "../data/engines.rs"]
mod engines;
#[path = "../data/hermite.rs"]
mod hermite;
mod joints;
mod laws;
mod loads;
mod motions;
mod page;
mod quintic;
mod refused;
mod sample;
mod seams;
mod signature;
mod signs;
mod sketch;
mod table;
mod text;
